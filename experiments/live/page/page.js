// The page: sheets side by side in workers, which make the same step at the same time; tools, numbers, files.
const $ = id => document.getElementById(id)
const rate = 240  // steps a second
const source = '@source@'
const state = { preset: 'play', methods: ['warp_and_refine'], material: 'skin', gravity: 1, colour: 0, wire: true, inset: true, obj: '', box: null, packed: '', hands: [], ...presets.play }
const camera = new Camera()
const time = { step: 0, debt: 0, paused: matchMedia('(prefers-reduced-motion: reduce)').matches, slow: false, busy: false, last: 0, single: false }
const drawing = { tool: 'cut', picks: [], stroke: null, cursor: null, grabbed: null, hands: [] }  // hands: said, not yet done
const frames = { count: 0, from: performance.now(), rate: 0, drawn: 0 }
let methods = [], module = null, panels = [], beside = null, fine = null, round = 0, lastCut = null
// For tests: with run(), the page being paused, all is under their control.
window.live = { state, time, frames, camera, get panels() { return panels }, get beside() { return beside }, Remote: null, run }
async function run(steps) {
  const until = time.step + steps
  while (time.step < until && running().length) await advance(until - time.step)
  await refresh()
}

// --- workers ---------------------------------------------------------------------------------------------------------

class Remote {
  constructor(onBroken) {
    Object.assign(this, { waiting: new Map(), id: 0, onBroken, broken: '' })
    this.worker = new Worker(workerAddress)
    this.worker.onmessage = ({ data: { id, result, error, broken, progress } }) => {
      const { done, fail, tell } = this.waiting.get(id) || {}
      if (progress !== undefined) return tell && tell(progress)
      this.waiting.delete(id)
      if (broken) this.end(error)
      if (error !== undefined) fail && fail(new Error(error))
      else done && done(result)
    }
    this.worker.onerror = event => this.end(event.message || 'the worker failed')
    this.ready = this.ask('load', { module })
  }
  ask(call, given = {}, tell) {
    if (this.broken) return Promise.reject(new Error(this.broken))
    return new Promise((done, fail) => {
      this.waiting.set(++this.id, { done, fail, tell })
      this.worker.postMessage({ id: this.id, call, given })
    })
  }
  end(why) {
    this.broken = why || 'ended'
    this.worker.terminate()
    for (const { fail } of this.waiting.values()) fail(new Error(this.broken))
    this.waiting.clear()
    if (this.onBroken) this.onBroken(this.broken)
  }
}

window.live.Remote = Remote

class Panel {
  constructor(index) {
    this.index = index
    this.figure = document.createElement('figure')
    this.figure.innerHTML = '<canvas aria-hidden="true"></canvas><canvas class="over" tabindex="0" role="application"></canvas><figcaption><b></b><span></span></figcaption>'
    $('sheets').append(this.figure)
    const [canvas, over] = this.figure.querySelectorAll('canvas')
    this.over = over
    this.view = new View(canvas, over)
    this.ms = 0
    this.numbers = {}
    listen(this)
  }
  get method() { return state.methods[this.index] }
  async start() {
    if (!this.remote || this.remote.broken) this.remote = new Remote(why => this.stop(why))
    this.stopped = ''
    const note = this.figure.querySelector('.stopped')
    if (note) note.remove()
    this.ms = 0
    this.numbers = {}
    await this.remote.ready
    Object.assign(this.numbers, await this.remote.ask('make', { scene: sceneOf(state) }))
    await this.advance([], 0, true)
    this.over.setAttribute('aria-label', `Sheet cut by ${this.method}. Arrow keys move a cross, Enter sets a point of the cut. Numbers are in the table below.`)
  }
  async advance(due, steps, rest = false) {
    if (this.stopped) return
    const answer = await this.remote.ask('advance', { method: this.method, due, steps, colour: state.colour, rest })
    this.view.show(answer)
    if (steps) this.ms = this.ms ? 0.9 * this.ms + 0.1 * answer.ms : answer.ms
    for (const made of answer.made) this.numbers = { ...this.numbers, ...made, added: (this.numbers.added || 0) + made.added, ms: undefined, oracle: undefined, eigenvalue_ratio: undefined }
    if (answer.stopped) this.stop(answer.stopped)
  }
  stop(why) {
    if (this.stopped) return
    this.stopped = why
    const note = document.createElement('div')
    note.className = 'stopped'
    note.innerHTML = '<strong>This sheet stopped.</strong> <span></span><br><button>Start again</button>'
    note.querySelector('span').textContent = why
    note.querySelector('button').onclick = () => restart()
    this.figure.append(note)
    $('announce').textContent = `The sheet of ${this.method} stopped: ${why}`
  }
  remove() {
    if (this.remote) this.remote.worker.terminate()
    const lose = this.view.gl.getExtension('WEBGL_lose_context')
    if (lose) lose.loseContext()
    this.figure.remove()
  }
}
const running = () => panels.filter(panel => !panel.stopped)

// --- time ------------------------------------------------------------------------------------------------------------

