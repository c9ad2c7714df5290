import { load, type Curve, type Cut, type Scene } from 'cutbench'

const scene: Scene = { triangles: 800, pins: [{ near: [0, 0] }, { box: [[0, 0], [1, 0]] }] }
const curve: Curve = { polyline: [[0, 0], [1, 1]], closed: false }
const cutbench = await load(new Uint8Array())
const cut: Cut = new cutbench.Sheet(scene).cut('warp_and_refine', [curve])
const pieces: number = cut.pieces + cutbench.judge(scene, 'cgal_cdt', [curve]).pieces
// @ts-expect-error  a curve has one kind of points
const wrong: Curve = { line: [[0, 0]] }
export { pieces, wrong }
