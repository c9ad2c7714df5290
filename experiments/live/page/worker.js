// One sheet, or the work beside the sheets, in a worker of its own: answers {id, call, with} one after the other.
let cutbench, sheet
const now = () => performance.now()

/** What came of the cuts. */
function act(method, deeds) {
  const made = []
  for (const { curve, call, given } of deeds) {
    if (curve) made.push(sheet.cut(method, [curve]))
    else calls[call](given)
  }
  return made
}

const calls = {
  async load({ module }) {
    cutbench = await load(module)
    return { methods: cutbench.methods() }
  },
  make({ scene }) {
    if (sheet) sheet.free()
    sheet = null
    sheet = new cutbench.Sheet(scene)
    return sheet.numbers()
  },
  /** What is due (strokes, or hands' calls of below), then steps; what is to be drawn comes back. */
  advance({ method, due, steps, colour, rest }) {
    const made = act(method, due)
    const from = now()
    let stopped = ''
    try {
      if (steps) sheet.step(steps)
    } catch (error) {
      stopped = error.message
    }
    const ms = (now() - from) / (steps || 1)
    const soup = sheet.draw(colour), flat = rest || made.length ? sheet.draw(colour, true) : null
    return { made, ms, steps, stopped, soup, flat }
  },
  undo: () => ({ undone: sheet.undo(), numbers: sheet.numbers() }),
  grab: ({ rest }) => sheet.grab(rest),
  drag: ({ to }) => sheet.drag(to),
  release: () => sheet.release(),
  poke: ({ rest, velocity }) => sheet.poke(rest, velocity),
  obj: () => sheet.obj(),
  places: ({ points }) => sheet.places(points),
  judge: ({ scene, method, cuts }) => cutbench.judge(scene, method, cuts),
  time: ({ scene, method, cuts }) => cutbench.time(scene, method, cuts),
  /** The same motion on a sheet of four times the triangles. */
  reference({ scene, method, deeds, steps, points }, progress) {
    calls.make({ scene: { ...scene, refined: true } })
    let said = now()
    for (let step = 0; step <= steps; ++step) {
      act(method, deeds.filter(deed => deed.step === step))
      if (step < steps) sheet.step()
      if (now() > said + 100) progress(step / steps), (said = now())
    }
    return sheet.places(points)
  },
  /** Random strokes, for the test of memory. */
  storm({ strokes, method, seed }) {
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647
    const failed = {}
    let first = 0
    for (let i = 0; i < strokes; ++i) {
      if (i % 20 === 0) calls.make({ scene: { triangles: 200 } })
      if (i === 0.4 * strokes) first = cutbench.memory()
      const x = random(), y = random()
      const points = [0, 1, 2, 3].map(() => [x + 0.5 * random() - 0.25, y + 0.5 * random() - 0.25])
      const { status } = sheet.cut(method, [{ bezier: points }])
      failed[status] = (failed[status] || 0) + 1
      if (i % 20 === 19) {
        try {
          sheet.step(2)
        } catch (error) {
          failed.steps = (failed.steps || 0) + 1
        }
      }
    }
    return { failed, first, last: cutbench.memory() }
  }
}

onmessage = async ({ data: { id, call, given } }) => {
  try {
    const result = await calls[call](given, progress => postMessage({ id, progress }))
    const soups = result && result.soup ? [result.soup.buffer, ...(result.flat ? [result.flat.buffer] : [])] : []
    postMessage({ id, result }, soups)
  } catch (error) {
    // Of the module: what is wrong with the case. Anything else leaves the module in an unknown state.
    postMessage({ id, error: error.message, broken: !(error instanceof Error) || error instanceof WebAssembly.RuntimeError || error instanceof TypeError })
  }
}
