// A case: the sheet, what holds it, the methods, strokes and hands; presets; the case as an address and as files.
const materials = {
  skin: { label: 'skin: soft and heavy', density: 2.2, stiffness: 1000, poisson: 0.45, bending: 4.2e-4 },
  cotton: { label: 'cotton: light and stiff', density: 0.2, stiffness: 4000, poisson: 0.3, bending: 1e-5 },
  rubber: { label: 'rubber: thin and stretchy', density: 1, stiffness: 300, poisson: 0.48, bending: 3e-5 }
}
const far = 1e9
const held = {
  corners: { label: 'two corners: it hangs', pins: [{ near: [0, 0] }, { near: [1, 0] }], view: 'front' },
  top: { label: 'one side: it hangs', pins: [{ box: [[-far, -far], [far, 0]] }], view: 'front' },
  sides: { label: 'two sides: a hammock', pins: [{ box: [[-far, -far], [0, far]] }, { box: [[1, -far], [far, far]] }], view: 'above' },
  frame: {
    label: 'all sides: a drum', view: 'above',
    pins: [{ box: [[-far, -far], [0, far]] }, { box: [[1, -far], [far, far]] }, { box: [[-far, -far], [far, 0]] }, { box: [[-far, 1], [far, far]] }]
  }
}
const bezier = (...points) => ({ bezier: points }), line = (...points) => ({ polyline: points })
const circle = { closed: true, bezier: [[0.67, 0.52], [0.67, 0.63046], [0.58046, 0.72], [0.47, 0.72], [0.35954, 0.72], [0.27, 0.63046], [0.27, 0.52], [0.27, 0.40954], [0.35954, 0.32], [0.47, 0.32], [0.58046, 0.32], [0.67, 0.40954], [0.67, 0.52]] }
const at = (time, curve) => ({ step: Math.round(time * 240), curve })
/** Small cuts all over the sheet, each turned by the golden angle. */
const forty = () => Array.from({ length: 40 }, (_, i) => {
  const x = 0.1 + 0.114 * (i % 8), y = 0.12 + 0.19 * Math.floor(i / 8), turn = i * 2.39996
  const dx = 0.045 * Math.cos(turn), dy = 0.045 * Math.sin(turn)
  return at(0.2 + i / 20, line(...[[x - dx, y - dy], [x + dx, y + dy]].map(p => p.map(v => +v.toFixed(5)))))
})
const paper = (strokes, more) => ({ triangles: 800, family: 'grid', pins: 'sides', damping: 0.5, strokes, ...more })
const presets = {
  play: { label: 'Play: a hanging sheet', triangles: 3200, family: 'grid', pins: 'corners', damping: 2, strokes: [], says: 'Draw on the sheet: it is cut where you draw.' },
  fig5a: paper([at(0.5, bezier([0.25, 0.3], [0.9, 0.2], [0.9, 0.8], [0.25, 0.7]))], { label: 'Paper, figure 5: a curved cut', says: 'A curved cut frees a flap.' }),
  fig5b: paper([at(0.5, line([0.47, 0.18], [0.56, 0.82]))], { label: 'Paper, figure 5: a straight cut', says: 'A straight cut across the pull opens like an eye.' }),
  fig6a: paper([at(0.5, bezier([0.5, -0.05], [0.6, 0.25], [0.4, 0.4], [0.53, 0.63]))], { label: 'Paper, figure 6: a cut from the border', says: 'A cut from the border opens like a mouth.' }),
  fig6b: paper([at(0.5, circle)], { label: 'Paper, figure 6: a cut-out', pins: 'frame', says: 'A round piece falls out.' }),
  fig7a: paper([at(0.5, bezier([0.45, 0.15], [0.6, 0.4], [0.4, 0.6], [0.52, 0.85])), at(0.75, bezier([0.17, 0.46], [0.4, 0.62], [0.6, 0.38], [0.83, 0.55]))], { label: 'Paper, figure 7: a cut across a cut', says: 'The second cut crosses the first: four corners come apart.' }),
  fig7b: paper([at(0.4, bezier([0.2, 0.14], [0.3, 0.3], [0.2, 0.45], [0.27, 0.62])), at(0.55, line([0.42, 0.3], [0.38, 0.9])), at(0.7, bezier([0.56, -0.05], [0.5, 0.2], [0.6, 0.3], [0.52, 0.48])), at(0.85, bezier([0.62, 0.62], [0.95, 0.5], [0.95, 1.0], [0.6, 0.83]))], { label: 'Paper, figure 7: four cuts', says: 'Four cuts, one after the other, while the sheet moves.' }),
  fig8: paper([at(0.5, bezier([0.25, 0.2005], [0.95, 0.2], [0.95, 0.8], [0.25, 0.7502]))], { label: 'Paper, figure 8: thin triangles', methods: ['conventional_split', 'warp_and_refine'], colour: 1, says: 'The cut passes corners of triangles closely. Look at the shapes: which method leaves slivers?' }),
  fig10: paper([at(0.5, bezier([0.38, 0.12], [0.75, 0.42], [0.25, 0.58], [0.62, 0.88]))], { label: 'Paper, figure 10: how finely?', methods: ['conventional_split', 'bowyer_watson'], says: 'How finely does each method divide the sheet round the cut?' }),
  vertex: paper([at(0.5, line([0.2331, 0.50005], [0.7669, 0.50005]))], { label: 'Pitfall: just beside corners', methods: ['conventional_split', 'cut_polygons', 'snap_or_split', 'warp_and_refine'], colour: 1, says: 'The sheet is 1 m wide. The cut runs 0.05 mm beside a row of corners. A plain split leaves hair-thin triangles there.' }),
  recut: paper([at(0.5, line([0.2, 0.48], [0.8, 0.52])), at(0.9, line([0.2, 0.5], [0.8, 0.505]))], { label: 'Pitfall: a second cut at a small angle', methods: ['conventional_split', 'cut_polygons', 'adaptive_remesh', 'warp_and_refine'], colour: 1, says: 'Two cuts cross at two degrees. The wedge between them is thin, whatever a method does.' }),
  forty: paper(forty(), { label: 'Pitfall: forty cuts', methods: ['conventional_split', 'warp_and_refine'], colour: 1, says: 'Forty small cuts in one sheet. Does it get worse with each?' })
}