/** Everything from the start: the same strokes, at the same steps. */
async function restart(strokes = state.strokes) {
  const mine = ++round
  time.halted = true
  while (time.busy) await new Promise(done => setTimeout(done, 5))
  if (mine !== round) return
  state.strokes = strokes.map(undone)
  state.hands = state.hands.map(undone)
  Object.assign(time, { step: 0, debt: 0 })
  Object.assign(drawing, { picks: [], stroke: null, grabbed: null, hands: [] })
  lastCut = null
  while (panels.length > state.methods.length) panels.pop().remove()
  while (panels.length < state.methods.length) panels.push(new Panel(panels.length))
  $('sheets').dataset.count = panels.length
  $('compared').textContent = ''
  try {
    await Promise.all(panels.map(panel => panel.start()))
  } catch (error) {
    hint(error.message)
  }
  if (mine !== round) return
  time.halted = false
  keepAddress()
  showNumbers()
  frames.ready = frames.ready || performance.now()
}

/** What hands have said becomes part of the case, at this step; it takes the place of hands that were still to come. */
function takeHands() {
  const held = drawing.grabbed, now = performance.now()
  if (held && held.to !== held.said && (time.step >= held.step + 8 || now > held.time + 60)) {
    Object.assign(held, { said: held.to, step: time.step, time: now })
    drawing.hands.push({ call: 'drag', given: { to: held.to } })
  }
  if (!drawing.hands.length) return
  const after = state.strokes.filter(s => s.done).length, said = drawing.hands.map(hand => ({ step: time.step, after, ...hand }))
  state.hands = [...state.hands.filter(h => h.done), ...said]
  drawing.hands = []
}

/** All sheets do what is due and make so many steps; nobody goes ahead. Without steps they are drawn anew. */
async function advance(steps) {
  time.busy = true
  try {
    takeHands()
    const due = dueAt(state, time.step), made = Math.min(steps, stepAfter(state, time.step) - time.step)
    due.forEach(deed => (deed.done = true))
    await Promise.all(running().map(panel => panel.advance(due.map(undone), made, !steps).catch(() => {})))
    time.step += made
    const strokes = due.filter(deed => deed.curve)
    if (strokes.length) told(strokes)
    else if (due.some(deed => deed.call !== 'drag')) keepAddress()
  } finally {
    time.busy = false
  }
}

function frame(now) {
  requestAnimationFrame(frame)
  const passed = Math.min(0.1, (now - time.last) / 1000)
  time.last = now
  const from = performance.now()
  for (const panel of panels) draw(panel)
  frames.drawn = 0.95 * frames.drawn + 0.05 * (performance.now() - from)
  if (++frames.count % 30 === 0) {
    frames.rate = 30000 / (now - frames.from)
    frames.from = now
    showTimes()
  }
  if (!time.paused && !time.halted) time.debt = Math.min(time.debt + passed * rate * (time.slow ? 1 / 16 : 1), 24)
  work()
}

/** What is due: hands, strokes, and the steps that time owes. Sheets that are behind don't wait for the next picture. */
function work() {
  if (time.busy || time.halted || !running().length) return
  const due = drawing.hands.length > 0 || dueAt(state, time.step).length > 0
  if (time.single) {
    time.single = false
    advance(1)
  } else if (!time.paused) {
    const slowest = Math.max(0.01, ...running().map(p => p.ms)), most = Math.max(1, Math.floor(40 / slowest))
    const steps = Math.min(Math.floor(time.debt), most)
    time.debt -= steps
    if (steps || due) advance(steps).then(() => time.debt >= 1 && work())
  } else if (due || time.changed) {
    time.changed = false
    refresh()
  }
}

const refresh = () => advance(0)

/** Strokes and hands of the case that were still to come are dropped. While the sheets are at work, it is for the step where they end. */
async function addStroke(curve) {
  drawing.picks = []
  const mine = round
  while (time.busy) await new Promise(done => setTimeout(done, 2))
  if (mine !== round) return
  takeHands()
  state.strokes = [...state.strokes.filter(s => s.done), { step: time.step, curve }]
  state.hands = state.hands.filter(h => h.step <= time.step)
  drawing.grabbed = null
}

function told(due) {
  const curve = due[due.length - 1].curve, points = along(curve)
  const xs = points.map(p => p[0]), ys = points.map(p => p[1])
  const half = Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys)) / 2
  lastCut = { middle: [(Math.max(...xs) + Math.min(...xs)) / 2, (Math.max(...ys) + Math.min(...ys)) / 2], half: half * 1.25 + 0.02 }
  keepAddress()
  showNumbers()
  const lines = panels.map(({ method, numbers: n, stopped }) => `${method}: ${stopped || outcome(n)}`)
  $('announce').textContent = `Cut ${state.strokes.filter(s => s.done).length}. ${lines.join('. ')}`
  hint(panels.every(p => p.numbers.status === 'noop') ? 'Nothing to cut there.' : thinnest())
  askBeside()
}
const outcome = n => (n.status === 'refused' || n.status === 'failed' ? `${n.status}: ${n.reason}` : `${n.added} triangles more, ${n.pieces} ${n.pieces === 1 ? 'piece' : 'pieces'}`)

/** Who made worse triangles, in a sentence. */
function thinnest() {
  const all = running().filter(p => !['refused', 'failed'].includes(p.numbers.status)).sort((a, b) => b.numbers.aspect_ratio - a.numbers.aspect_ratio)
  if (!all.length) return ''
  const times = p => `${plain(p.numbers.aspect_ratio)} times`, named = p => p.method + (p.numbers.polygons ? ' (inside polygons)' : '')
  const worst = all.filter(p => times(p) === times(all[0])), others = all.slice(worst.length)
  if (all.length === 1) return `The thinnest triangle is ${times(all[0])} as long as it is high; 2 is good.`
  if (!others.length) return `The thinnest triangles are alike, ${times(all[0])} as long as they are high.`
  return `Worst triangles: ${worst.map(named).join(', ')}. The thinnest is ${times(all[0])} as long as it is high; ${others.map(p => `${named(p)}: ${times(p)}`).join('; ')}. 2 is good.`
}

