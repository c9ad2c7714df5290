// Drawing: triangles of their own by WebGL2, and what lies above them on a second canvas. Also rays, and places on the
// sheet as it is drawn.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
const size = 15  // numbers of a triangle: per corner x, y, z, value, edges

const vertexShader = `#version 300 es
precision highp float;
in vec3 place; in vec2 more; uniform mat4 camera; out vec3 x, b; flat out float value; flat out int edges;
void main() {
  gl_Position = camera * vec4(place, 1.);
  x = place; value = more.x; edges = int(more.y + .5);
  int k = gl_VertexID % 3; b = vec3(k == 0, k == 1, k == 2);
}`
const fragmentShader = `#version 300 es
precision highp float; precision highp int;
in vec3 x, b; flat in float value; flat in int edges; out vec4 c;
uniform vec3 back, front, behind, line, lip; uniform int mode; uniform float wire, flatly, pixel;
vec3 scale(float t) {  // darker is more: also to eyes that don't tell red from green
  t = clamp(t, 0., 1.);
  return t < .5 ? mix(vec3(.98, .93, .75), vec3(.93, .55, .25), 2. * t) : mix(vec3(.93, .55, .25), vec3(.29, .06, .42), 2. * t - 1.);
}
vec3 piece(int i) {  // Okabe and Ito's colours
  vec3 all[7] = vec3[7](vec3(.34, .71, .91), vec3(.90, .62, .0), vec3(.0, .62, .45), vec3(.94, .89, .26), vec3(.80, .47, .65), vec3(.84, .37, .0), vec3(.0, .45, .70));
  return all[i % 7];
}
void main() {
  vec3 n = normalize(cross(dFdx(x), dFdy(x)));
  float light = mix(.5 + .5 * abs(dot(n, normalize(back + vec3(.35, -.2, .5)))), 1., flatly);
  vec3 base = gl_FrontFacing || flatly > 0. ? front : behind;
  if (mode == 1) base = scale(log(value / 1.15) / log(100. / 1.15));
  if (mode == 2) base = scale(value / .25);
  if (mode == 3) base = piece(int(value + .5));
  base *= light;
  vec3 w = fwidth(b);
  for (int k = 0; k < 3; ++k) {
    int kind = (edges >> (2 * k)) & 3, far = (k + 2) % 3;
    float away = b[far] / max(w[far], 1e-9);
    float dense = clamp(4. * w[far] - .3, 0., 1.);
    float wide = kind >= 2 ? mix(1.6, .9, flatly) * pixel : .75 * pixel;
    float on = 1. - smoothstep(wide - .6, wide + .6, away);
    if (kind == 0) base = mix(base, line, on * wire * .55 * (1. - dense));
    if (kind >= 2) base = mix(base, lip, on * (kind == 2 ? 1. : .7));
  }
  c = vec4(base, 1.);
}`

/** Turning, distance and middle: of all sheets alike. */
class Camera {
  constructor() { this.reset('front') }
  reset(view) {
    Object.assign(this, view === 'above' ? { around: 0.35, up: 0.75, far: 1.85, middle: [0.5, 0.5, -0.14] } : { around: 0.25, up: 0.35, far: 2.3, middle: [0.5, 0.1, -0.48] })
  }
  turn(dx, dy) {
    this.around -= dx
    this.up = Math.max(-1.55, Math.min(1.55, this.up + dy))
  }
  zoom(factor) { this.far = Math.max(0.2, Math.min(10, this.far * factor)) }
  /** Eye, axes and the columns of the matrix. */
  of(aspect) {
    const [a, u] = [this.around, this.up], back = [Math.sin(a) * Math.cos(u), -Math.cos(a) * Math.cos(u), Math.sin(u)]
    const right = [Math.cos(a), Math.sin(a), 0], up = cross(back, right)
    const far = this.far * Math.max(1, 1.05 / aspect), eye = this.middle.map((m, k) => m + far * back[k]), f = 2.2
    const row = (axis, factor) => [...axis.map(v => v * factor), -factor * dot(axis, eye)]
    const x = row(right, f / aspect), y = row(up, f), z = row(back, -1)
    const near = 0.02, deep = [...z.slice(0, 3), z[3] - 2 * near]
    const rows = [x, y, deep, z]
    return { eye, right, up, back, f, aspect, matrix: new Float32Array([0, 1, 2, 3].flatMap(column => rows.map(r => r[column]))) }
  }
}

/** Rest space, x to the right and y upwards, or downwards (up: -1): a square round `middle`. */
const flatMatrix = ({ middle, half, up }) => new Float32Array([1 / half, 0, 0, 0, 0, up / half, 0, 0, 0, 0, -0.1, 0, -middle[0] / half, -up * middle[1] / half, 0, 1])

