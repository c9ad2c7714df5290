// cutbench in WebAssembly: sheets that move and are cut. Types and words are in cutbench.d.ts.
import Engine from './engine.mjs'

/** @param wasm  cutbench.wasm: its bytes, or a WebAssembly.Module */
export async function load(wasm) {
  const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm)
  const engine = await Engine({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then(instance => done(instance, module))
      return {}
    }
  })
  const encoder = new TextEncoder(), decoder = new TextDecoder()

  const call = (name, ...given) => {
    const taken = []
    const plain = given.map(value => {
      if (typeof value !== 'string') return value
      const bytes = encoder.encode(value), at = engine._malloc(bytes.length + 1)
      engine.HEAPU8.set(bytes, at)
      engine.HEAPU8[at + bytes.length] = 0
      taken.push(at)
      return at
    })
    try {
      return engine['_cutbench_' + name](...plain)
    } finally {
      taken.forEach(at => engine._free(at))
    }
  }
  const text = at => decoder.decode(engine.HEAPU8.slice(at, engine.HEAPU8.indexOf(0, at)))
  const ask = (...given) => {
    const answer = JSON.parse(text(call(...given)))
    if (answer.error) throw new Error(answer.error)
    return answer
  }
  /** A copy of `each` numbers for each of what *count says. */
  const array = (heap, each, name, ...given) => {
    const count = engine._malloc(4)
    const at = call(name, ...given, count), length = new Int32Array(engine.HEAPU8.buffer, count, 1)[0] * each
    engine._free(count)
    return engine[heap].slice(at / engine[heap].BYTES_PER_ELEMENT, at / engine[heap].BYTES_PER_ELEMENT + length)
  }
  const path = cuts => JSON.stringify({ cuts })

  class Sheet {
    constructor(scene = {}) { this.number = ask('make', JSON.stringify(scene)).sheet }
    free() { call('free', this.number) }
    step(steps = 1) { return ask('step', this.number, steps).steps }
    pick(origin, direction) { return ask('pick', this.number, ...origin, ...direction).rest }
    cut(method, cuts, parameter = NaN) { return ask('cut', this.number, method, parameter, path(cuts)) }
    undo() { return ask('undo', this.number).undone }
    grab(rest, radius = 0.06) { ask('grab', this.number, ...rest, radius) }
    drag(to) { call('drag', this.number, ...to) }
    release() { call('release', this.number) }
    poke(rest, velocity, radius = 0.1) { ask('poke', this.number, ...rest, radius, ...velocity) }
    numbers() { return ask('numbers', this.number) }
    obj() { return text(call('obj', this.number)) }
    places(rest) {
      const from = engine._malloc(8 * rest.length), to = engine._malloc(12 * rest.length)
      engine.HEAPF64.set(rest, from / 8)
      try {
        ask('places', this.number, rest.length / 2, from, to)
        return engine.HEAPF64.slice(to / 8, to / 8 + 1.5 * rest.length)
      } finally {
        engine._free(from)
        engine._free(to)
      }
    }
    positions() { return array('HEAPF64', 3, 'positions', this.number) }
    rest() { return array('HEAPF64', 2, 'rest', this.number) }
    triangles() { return array('HEAP32', 3, 'triangles', this.number) }
    draw(colour = 0, atRest = false) { return array('HEAPF32', 15, 'draw', this.number, colour, +atRest) }
  }
  return {
    Sheet,
    methods: () => ask('methods'),
    judge: (scene, method, cuts, parameter = NaN) => ask('judge', JSON.stringify(scene), method, parameter, path(cuts)),
    time: (scene, method, cuts, parameter = NaN) => ask('time', JSON.stringify(scene), method, parameter, path(cuts)),
    memory: () => engine.HEAPU8.length
  }
}