/** The strokes again, by two methods; the first of them no later than two seconds from the start. */
function another() {
  const [first] = state.methods, done = state.strokes.filter(s => s.done)
  const wait = state.hands.length ? 0 : Math.max(0, done[0].step - 2 * rate)
  state.methods = [first, first === 'conventional_split' ? 'warp_and_refine' : 'conventional_split']
  state.colour = 1
  showControls()
  restart(done.map(s => ({ ...s, step: s.step - wait })))
  hint('Both sheets start again, and are cut at the same moment. Thin triangles are dark, with rings.')
}

async function undo() {
  const done = state.strokes.filter(s => s.done)
  if (drawing.picks.length) return void drawing.picks.pop()
  if (!done.length && !state.hands.some(h => h.done)) return hint('There is no stroke to undo.')
  if (!done.length) {
    state.hands = []
    await restart()
    return hint('Pulls and pokes are undone.')
  }
  while (time.busy) await new Promise(go => setTimeout(go, 2))
  time.busy = true
  const last = done.pop()
  lastCut = null
  drawing.hands = []
  drawing.grabbed = null
  state.hands = state.hands.filter(h => h.done && h.after <= done.length)
  const answers = await Promise.all(running().map(panel => panel.remote.ask('undo').then(a => (Object.assign(panel.numbers, a.numbers, { added: a.numbers.triangles - a.numbers.triangles_before, ms: undefined, oracle: undefined, eigenvalue_ratio: undefined, status: undefined }), a.undone)).catch(() => false)))
  time.busy = false
  if (answers.length === panels.length && answers.every(Boolean)) {
    state.strokes = done
    time.step = last.step
    await refresh()
    keepAddress()
    showNumbers()
    askBeside()
  } else {
    await restart(done)
  }
  hint('The last stroke is undone.')
}

// --- what a pointer and the keys do ------------------------------------------------------------------------------------

const hint = text => { $('hint').textContent = text || usualHint() }
function usualHint() {
  if (drawing.tool === 'pull') return 'Drag a place of the sheet.'
  if (drawing.tool === 'poke') return 'Tap the sheet to push it.'
  if (drawing.tool === 'turn') return 'Drag to turn the view.'
  const n = drawing.picks.length
  return n ? `Point ${n} of 4. The fourth cuts; Undo takes a point back.` : 'Drag across the sheet to cut it. Or click four points: from the first to the fourth, bent by the two between.'
}

function listen(panel) {
  const { over, view } = panel, down = new Map()
  let mode = '', last = null, spread = 0
  const middle = () => { const all = [...down.values()]; return [0, 1].map(k => all.reduce((sum, p) => sum + p[k], 0) / all.length) }
  const apart = () => { const [a, b] = [...down.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]) }
  over.oncontextmenu = event => event.preventDefault()
  over.onpointerdown = event => {
    over.setPointerCapture(event.pointerId)
    down.set(event.pointerId, [event.clientX, event.clientY])
    if (down.size === 2) {
      drawing.stroke = null
      letGo()
      mode = 'pinch'
      last = middle()
      spread = apart()
      return
    }
    last = [event.clientX, event.clientY]
    mode = event.button === 2 || event.shiftKey ? 'turn' : drawing.tool
    if (mode === 'cut') drawing.stroke = { panel, from: last, points: [last], hits: [view.pick(...last)] }
    if (mode === 'pull') grab(panel, view.pick(...last))
    if (mode === 'poke') poke(view.pick(...last), view)
  }
  over.onpointermove = event => {
    if (!down.has(event.pointerId)) return
    const here = [event.clientX, event.clientY], height = over.clientHeight
    down.set(event.pointerId, here)
    if (mode === 'pinch' && down.size === 2) {
      const now = middle(), wide = apart()
      camera.turn((3 * (now[0] - last[0])) / height, (3 * (now[1] - last[1])) / height)
      camera.zoom(spread / wide)
      last = now
      spread = wide
    } else if (mode === 'turn') {
      camera.turn((3 * (here[0] - last[0])) / height, (3 * (here[1] - last[1])) / height)
      last = here
    } else if (mode === 'pull') {
      pullTo(view, here)
    } else if (mode === 'cut' && drawing.stroke) {
      const { points, hits } = drawing.stroke, before = points[points.length - 1]
      if (Math.hypot(here[0] - before[0], here[1] - before[1]) < 4) return
      points.push(here)
      hits.push(view.pick(...here))
    }
  }
  over.onpointerup = over.onpointercancel = event => {
    down.delete(event.pointerId)
    if (mode === 'pull') letGo()
    const stroke = drawing.stroke
    drawing.stroke = null
    if (mode === 'cut' && stroke && event.type === 'pointerup') endStroke(stroke)
    if (!down.size) mode = ''
  }
  over.onwheel = event => {
    event.preventDefault()
    camera.zoom(Math.exp(event.deltaY / 800))
  }
  over.onkeydown = event => keys(event, panel)
  over.onfocus = () => { drawing.focused = panel }
  over.onblur = () => { drawing.focused = null }
}