class View {
  constructor(canvas, over) {
    Object.assign(this, { canvas, over, soup: null, flat: null })
    const gl = (this.gl = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true }))
    if (!gl) throw new Error('This browser has no WebGL 2, which draws the sheets.')
    const program = (this.program = gl.createProgram())
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind)
      gl.shaderSource(shader, text)
      gl.compileShader(shader)
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader))
      gl.attachShader(program, shader)
    }
    gl.linkProgram(program)
    gl.useProgram(program)
    gl.enable(gl.DEPTH_TEST)
    this.buffers = [this.buffer(), this.buffer()]
    this.at = Object.fromEntries(['camera', 'back', 'front', 'behind', 'line', 'lip', 'mode', 'wire', 'flatly', 'pixel'].map(name => [name, gl.getUniformLocation(program, name)]))
  }
  buffer() {
    const { gl, program } = this, array = gl.createVertexArray(), buffer = gl.createBuffer()
    gl.bindVertexArray(array)
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer)
    for (const [name, count, from] of [['place', 3, 0], ['more', 2, 12]]) {
      const place = gl.getAttribLocation(program, name)
      gl.enableVertexAttribArray(place)
      gl.vertexAttribPointer(place, count, gl.FLOAT, false, 20, from)
    }
    return { array, buffer, length: 0 }
  }
  fill(which, soup) {
    const { gl } = this, { array, buffer } = this.buffers[which]
    gl.bindVertexArray(array)
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer)
    gl.bufferData(gl.ARRAY_BUFFER, soup, gl.DYNAMIC_DRAW)
    this.buffers[which].length = soup.length / 5
  }
  show({ soup, flat }) {
    this.soup = soup
    this.fill(0, soup)
    if (!flat) return
    this.flat = flat
    this.fill(1, flat)
  }
  resize() {
    const ratio = Math.min(2, devicePixelRatio || 1), w = Math.max(1, Math.round(this.canvas.clientWidth * ratio)), h = Math.max(1, Math.round(this.canvas.clientHeight * ratio))
    for (const canvas of [this.canvas, this.over])
      if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h })
    this.ratio = ratio
  }
  /** \param inset  { middle, half, up } at rest, or null */
  draw(camera, { colours, mode, wire, inset }) {
    const { gl, canvas, at } = this
    this.resize()
    this.seen = camera.of(canvas.width / canvas.height)
    gl.viewport(0, 0, canvas.width, canvas.height)
    gl.disable(gl.SCISSOR_TEST)
    gl.clearColor(...colours.ground, 1)
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT)
    if (!this.soup) return
    gl.uniform3fv(at.back, this.seen.back)
    for (const name of ['front', 'behind', 'line', 'lip']) gl.uniform3fv(at[name], colours[name])
    gl.uniform1i(at.mode, mode)
    gl.uniform1f(at.wire, wire ? 1 : 0)
    gl.uniform1f(at.flatly, 0)
    gl.uniform1f(at.pixel, this.ratio)
    gl.uniformMatrix4fv(at.camera, false, this.seen.matrix)
    gl.bindVertexArray(this.buffers[0].array)
    gl.drawArrays(gl.TRIANGLES, 0, this.buffers[0].length)
    this.insetSide = 0
    this.inset = this.flat && inset
    if (!this.inset) return
    const side = (this.insetSide = Math.round(0.36 * Math.min(canvas.width, canvas.height)))
    gl.enable(gl.SCISSOR_TEST)
    gl.scissor(0, 0, side, side)
    gl.viewport(0, 0, side, side)
    gl.clearColor(...colours.inset, 1)
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT)
    gl.uniformMatrix4fv(at.camera, false, flatMatrix(inset))
    gl.uniform1f(at.wire, 1.6)
    gl.uniform1f(at.flatly, 1)
    gl.bindVertexArray(this.buffers[1].array)
    gl.drawArrays(gl.TRIANGLES, 0, this.buffers[1].length)
  }
  /** Where the triangles are that are thinner than `least`, while their shape is the colour: on the canvas and in the inset. */
  thin(least) {
    const { soup, flat, inset, insetSide } = this, found = []
    for (let i = 0; i < soup.length && found.length < 400; i += size) {
      const inPolygon = [1, 4, 16].some(one => Math.floor(soup[i + 4] / one) % 4 === 1)
      if (soup[i + 3] < least || inPolygon) continue
      const middle = of => [0, 1, 2].map(k => (of[i + k] + of[i + 5 + k] + of[i + 10 + k]) / 3), p = inset && middle(flat)
      found.push({ seen: this.onCanvas(middle(soup)), flat: p && [0, 1].map(k => ((k ? inset.up : 1) * (p[k] - inset.middle[k]) / inset.half + 1) * insetSide / 2) })
    }
    return found
  }
  /** Through a point of the window: where it starts, and where it goes. */
  ray(clientX, clientY) {
    const r = this.canvas.getBoundingClientRect(), { eye, right, up, back, f, aspect } = this.seen
    const u = ((2 * (clientX - r.left)) / r.width - 1) * (aspect / f), v = (1 - (2 * (clientY - r.top)) / r.height) / f
    return { eye, to: [0, 1, 2].map(k => u * right[k] + v * up[k] - back[k]) }
  }
  /** The first triangle on the way: the place at rest and in space; null: a miss. */
  pick(clientX, clientY) {
    const { soup, flat } = this
    if (!soup || !flat || soup.length !== flat.length) return null
    const { eye, to } = this.ray(clientX, clientY)
    let best = null, nearest = Infinity
    for (let i = 0; i < soup.length; i += size) {
      const a = [soup[i], soup[i + 1], soup[i + 2]], e = [soup[i + 5] - a[0], soup[i + 6] - a[1], soup[i + 7] - a[2]], g = [soup[i + 10] - a[0], soup[i + 11] - a[1], soup[i + 12] - a[2]]
      const p = cross(to, g), det = dot(e, p)
      if (det === 0) continue
      const s = minus(eye, a), u = dot(s, p) / det
      if (u < 0 || u > 1) continue
      const q = cross(s, e), v = dot(to, q) / det, t = dot(g, q) / det
      if (v < 0 || u + v > 1 || t <= 0 || t >= nearest) continue
      nearest = t
      best = { i, u, v }
    }
    if (!best) return null
    const { i, u, v } = best, rest = k => flat[i + k] + u * (flat[i + 5 + k] - flat[i + k]) + v * (flat[i + 10 + k] - flat[i + k])
    return { rest: [rest(0), rest(1)], space: eye.map((e, k) => e + nearest * to[k]), depth: nearest }
  }
  /** Where a place at rest is on the canvas, in its pixels; null off the sheet. */
  project(p) {
    const x = this.place(p)
    return x && this.onCanvas(x)
  }
  place([x, y]) {
    const { soup, flat } = this
    if (!soup || !flat || soup.length !== flat.length) return null
    for (let i = 0; i < flat.length; i += size) {
      const ax = flat[i], ay = flat[i + 1], ux = flat[i + 5] - ax, uy = flat[i + 6] - ay, vx = flat[i + 10] - ax, vy = flat[i + 11] - ay
      const area = ux * vy - uy * vx, u = ((x - ax) * vy - (y - ay) * vx) / area, v = (ux * (y - ay) - uy * (x - ax)) / area
      if (u < -1e-4 || v < -1e-4 || u + v > 1.0001) continue
      return [0, 1, 2].map(k => soup[i + k] + u * (soup[i + 5 + k] - soup[i + k]) + v * (soup[i + 10 + k] - soup[i + k]))
    }
    return null
  }
  onCanvas(x) {
    const { eye, right, up, back, f, aspect } = this.seen, d = minus(x, eye), z = -dot(d, back)
    return [((f * dot(d, right)) / aspect / z + 1) * this.canvas.width / 2, (1 - (f * dot(d, up)) / z) * this.canvas.height / 2]
  }
}

