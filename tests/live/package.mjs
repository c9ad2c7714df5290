// The package as others use it: makes, picks, cuts, steps, reads; and says in words what is wrong.
import assert from 'node:assert'
import { readFile } from 'node:fs/promises'
import { load } from 'cutbench'

const cutbench = await load(await readFile(new URL(import.meta.resolve('cutbench/cutbench.wasm'))))
const sheet = new cutbench.Sheet({ triangles: 800 })
assert.equal(sheet.step(10), 10)
const [x, y] = sheet.pick([0.31, 0.42, 1], [0, 0, -1])
assert(Math.hypot(x - 0.31, y - 0.42) < 0.05)
const curve = { bezier: [[0.2, 0.5], [0.4, 0.4], [0.6, 0.6], [0.8, 0.5]] }
const cut = sheet.cut('warp_and_refine', [curve])
assert.equal(cut.status, 'ok')
assert.equal(sheet.triangles().length, 3 * cut.triangles)
assert.equal(sheet.positions().length, 3 * cut.vertices)
assert.equal(sheet.rest().length, 2 * cut.vertices)
assert.equal(sheet.draw().length, 15 * cut.triangles)
const before = sheet.places(Float64Array.of(0.5, 0.9))
sheet.grab([0.5, 0.9])
sheet.drag([0.5, 0.9, 0.4])
sheet.step(20)  // later the whole sheet has fallen farther than a hand of six centimetres can hold
sheet.release()
assert(sheet.places(Float64Array.of(0.5, 0.9))[2] > before[2])
assert(sheet.undo())
assert.equal(sheet.numbers().triangles, 800)
assert.equal(cutbench.judge({ triangles: 800 }, 'warp_and_refine', [curve]).verdict, 'ok')
assert.throws(() => sheet.cut('nonsense', [curve]), /unknown method/)
assert.throws(() => sheet.pick([5, 5, 5], [0, 0, 1]), Error)
assert.throws(() => new cutbench.Sheet({ triangles: 7 }), /triangles/)
assert.throws(() => new cutbench.Sheet({ obj: 'v 0 0 0\nf 1 1 1\n' }), Error)
const copy = new cutbench.Sheet({ obj: sheet.obj() })
assert.equal(copy.numbers().triangles, 800)
copy.free()
// A tube with a seam: it stays one piece, divided in four, too.
const around = 12, along = 3, side = Array.from({ length: along + 1 }, (_, j) => j), ring = Array.from({ length: around + 1 }, (_, i) => i)
const turn = i => [Math.cos((2 * Math.PI * i) / around), Math.sin((2 * Math.PI * i) / around)].map(v => (0.5 * v) / Math.PI)
const v = (i, j) => `${j * around + (i % around) + 1}/${j * (around + 1) + i + 1}`
const tube = ['# vt: rest positions', ...side.flatMap(j => ring.slice(1).map((_, i) => `v ${turn(i).join(' ')} ${j / around}`)),
  ...side.flatMap(j => ring.map(i => `vt ${i / around} ${j / around}`)),
  ...side.slice(1).flatMap(j => ring.slice(1).flatMap(i => [`f ${v(i - 1, j - 1)} ${v(i, j - 1)} ${v(i, j)}`, `f ${v(i - 1, j - 1)} ${v(i, j)} ${v(i - 1, j)}`]))].join('\n') + '\n'
for (const refined of [false, true]) {
  const sewn = new cutbench.Sheet({ obj: tube, refined, pins: [{ box: [[0, 0], [1, 0]] }] }), { triangles, pieces } = sewn.numbers()
  assert.deepEqual([triangles, pieces], [refined ? 288 : 72, 1])
  sewn.step(5)
  assert(sewn.draw(3).filter((_, k) => k % 5 === 3).every(piece => piece === 0))
  const [left, right] = [0, 1].map(x => sewn.places(Float64Array.of(x, 0.13)))
  assert(left.every((p, k) => Math.abs(p - right[k]) < 1e-9), `${left} ${right}`)
  assert.equal(sewn.cut('conventional_split', [{ polyline: [[0.3, 0.1], [0.7, 0.15]] }]).status, 'ok')
  sewn.free()
}
assert(cutbench.methods().length > 15)
console.log('the package does what it should')