function endStroke({ points, hits }) {
  const length = points.reduce((sum, p, i) => (i ? sum + Math.hypot(p[0] - points[i - 1][0], p[1] - points[i - 1][1]) : 0), 0)
  if (length < 12) return addPoint(hits[0])
  drawing.picks = []
  const places = hits.filter(Boolean).map(h => h.rest)
  if (places.length < 2) return hint('That misses the sheet.')
  // Begun or ended beside the sheet: on a little in the same direction, across the border.
  const beyond = (a, b) => { const l = Math.hypot(a[0] - b[0], a[1] - b[1]) || 1; return a.map((v, k) => v + (0.06 * (v - b[k])) / l) }
  const few = Math.min(3, places.length - 1)
  if (!hits[0]) places.unshift(beyond(places[0], places[few]))
  if (!hits[hits.length - 1]) places.push(beyond(places[places.length - 1], places[places.length - 1 - few]))
  addStroke(smooth(places, 0.006))
}

function addPoint(hit) {
  if (!hit) return hint('That misses the sheet.')
  drawing.picks.push(hit.rest.map(v => +v.toFixed(5)))
  if (drawing.picks.length === 4) addStroke({ bezier: drawing.picks })
  hint('')
}

function grab(panel, hit) {
  if (!hit) return hint('That misses the sheet.')
  drawing.grabbed = { rest: hit.rest.map(rounded), depth: hit.depth, to: hit.space, said: hit.space, step: -8, time: 0, panel }
  drawing.hands.push({ call: 'grab', given: { rest: drawing.grabbed.rest } })
}
function pullTo(view, [x, y]) {
  if (!drawing.grabbed) return
  const { eye, to } = view.ray(x, y)
  drawing.grabbed.to = eye.map((e, k) => rounded(e + drawing.grabbed.depth * to[k]))
}
function letGo() {
  if (!drawing.grabbed) return
  drawing.grabbed = null
  drawing.hands.push({ call: 'release', given: {} })
}
function poke(hit, view) {
  if (!hit) return hint('That misses the sheet.')
  drawing.hands.push({ call: 'poke', given: { rest: hit.rest.map(rounded), velocity: view.seen.back.map(v => rounded(-5 * v)) } })
}

function keys(event, panel) {
  const { view, over } = panel, r = over.getBoundingClientRect()
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }
  drawing.cursor = drawing.cursor || [0.5, 0.5]
  const window = () => [r.left + drawing.cursor[0] * r.width, r.top + drawing.cursor[1] * r.height]
  const arrow = arrows[event.key]
  if (arrow && event.shiftKey) camera.turn(-0.12 * arrow[0], 0.12 * arrow[1])
  else if (arrow) {
    drawing.cursor = drawing.cursor.map((v, k) => Math.max(0, Math.min(1, v + (14 * arrow[k]) / (k ? r.height : r.width))))
    pullTo(view, window())
  } else if (event.key === 'Enter') addPoint(view.pick(...window()))
  else if (event.key === 'c' && drawing.picks.length > 1) addStroke({ polyline: drawing.picks })
  else if (event.key === 'Backspace') drawing.picks.pop()
  else if (event.key === 'Escape') drawing.picks = []
  else if (event.key === 'g') drawing.grabbed ? letGo() : grab(panel, view.pick(...window()))
  else if (event.key === 'k') poke(view.pick(...window()), view)
  else return
  event.preventDefault()
  event.stopPropagation()
  if (event.key !== 'Enter' && event.key !== 'k') hint('')
}

document.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey || $('helps').open || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return
  if (event.key === ' ' && event.target.tagName !== 'BUTTON' && event.target.tagName !== 'SUMMARY') $('pause').click()
  else if (event.key === '.') $('single').click()
  else if (event.key === 'u') undo()
  else if (event.key === 'r') $('restart').click()
  else if (event.key === '+' || event.key === '=') camera.zoom(0.9)
  else if (event.key === '-') camera.zoom(1.1)
  else return
  event.preventDefault()
})

// --- drawing -----------------------------------------------------------------------------------------------------------

const themes = {
  light: { ground: [1, 1, 1], inset: [0.95, 0.95, 0.94], front: [0.95, 0.8, 0.66], behind: [0.62, 0.71, 0.8], line: [0.35, 0.27, 0.22], lip: [0.62, 0.07, 0.16] },
  dark: { ground: [0.125, 0.137, 0.153], inset: [0.18, 0.19, 0.21], front: [0.87, 0.72, 0.58], behind: [0.46, 0.56, 0.66], line: [0.2, 0.15, 0.12], lip: [0.5, 0.02, 0.1] }
}
const dark = matchMedia('(prefers-color-scheme: dark)')

