// What hands did to the sheets of a case: pulls and pokes, each a call of the worker at a step. `after`: strokes before it.

/** Strokes and hands that are due at a step, in the order in which they were done. A stroke ends a pull. */
function dueAt(state, step) {
  const waiting = list => list.filter(each => each.step === step && !each.done)
  const hands = waiting(state.hands), due = []
  let strokes = state.strokes.filter(s => s.done).length
  const upTo = most => { while (hands.length && hands[0].after <= most) due.push(hands.shift()) }
  for (const stroke of waiting(state.strokes)) {
    upTo(strokes++)
    due.push(stroke)
  }
  upTo(Infinity)
  return due
}
/** All that was done so far, in order. */
function deedsOf(state) {
  const strokes = state.strokes.filter(s => s.done).map(undone), hands = state.hands.filter(h => h.done).map(undone), deeds = []
  strokes.forEach((stroke, i) => deeds.push(...hands.filter(h => h.after === i), stroke))
  return [...deeds, ...hands.filter(h => h.after >= strokes.length)]
}
const stepAfter = (state, step) => Math.min(Infinity, ...[...state.strokes, ...state.hands].map(each => each.step).filter(s => s > step))
/** As it was said, to be done anew. */
const undone = ({ done, ...deed }) => deed

const rounded = v => +v.toFixed(5)
/** 12g0,.5,.8 and for each place on the way its steps after the one before, x, y, z; the last number alone: let go. */
function handsText(hands) {
  const items = []
  let pull = null, last = 0
  for (const { step, after, call, given } of hands) {
    if (call === 'poke') items.push([`${step}k${after}`, ...given.rest, ...given.velocity])
    if (call === 'grab') items.push((pull = [`${step}g${after}`, ...given.rest]))
    if (call === 'drag' && pull) pull.push(step - last, ...given.to)
    if (call === 'release' && pull) pull.push(step - last), (pull = null)
    if (call !== 'poke') last = step
  }
  return items.map(([first, ...numbers]) => [first, ...numbers.map(short)].join(',')).join(';')
}

/** What is not understood is left out. */
function handsOf(text) {
  const hands = []
  for (const item of text.split(';')) {
    const match = /^(\d+)([gk])(\d+)((?:,[-\d.e]+)+)$/.exec(item), numbers = match ? match[4].slice(1).split(',').map(Number) : []
    if (!match || !numbers.every(Number.isFinite)) continue
    const after = +match[3], [x, y, ...more] = numbers
    let step = +match[1]
    const add = (call, given) => hands.push({ step, after, call, given })
    if (match[2] === 'k') {
      if (more.length === 3) add('poke', { rest: [x, y], velocity: more })
      continue
    }
    if (y === undefined) continue
    add('grab', { rest: [x, y] })
    for (let i = 0; i < more.length; i += 4) {
      if (!(more[i] >= 0) || (more.length - i) % 4 > 1) break
      step += Math.round(more[i])
      if (i + 4 > more.length) add('release', {})
      else add('drag', { to: more.slice(i + 1, i + 4) })
    }
  }
  return hands.sort((a, b) => a.step - b.step)
}