const cubic = ([a, b, c, d], t) => [0, 1].map(k => a[k] * (1 - t) ** 3 + 3 * b[k] * t * (1 - t) ** 2 + 3 * c[k] * t * t * (1 - t) + d[k] * t ** 3)

/** Points along a curve, ends included. */
function along(curve, each = 16) {
  if (curve.polyline) return curve.closed ? [...curve.polyline, curve.polyline[0]] : curve.polyline
  const points = [curve.bezier[0]]
  for (let i = 0; i + 3 < curve.bezier.length; i += 3)
    for (let k = 1; k <= each; ++k) points.push(cubic(curve.bezier.slice(i, i + 4), k / each))
  return points
}

/** A drawn line as a chain of cubic Beziers: points smoothed, those that say nothing left out, tangents of Catmull and Rom. */
function smooth(points, tolerance) {
  let line = points
  for (let round = 0; round < 4; ++round)
    line = line.map((p, i) => (i === 0 || i === line.length - 1 ? p : p.map((v, k) => (line[i - 1][k] + 2 * v + line[i + 1][k]) / 4)))
  const thin = (from, to) => {
    let worst = tolerance, place = -1
    const [a, b] = [line[from], line[to]], length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1
    for (let i = from + 1; i < to; ++i) {
      const away = length === 1 && a === b ? 0 : Math.abs((b[0] - a[0]) * (line[i][1] - a[1]) - (b[1] - a[1]) * (line[i][0] - a[0])) / length
      if (away > worst) [worst, place] = [away, i]
    }
    return place < 0 ? [to] : [...thin(from, place), ...thin(place, to)]
  }
  const kept = [line[0], ...thin(0, line.length - 1).map(i => line[i])]
  const closed = Math.hypot(...[0, 1].map(k => kept[0][k] - kept[kept.length - 1][k])) < 0.035 && kept.length > 4
  if (closed) kept[kept.length - 1] = kept[0]
  const n = kept.length, of = i => (closed ? kept[(i + n - 1) % (n - 1)] : kept[Math.max(0, Math.min(n - 1, i))])
  const chain = [kept[0]], round = p => p.map(v => +v.toFixed(4))
  for (let i = 0; i + 1 < n; ++i) {
    const [p, q] = [kept[i], kept[i + 1]], a = of(i - 1), b = of(i + 2)
    chain.push(p.map((v, k) => v + (q[k] - a[k]) / 6), q.map((v, k) => v - (b[k] - p[k]) / 6), q)
  }
  const bezier = chain.map(round)
  return closed ? { bezier, closed } : { bezier }
}