function draw(panel) {
  const { view } = panel, colours = dark.matches ? themes.dark : themes.light
  const inset = state.inset && lastCut && { ...lastCut, up: held[state.pins].view === 'front' ? -1 : 1 }  // as the sheet hangs
  view.draw(camera, { colours, mode: state.colour, wire: state.wire, inset })
  const c = view.over.getContext('2d'), ratio = view.ratio, r = view.canvas.getBoundingClientRect()
  c.clearRect(0, 0, view.over.width, view.over.height)
  if (!view.soup) return
  const ink = dark.matches ? '#7fd4f7' : '#0b4f8f', halo = dark.matches ? '#000c' : '#fffc'
  const trace = (points, width) => {
    for (const [colour, more] of [[halo, 3], [ink, 0]]) {
      c.strokeStyle = colour
      c.lineWidth = (width + more) * ratio
      c.beginPath()
      points.forEach((p, i) => (p ? (i && points[i - 1] ? c.lineTo(...p) : c.moveTo(...p)) : 0))
      c.stroke()
    }
  }
  if (drawing.stroke && drawing.stroke.panel === panel) trace(drawing.stroke.points.map(([x, y]) => [(x - r.left) * ratio, (y - r.top) * ratio]), 3)
  const picks = drawing.picks.map(p => view.project(p))
  if (picks.length > 1) {
    trace(picks, 1)
    const [a, b, d] = drawing.picks  // of two or three points: as the curve would be with the last one twice
    trace(along({ bezier: [a, b, d || b, d || b] }).map(p => view.project(p)), 3)
  }
  picks.forEach((p, i) => {
    if (!p) return
    c.fillStyle = ink
    c.beginPath()
    c.arc(...p, 7 * ratio, 0, 7)
    c.fill()
    c.fillStyle = dark.matches ? '#000' : '#fff'
    c.font = `${11 * ratio}px system-ui`
    c.textAlign = 'center'
    c.textBaseline = 'middle'
    c.fillText(i + 1, ...p)
  })
  if (drawing.grabbed) {
    const at = view.project(drawing.grabbed.rest)
    if (at) trace([at, view.onCanvas(drawing.grabbed.to)], 2)
  }
  if (drawing.focused === panel && drawing.cursor) {
    const [x, y] = [drawing.cursor[0] * view.over.width, drawing.cursor[1] * view.over.height], arm = 12 * ratio
    trace([[x - arm, y], [x + arm, y]], 2)
    trace([[x, y - arm], [x, y + arm]], 2)
  }
  if (state.colour === 1 && view.flat && view.flat.length === view.soup.length) {
    c.strokeStyle = dark.matches ? '#ff9df0' : '#a3008f'
    c.lineWidth = 1.5 * ratio
    const ring = ([x, y], radius) => {
      c.beginPath()
      c.arc(x, y, radius * ratio, 0, 7)
      c.stroke()
    }
    for (const { seen, flat } of view.thin(10)) {
      ring(seen, 4)
      if (flat && flat[0] > 0 && flat[0] < view.insetSide && flat[1] > 0 && flat[1] < view.insetSide) ring([flat[0], view.over.height - flat[1]], 3)
    }
  }
  if (view.insetSide) {
    c.fillStyle = dark.matches ? '#e8e6e1' : '#22252a'
    c.font = `${12 * ratio}px system-ui`
    c.textAlign = 'left'
    c.textBaseline = 'top'
    c.strokeStyle = halo
    c.lineWidth = 4 * ratio
    c.strokeText('the cut at rest', 8 * ratio, view.over.height - view.insetSide + 6 * ratio)
    c.fillText('the cut at rest', 8 * ratio, view.over.height - view.insetSide + 6 * ratio)
  }
}

// --- numbers -----------------------------------------------------------------------------------------------------------

const plain = (v, digits = 3) => (v === undefined || v === null || !isFinite(v) ? '–' : v >= 1e5 ? v.toExponential(1) : String(+v.toPrecision(digits)))
const waitingFor = (n, value, text) => (n.status === undefined ? '–' : value === undefined ? '…' : text(value))
const rows = [
  ['Last cut', 'What the method did with the last stroke.', 'docs/explanation/measuring.md#judgement', ({ numbers: n, stopped }) => stopped ? 'stopped: ' + stopped : n.status === undefined ? 'no cut yet' : n.status === 'ok' ? 'done' : `${n.status}${n.reason ? ': ' + n.reason : ''}`],
  ['Oracle’s verdict', 'An independent judge with exact arithmetic looks at every cut: right, or what is wrong.', 'docs/explanation/measuring.md#judgement', ({ numbers: n }) => waitingFor(n, n.oracle, v => v.verdict === 'ok' ? 'right' : v.error || `${v.verdict}: ${v.reason}`)],
  ['Time of the cut', 'How long the computer cuts, without the motion: the mean of many cuts of the same sheet.', 'docs/explanation/measuring.md#time', ({ numbers: n }) => waitingFor(n, n.ms, timeText)],
  ['Time of a step', 'How long the computer takes for 1/240 s of motion; below 4.2 ms it keeps up with real time.', 'docs/explanation/which_solver.md', panel => panel.ms ? plain(panel.ms) + ' ms' : '–', 'ms'],
  ['Triangles', 'How many the sheet has now, and how many more than before the cuts.', 'docs/explanation/measuring.md#shape', ({ numbers: n }) => n.triangles === undefined ? '–' : `${n.triangles} (${n.triangles < n.triangles_before ? '' : '+'}${n.triangles - n.triangles_before})` + (n.polygons ? `, ${n.polygons} polygons` : '')],
  ['Thinnest triangle', 'Its length over its height, the aspect ratio. 2 is good, 100 is a hair.', 'docs/explanation/measuring.md#shape', ({ numbers: n }) => plain(n.aspect_ratio)],
  ['Pieces', 'Parts that nothing joins any more.', 'docs/explanation/glossary.md', ({ numbers: n }) => plain(n.pieces)],
  ['Eigenvalue ratio', 'How much stiffer the worst spot is than before. The stiffer, the smaller the steps that a simple program can make.', 'docs/explanation/measuring.md#stability', ({ numbers: n }) => waitingFor(n, n.eigenvalue_ratio, v => plain(v))],
  ['Error against a fine sheet', 'How far the sheet is from where a finer one would be now. On request, below.', 'docs/reference/browser.md#numbers', ({ numbers: n }) => n.error || '–']
]
/** "< 0.1 ms": where the timer can't tell more, of as many cuts as were timed. */
function timeText({ ms, total_ms, cuts, error }) {
  if (error) return error
  if (!(total_ms > 10 * tick)) return `< ${plain(Math.max(tick, total_ms) / cuts * 2, 1)} ms`
  return plain(ms, 2) + ' ms'
}
/** The least step of this browser's clock, ms. */
const tick = (() => {
  let least = Infinity
  for (let i = 0, last = performance.now(); i < 12; ) {
    const now = performance.now()
    if (now === last) continue
    least = Math.min(least, now - last)
    last = now
    ++i
  }
  return Math.max(least, 0.005)
})()

