/** Lengths are metres, times seconds; "rest" is the flat sheet before it moved. Functions throw Error in plain words. */
export type Point2 = [number, number]
export type Point3 = [number, number, number]
/** A chain of m cubic Beziers has 3 m + 1 points. A closed polyline repeats no point, a closed Bezier ends where it began. */
export type Curve = { bezier: Point2[]; closed?: boolean } | { polyline: Point2[]; closed?: boolean }

/** What is left out is that of a hanging square of skin. */
export interface Scene {
  family?: 'grid' | 'alternating' | 'delaunay' | 'graded'
  /** 2 n^2 of them, such as 800, 3200, 12800 */
  triangles?: number
  /** side of the square */
  size?: number
  /** the text of an OBJ, instead of the three above */
  obj?: string
  /** every triangle in four */
  refined?: boolean
  material?: { density?: number; stiffness?: number; poisson?: number; bending?: number; mass_damping?: number; stiffness_damping?: number }
  gravity?: Point3
  /** the vertex nearest to a place, or all in a box, at rest */
  pins?: ({ near: Point2 } | { box: [Point2, Point2] })[]
  step?: number
  /** a solver by name, and its tolerance */
  solver?: string
  tolerance?: number
}

export interface Numbers {
  triangles: number
  triangles_before: number
  vertices: number
  /** of the thinnest triangle at rest: length over height */
  aspect_ratio: number
  pieces: number
  polygons: number
  time: number
}
export interface Cut extends Numbers {
  /** after anything but ok and deviated the sheet is as it was */
  status: 'ok' | 'noop' | 'deviated' | 'refused' | 'failed'
  verdict: string
  reason: string
  added: number
  crossed: number
}

export interface Sheet {
  free(): void
  /** Returns the steps made. Throws where the simulation broke; it makes no more steps then. */
  step(steps?: number): number
  /** Where a ray first meets the sheet, at rest. Throws: a miss. */
  pick(origin: Point3, direction: Point3): Point2
  /** One curve after the other. Use one method for all cuts of a sheet. */
  cut(method: string, cuts: Curve[], parameter?: number): Cut
  /** Back to right before the last cut, four times at most. False: there is none. */
  undo(): boolean
  grab(rest: Point2, radius?: number): void
  drag(to: Point3): void
  release(): void
  poke(rest: Point2, velocity: Point3, radius?: number): void
  numbers(): Numbers
  /** `v` in space, `vt` at rest */
  obj(): string
  /** Where places at rest are now: x, y in, x, y, z out. */
  places(rest: Float64Array): Float64Array
  /** Copies, three, two and three numbers each. The lips of a cut have vertices of their own. */
  positions(): Float64Array
  rest(): Float64Array
  triangles(): Int32Array
  /** Triangles of their own: for each of three corners x, y, z, value, edges (experiments/live/live_sheet.h). */
  draw(colour?: 0 | 1 | 2 | 3, atRest?: boolean): Float32Array
}

export interface Cutbench {
  Sheet: new (scene?: Scene) => Sheet
  methods(): { name: string; summary: string; parameter: { name: string; value: number; meaning: string } }[]
  /** The oracle's verdict on cuts made in the sheet at rest. */
  judge(scene: Scene, method: string, cuts: Curve[], parameter?: number): { verdict: string; reason: string; incision_error: number; pieces: number; eigenvalue_ratio: number | null }
  /** The mean time of the last cut, of warm copies. */
  time(scene: Scene, method: string, cuts: Curve[], parameter?: number): { ms: number; cuts: number; total_ms: number }
  /** bytes of the module's memory */
  memory(): number
}
/** @param wasm  cutbench.wasm: its bytes, or compiled */
export function load(wasm: BufferSource | WebAssembly.Module): Promise<Cutbench>