/** What the engine is asked to make of a case. */
function sceneOf(state) {
  const { label, ...material } = materials[state.material]
  const scene = {
    material: { ...material, mass_damping: state.damping, stiffness_damping: 1e-3 },
    gravity: [0, 0, -9.81 * state.gravity], pins: pinsOf(state)
  }
  return state.obj ? { ...scene, obj: state.obj } : { ...scene, family: state.family, triangles: state.triangles }
}

/** Those of the square, drawn out to the box of a sheet of one's own. */
function pinsOf(state) {
  const [[left, low], [right, high]] = state.box || [[0, 0], [1, 1]]
  const x = v => (Math.abs(v) === far ? v : v === 0 ? left : right), y = v => (Math.abs(v) === far ? v : v === 0 ? low : high)
  return held[state.pins].pins.map(({ near, box }) => (near ? { near: [x(near[0]), y(near[1])] } : { box: box.map(([a, b]) => [x(a), y(b)]) }))
}

const short = v => (+v.toFixed(5)).toString().replace(/^(-?)0\./, '$1.')
const pointsOf = curve => curve.bezier || curve.polyline

/** Programs that send links on cut longer ones. */
const longestAddress = 30000

/** Where it would be too long, without the hands; null: even so. */
function addressOf(state) {
  const strokes = state.strokes.map(({ step, curve }) => step + (curve.bezier ? 'b' : 'p') + (curve.closed ? 'c' : '') + pointsOf(curve).flat().map(short).join(','))
  const sheet = state.obj ? { o: state.packed } : { n: state.triangles, f: state.family }
  const words = { ...sheet, h: state.pins, m: state.material, d: state.damping, g: state.gravity, k: state.methods.join(','), q: state.colour, c: strokes.join(';') }
  const text = Object.entries(words).map(([key, value]) => key + '=' + value).join('&'), hands = handsText(state.hands)
  const whole = '#' + text + (hands && '&u=' + hands)
  return [whole, '#' + text].find(address => address.length <= longestAddress) || null
}

/** Text as letters of an address, and back. */
async function packed(text) {
  const bytes = await new Response(new Blob([text]).stream().pipeThrough(new CompressionStream('deflate-raw'))).arrayBuffer()
  return btoa(Array.from(new Uint8Array(bytes), b => String.fromCharCode(b)).join('')).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')
}
async function unpacked(letters) {
  const bytes = Uint8Array.from(atob(letters.replaceAll('-', '+').replaceAll('_', '/')), c => c.charCodeAt(0))
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).text()
}