function buildNumbers() {
  document.querySelector('#numbers tbody').innerHTML = rows.map(([name, meaning, page]) => `<tr><th scope="row">${name}<small>${meaning} <a href="${source}/${page}" aria-label="more on ${name}">more</a></small></th></tr>`).join('')
}
function showNumbers() {
  document.querySelector('#numbers thead').innerHTML = '<tr><td></td>' + panels.map(p => `<th scope="col">${p.method}</th>`).join('') + '</tr>'
  document.querySelectorAll('#numbers tbody tr').forEach((tr, i) => {
    while (tr.children.length > 1) tr.lastChild.remove()
    for (const panel of panels) tr.insertCell().textContent = rows[i][3](panel)
  })
  showTimes()
  $('named').textContent = state.methods[0]
  $('another').hidden = panels.length > 1 || !state.strokes.some(s => s.done)
}
function showTimes() {
  panels.forEach((panel, i) => {
    const { numbers: n } = panel
    const caption = panel.figure.querySelector('figcaption')
    caption.firstChild.textContent = panel.method
    caption.lastChild.textContent = n.status && n.status !== 'ok' ? `${n.status} ${n.reason ? '(' + n.reason + ')' : ''}` : n.triangles ? `${n.triangles} triangles · ${n.pieces} ${n.pieces === 1 ? 'piece' : 'pieces'} · thinnest triangle${n.polygons ? ' inside polygons' : ''} ${plain(n.aspect_ratio)}\u00a0:\u00a01; 2\u00a0:\u00a01\u00a0is\u00a0good` : ''
    const at = rows.findIndex(row => row[4] === 'ms'), cell = document.querySelectorAll('#numbers tbody tr')[at]
    if (cell && cell.children[i + 1]) cell.children[i + 1].textContent = rows[at][3](panel) + (i === 0 ? ` (${Math.round(frames.rate)} frames a second, drawing ${plain(frames.drawn, 2)} ms)` : '')
  })
}

/** Verdicts and times of the cuts, one after the other in a worker of their own; what is older than the last stroke is dropped. */
let asked = 0
async function askBeside() {
  const mine = ++asked, cuts = state.strokes.filter(s => s.done).map(s => s.curve)
  if (!cuts.length) return
  if (!beside || beside.broken) beside = new Remote()
  await beside.ready
  const scene = sceneOf(state)
  for (const panel of panels) {
    const given = { scene, method: panel.method, cuts }, kept = panel.numbers
    for (const call of ['time', 'judge']) {
      if (mine !== asked) return
      const answer = await beside.ask(call, given).catch(error => ({ error: error.message }))
      if (mine !== asked || panel.stopped) continue
      if (call === 'time') panel.numbers.ms = answer
      else Object.assign(panel.numbers, { oracle: answer, eigenvalue_ratio: answer.eigenvalue_ratio === null ? NaN : answer.eigenvalue_ratio ?? NaN })
      showNumbers()
    }
  }
  const judged = panels.map(p => `${p.method}: ${p.numbers.oracle && p.numbers.oracle.verdict === 'ok' ? 'right' : 'wrong'}`)
  $('announce').textContent = `The oracle says ${judged.join(', ')}.`
}

/** Twenty by twenty places of the sheet, off its border. */
const places = () => {
  const [[left, low], [right, high]] = state.box || [[0, 0], [1, 1]]
  return Float64Array.from(Array.from({ length: 400 }, (_, i) => [left + (right - left) * ((i % 20) + 0.5) / 20, low + (high - low) * (Math.floor(i / 20) + 0.5) / 20]).flat())
}
async function compare() {
  if (!time.paused) $('pause').click()
  while (time.busy) await new Promise(done => setTimeout(done, 5))
  const points = places(), steps = time.step, mine = round
  const seen = await Promise.all(panels.map(p => p.remote.ask('places', { points }).catch(() => null)))
  for (const id of ['stop', 'progress']) $(id).hidden = false
  $('compare').disabled = true
  fine = new Remote()
  try {
    const deeds = deedsOf(state)
    const best = await fine.ready.then(() => fine.ask('reference', { scene: sceneOf(state), method: 'delaunay_refine', deeds, steps, points }, p => ($('progress').value = p)))
    if (mine !== round || time.step !== steps) throw new Error('The sheets have moved on; compare again.')
    const side = state.box ? Math.max(...[0, 1].map(k => state.box[1][k] - state.box[0][k])) : 1
    panels.forEach((panel, i) => {
      if (!seen[i]) return
      let sum = 0
      for (let k = 0; k < best.length; ++k) sum += (seen[i][k] - best[k]) ** 2
      const error = Math.sqrt(sum / (points.length / 2))
      panel.numbers.error = `${plain(1000 * error)} mm (${plain((100 * error) / side, 2)} % of the side)`
    })
    $('compared').textContent = `Compared at ${plain(steps / rate)} s of motion.`
    showNumbers()
  } catch (error) {
    $('compared').textContent = error.message
  }
  fine.worker.terminate()
  for (const id of ['stop', 'progress']) $(id).hidden = true
  $('compare').disabled = false
}

// --- controls ----------------------------------------------------------------------------------------------------------

function keepAddress() {
  history.replaceState(null, '', addressOf(state) || location.pathname)
}

/** What a link to this case can't hold, in words. */
function lacksOfLink() {
  const address = addressOf(state)
  if (!address) return 'Your own sheet is too large for a link: download the case. '
  return state.hands.length && !address.includes('&u=') ? 'Pulls and pokes are too many for a link. ' : ''
}

function showControls() {
  for (const key of ['triangles', 'family', 'pins', 'material', 'gravity', 'colour']) $(key).value = String(state[key])
  for (const key of ['triangles', 'family']) $(key).disabled = !!state.obj
  $('count').value = state.methods.length
  $('methods').innerHTML = state.methods.map((chosen, i) => {
    const row = methods.find(m => m.name === chosen)
    return `<div><label>Method <select data-sheet="${i}" aria-describedby="m${i}">${methods.map(m => `<option${m.name === chosen ? ' selected' : ''}>${m.name}`).join('')}</select></label><p id="m${i}">${row.summary.replaceAll('`', '')}. <a href="${source}/methods/${chosen}/${chosen}.h">Its page</a></p></div>`
  }).join('')
  const [from, to] = [['', ''], ['2: good', '100: a hair; rings: over 10'], ['0 %', '25 %'], ['', '']][state.colour]
  $('legend').hidden = !from
  $('legend').firstChild.textContent = from
  $('legend').lastChild.textContent = to
}

function take(chosen) {
  Object.assign(state, { material: 'skin', gravity: 1, obj: '', box: null, packed: '', hands: [], ...chosen, methods: chosen.methods || state.methods, colour: chosen.colour ?? 0 })
  state.strokes = chosen.strokes.map(undone)
  camera.reset(held[state.pins].view)
  if (state.box) lookAt(state.box)
  $('says').textContent = chosen.says || presets.play.says
  $('preset').value = Object.keys(presets).find(key => presets[key].label === chosen.label) || ''
  showControls()
  return restart()
}

function again() {
  hint(time.paused ? 'All is as at the start. Play lets it move.' : '')
  return restart()
}

function lookAt([low, high]) {
  camera.middle = [(low[0] + high[0]) / 2, 0, -(high[1] - low[1]) / 2]
  camera.far = 2.4 * Math.max(high[0] - low[0], high[1] - low[1])
}

/** The box at rest of a sheet of one's own. Throws: it is none. */
async function boxOf(obj) {
  const probe = new Remote()
  try {
    await probe.ready
    await probe.ask('make', { scene: { obj, pins: [] } })
    const given = await probe.ask('obj')
    const rest = [...given.matchAll(/^vt (\S+) (\S+)/gm)].map(m => m.slice(1).map(Number))
    return [Math.min, Math.max].map(f => [0, 1].map(k => rest.reduce((b, p) => f(b, p[k]), rest[0][k])))
  } finally {
    probe.worker.terminate()
  }
}

async function takeObj(file) {
  try {
    const obj = await file.text(), box = await boxOf(obj), vertices = [...obj.matchAll(/^v\s/gm)].length
    Object.assign(state, { obj, box, packed: await packed(obj), strokes: [], hands: [] })
    lookAt(box)
    const linked = addressOf(state) ? 'The link holds it.' : 'It is too large for the link; download the case to keep it.'
    $('preset').value = ''
    $('says').textContent = `Your own sheet: ${file.name}, ${vertices} vertices. ${linked}`
    showControls()
    await restart()
  } catch (error) {
    hint(`${file.name}: ${error.message}`)
    $('announce').textContent = `${file.name}: ${error.message}`
  }
}

/** The case of an address, with the sheet that is in it; what can't be read is said. */
async function linked(address) {
  const found = caseOf(address, methods.map(m => m.name))
  if (!found || !found.packed) return found
  try {
    const obj = await unpacked(found.packed)
    return { ...found, obj, box: await boxOf(obj), says: 'A sheet of its own, from the link.' }
  } catch (error) {
    hint(`The sheet in this link can't be read: ${error.message}`)
    return null
  }
}

const save = (name, text) => {
  const link = Object.assign(document.createElement('a'), { download: name, href: URL.createObjectURL(new Blob([text])) })
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 1000)
}
async function download(name) {
  if (name === 'path.json') return save(name, pathOf(state))
  if (name === 'scene.toml') return save(name, tomlOf(state))
  if (name === 'cut.obj') return save(name, await panels[0].remote.ask('obj'))
  const uncut = new Remote()
  await uncut.ready
  await uncut.ask('make', { scene: sceneOf(state) })
  save(name, await uncut.ask('obj'))
  uncut.worker.terminate()
}