/** \return null where the address holds no case; what is not understood is left out. */
function caseOf(address, methods) {
  const words = Object.fromEntries(new URLSearchParams(address.replace(/^#/, '')))
  if (!words.n && !words.o) return presets[address.slice(1)] ? { ...presets[address.slice(1)] } : null
  const one = (value, known, usual) => (known.includes(value) ? value : usual)
  const number = (text, usual, most) => (Number.isFinite(+text) && text !== undefined && +text >= 0 && +text <= most ? +text : usual)
  const strokes = (words.c || '').split(';').map(text => {
    const match = /^(\d+)([bp])(c?)([-\d.,e]+)$/.exec(text)
    const numbers = match ? match[4].split(',').map(Number) : []
    if (numbers.length < 4 || numbers.length % 2 || !numbers.every(Number.isFinite)) return null
    const points = numbers.filter((_, i) => i % 2 === 0).map((x, i) => [x, numbers[2 * i + 1]])
    if (match[2] === 'b' && points.length % 3 !== 1) return null
    const curve = match[2] === 'b' ? { bezier: points } : { polyline: points }
    return { step: +match[1], curve: match[3] ? { ...curve, closed: true } : curve }
  }).filter(Boolean).sort((a, b) => a.step - b.step)
  const chosen = (words.k || '').split(',').filter(name => methods.includes(name)).slice(0, 4)
  return {
    label: 'From the address', triangles: +one(words.n, ['800', '3200', '12800'], '3200'), family: one(words.f, ['grid', 'alternating', 'delaunay', 'graded'], 'grid'),
    pins: one(words.h, Object.keys(held), 'corners'), material: one(words.m, Object.keys(materials), 'skin'), damping: number(words.d, 2, 100),
    gravity: number(words.g, 1, 3), colour: number(words.q, 0, 3), methods: chosen.length ? chosen.slice(0, chosen.length === 3 ? 2 : 4) : undefined, strokes,
    hands: handsOf(words.u || ''), packed: words.o || ''
  }
}

const pathOf = state => JSON.stringify({ cuts: state.strokes.map(({ curve }) => curve) }, null, 1) + '\n'

function tomlOf(state) {
  const m = materials[state.material], number = v => (Number.isInteger(v) ? v + '.0' : String(v))
  const bound = v => (Math.abs(v) === far ? (v < 0 ? '-inf' : 'inf') : number(v))
  const list = points => '[' + points.map(p => '[' + p.map(bound).join(', ') + ']').join(', ') + ']'
  const sheet = state.obj ? 'mesh = "sheet.obj"' : `family = "${state.family}"\nsize = 1.0\nresolution = ${state.triangles}`
  const pins = pinsOf(state).map(pin => '[[pins]]\n' + (pin.near ? `near = [${pin.near.map(number).join(', ')}]` : `box = ${list(pin.box)}`) + '\n')
  const last = Math.max(0, ...state.strokes.map(s => s.step))
  const cuts = state.strokes.map(({ step, curve }) => `[[cuts]]\ntime = ${number(step / 240)}\n${curve.closed ? 'closed = true\n' : ''}${curve.bezier ? 'bezier' : 'polyline'} = ${list(pointsOf(curve))}\n`)
  const hands = state.hands.filter(h => h.call === 'grab' || h.call === 'poke').length
  return `# A case of cutbench live: cutbench simulate scene.toml --method ${state.methods[0]}
${hands ? `# ${hands} pulls and pokes are left out: a scene file can't hold them.\n` : ''}effect = "drawn on the page cutbench live"
truth = "none"
duration = ${number(last / 240 + 1)}  # s

[sheet]
${sheet}

[material]
density = ${number(m.density)}  # kg/m2
stiffness = ${number(m.stiffness)}  # N/m
poisson = ${number(m.poisson)}
bending = ${m.bending}  # N m
mass_damping = ${number(state.damping)}  # 1/s
stiffness_damping = 0.001  # s

[physics]
bending = "patches"
gravity = [0.0, 0.0, ${number(-9.81 * state.gravity)}]  # m/s2

${pins.join('\n')}
[integrator]
name = "backward_euler"
step = 0.004166666666666667  # s: 1/240
newton = 1  # one linear solve a step, as on the page

[solver]
name = "multigrid"
tolerance = 1e-2

${cuts.join('\n')}`
}