function listenToControls() {
  if (innerWidth < 700) for (const each of document.querySelectorAll('aside details')) each.open = false
  const options = (id, table) => { $(id).innerHTML = Object.entries(table).map(([key, { label }]) => `<option value="${key}">${label}`).join('') }
  options('preset', presets)
  $('preset').append(Object.assign(document.createElement('option'), { value: '', textContent: 'Another', disabled: true }))
  options('pins', held)
  options('material', materials)
  $('preset').onchange = () => {
    hint('')
    take(presets[$('preset').value])
  }
  for (const key of ['triangles', 'family', 'pins', 'material', 'gravity'])
    $(key).onchange = () => {
      state[key] = typeof state[key] === 'number' ? +$(key).value : $(key).value
      if (key === 'pins') camera.reset(held[state.pins].view)
      again()
    }
  $('colour').onchange = () => {
    state.colour = +$('colour').value
    time.changed = true
    showControls()
    keepAddress()
    if (!time.busy) refresh()
  }
  for (const key of ['wire', 'inset']) $(key).onchange = () => { state[key] = $(key).checked }
  $('count').onchange = () => {
    const wanted = [...new Set([...state.methods, 'warp_and_refine', 'conventional_split', 'cut_polygons', 'bowyer_watson'])]
    state.methods = wanted.slice(0, +$('count').value)
    showControls()
    again()
  }
  $('methods').onchange = ({ target }) => {
    state.methods[target.dataset.sheet] = target.value
    showControls()
    again()
  }
  $('tools').onclick = ({ target }) => {
    if (!target.dataset.tool) return
    drawing.tool = target.dataset.tool
    for (const button of $('tools').children) button.setAttribute('aria-checked', button === target)
    hint('')
  }
  const showPause = () => {
    $('pause').textContent = time.paused ? 'Play' : 'Pause'
  }
  $('pause').onclick = () => {
    time.paused = !time.paused
    showPause()
  }
  showPause()
  $('single').onclick = () => {
    time.paused = time.single = true
    showPause()
    hint(`Step ${time.step + 1}: ${plain((time.step + 1) / rate)} s of motion.`)
  }
  $('slow').onclick = () => {
    time.slow = !time.slow
    $('slow').setAttribute('aria-pressed', time.slow)
  }
  $('undo').onclick = undo
  $('another').onclick = another
  $('restart').onclick = again
  $('compare').onclick = compare
  $('stop').onclick = () => fine.end('Stopped.')
  $('help').onclick = () => {
    $('helps').showModal()
    $('helps').scrollTop = 0  // the focus is on the button at its end
  }
  $('share').onclick = async () => {
    keepAddress()
    const copied = await navigator.clipboard.writeText(location.href).then(() => true, () => false)
    hint(lacksOfLink() + (copied ? 'The link to this case is copied.' : 'The address of this page is the link to this case.'))
  }
  $('files').onclick = ({ target }) => {
    const button = target.closest('button')
    if (button) download(button.dataset.file)
  }
  $('obj').onchange = () => $('obj').files[0] && takeObj($('obj').files[0])
  document.addEventListener('dragover', event => {
    event.preventDefault()
    document.body.classList.add('dropping')
  })
  for (const name of ['dragleave', 'drop']) document.addEventListener(name, () => document.body.classList.remove('dropping'))
  document.addEventListener('drop', event => {
    event.preventDefault()
    if (event.dataTransfer.files[0]) takeObj(event.dataTransfer.files[0])
  })
  addEventListener('hashchange', () => {
    linked(location.hash).then(found => found && take(found))
  })
}

// --- start -------------------------------------------------------------------------------------------------------------

/** What this page needs and the browser lacks, in words. */
async function lacks() {
  const missing = []
  if (typeof WebAssembly !== 'object') missing.push('WebAssembly')
  if (typeof Worker !== 'function') missing.push('workers')
  if (typeof DecompressionStream !== 'function') missing.push('DecompressionStream')
  if (!document.createElement('canvas').getContext('webgl2')) missing.push('WebGL 2')
  return missing
}
const lacking = text => {
  $('lack').hidden = false
  $('lack').textContent = text
}

/** Of base 85 (bundle.mjs). */
function bytesOf(text, size) {
  const digits = new Uint8Array(128), bytes = new DataView(new ArrayBuffer((text.length / 5) * 4))
  for (let code = 35, digit = 0; code < 127; ++code) if (!"'<\\".includes(String.fromCharCode(code))) digits[code] = digit++
  for (let i = 0; i < text.length; i += 5) {
    let four = 0
    for (let k = i; k < i + 5; ++k) four = four * 85 + digits[text.charCodeAt(k)]
    bytes.setUint32((i / 5) * 4, four)
  }
  return new Uint8Array(bytes.buffer, 0, size)
}

async function begin() {
  const missing = await lacks()
  const newer = 'Chrome or Edge 95, Firefox 113, Safari 16.4 and newer have it.'
  if (missing.length) return lacking(`This browser lacks ${missing.join(', ')}, which this page needs. ${newer}`)
  try {
    module = await WebAssembly.compile(await new Response(new Blob([bytesOf(wasmText, wasmSize)]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer())
  } catch (error) {
    return lacking(`This browser can't run the cutting program (${error.message}): it needs WebAssembly with exceptions and SIMD. ${newer}`)
  }
  beside = new Remote()
  methods = (await beside.ready).methods.filter(m => m.name !== 'example')
  listenToControls()
  buildNumbers()
  hint('')
  const found = (await linked(location.hash)) || presets.play
  requestAnimationFrame(frame)
  await take(found)
}
begin().catch(error => lacking(`The page could not start: ${error.message}`))
