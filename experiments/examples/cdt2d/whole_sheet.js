#!/usr/bin/env node
// A foreign system from npm behind files: the whole sheet is triangulated anew, by cdt2d, with the path among its
// constraints; clean-pslg finds where the path crosses what is there. An adapter: read, call, write.
// usage: node whole_sheet.js mesh.obj path.json out.obj      once before: npm ci, in this folder
"use strict";
const fs = require("fs");
const cdt2d = require("cdt2d");
const cleanPSLG = require("clean-pslg");

const BORDER = 0, OPEN = 1;  // what becomes of an edge

const distance = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
const area = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
const sides = ([a, b, c]) => [[a, b], [b, c], [c, a]];
const unordered = (a, b) => (a < b ? `${a} ${b}` : `${b} ${a}`);

/// Rest positions, one for each place, and triangles as they hang together: the two lips of an incision share places.
function readObj(name) {
  const rows = { v: [], vt: [], f: [] };
  for (const [key, ...words] of fs.readFileSync(name, "utf8").split("\n").map(line => line.trim().split(/\s+/)))
    if (key in rows) rows[key].push(words);
  const points = [], number = new Map();
  const place = (rows.vt.length ? rows.vt : rows.v).map(([x, y]) => {
    const key = `${Number(x)} ${Number(y)}`;
    if (!number.has(key)) number.set(key, points.push([Number(x), Number(y)]) - 1);
    return number.get(key);
  });
  return { points, place, triangles: rows.f.map(face => face.map(corner => parseInt(corner) - 1)) };
}

/// The border once, and older incisions, which two triangles with vertices of their own share.
function constraints({ place, triangles }) {
  const ways = new Set(triangles.flatMap(t => sides(t).map(([a, b]) => `${a} ${b}`))), edges = new Map();
  for (const [a, b] of triangles.flatMap(sides)) {
    if (ways.has(`${b} ${a}`)) continue;
    const key = unordered(place[a], place[b]);
    edges.set(key, { edge: [place[a], place[b]], kind: edges.has(key) ? OPEN : BORDER });
  }
  return [...edges.values()];
}

/// The path as a polyline: each cubic Bezier in as many equal steps as Wang's formula asks for, or 3.
function flattened(cut, tolerance) {
  const p = cut.polyline || cut.bezier;
  if (cut.polyline) return cut.closed ? [...p, p[0]] : p;
  const line = [p[0]];
  for (let i = 0; i + 3 < p.length; i += 3) {
    const bend = j => Math.hypot(...[0, 1].map(k => p[j][k] - 2 * p[j + 1][k] + p[j + 2][k]));
    const steps = Math.max(3, Math.ceil(Math.sqrt(0.75 * Math.max(bend(i), bend(i + 1)) / tolerance)));
    for (let n = 1; n <= steps; ++n) {
      const t = n / steps, s = 1 - t, weight = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
      line.push(n < steps ? [0, 1].map(k => weight.reduce((sum, w, j) => sum + w * p[i + j][k], 0)) : p[i + 3]);
    }
  }
  return line;
}

const mean = points => [0, 1].map(k => points.reduce((sum, p) => sum + p[k], 0) / points.length);

/// Whether p lies in the polygon that these edges bound: by the number of edges that a ray from it crosses.
const inside = (p, edges, points) => edges.filter(([i, j]) => {
  const a = points[i], b = points[j];
  return a[1] > p[1] !== b[1] > p[1] && area(a, b, p) > 0 === b[1] > a[1];
}).length % 2 === 1;

/// A slit of one edge, whose ends could not part, gets a vertex in its middle.
function divideLoneEdges(points, edges, kinds) {
  const open = edges.filter((edge, i) => kinds[i] === OPEN && edge[0] !== edge[1]), ends = open.flat();
  for (const edge of open.filter(e => e.every(v => ends.indexOf(v) === ends.lastIndexOf(v)))) {
    const middle = points.push(mean(edge.map(v => points[v]))) - 1;
    edges.push([middle, edge[1]]), kinds.push(OPEN);
    edge[1] = middle;
  }
}

/// Gives every fan of triangles between open edges a vertex of its own.
function open(points, triangles, isOpen) {
  const across = new Map(), opened = triangles.map(t => [...t]);
  triangles.forEach((t, i) => sides(t).forEach(([a, b]) => across.set(`${a} ${b}`, i)));
  const stars = points.map(() => new Set());
  triangles.forEach((t, i) => t.forEach(v => stars[v].add(i)));
  stars.forEach((star, v) => {
    for (let mine = v; star.size; mine = points.length) {
      if (mine !== v) points.push(points[v]);
      const fan = [star.values().next().value];
      star.delete(fan[0]);
      for (const i of fan) {  // which grows
        opened[i][triangles[i].indexOf(v)] = mine;
        for (const [a, b] of sides(triangles[i])) {
          const next = across.get(`${b} ${a}`);
          if ((a === v || b === v) && !isOpen.has(unordered(a, b)) && star.delete(next)) fan.push(next);
        }
      }
    }
  });
  return opened;
}

/// Cuts the sheet by a triangulation of points that keeps edges. \param triangulate  (points, edges) => triangles, which may
/// lie outside, too. Returns its processor time in microseconds.
function cut(triangulate, mesh, path, out) {
  const sheet = readObj(mesh), { points } = sheet;
  const lengths = sheet.triangles.flatMap(sides).map(([a, b]) => distance(points[sheet.place[a]], points[sheet.place[b]]));
  const start = process.cpuUsage();
  const fixed = constraints(sheet), edges = fixed.map(c => c.edge), kinds = fixed.map(c => c.kind);
  const line = flattened(JSON.parse(fs.readFileSync(path, "utf8")).cuts[0], 0.03 * mean(lengths.map(l => [l, 0]))[0]);
  line.forEach((p, i) => {
    points.push([...p]);
    if (i) edges.push([points.length - 2, points.length - 1]), kinds.push(OPEN);
  });
  cleanPSLG(points, edges, kinds);
  divideLoneEdges(points, edges, kinds);
  const border = edges.filter((edge, i) => kinds[i] === BORDER && edge[0] !== edge[1]);
  const onBorder = new Set(border.map(([a, b]) => unordered(a, b)));
  const isOpen = new Set(edges.filter((edge, i) => kinds[i] === OPEN).map(([a, b]) => unordered(a, b)));
  for (const edge of onBorder) isOpen.delete(edge);
  const triangles = triangulate(points, edges.filter(([a, b]) => a !== b))
    .map(t => (area(...t.map(v => points[v])) < 0 ? [t[1], t[0], t[2]] : t))
    .filter(t => inside(mean(t.map(v => points[v])), border, points));
  const opened = open(points, triangles, isOpen);
  const { user, system } = process.cpuUsage(start);
  const used = new Map([...new Set(opened.flat())].map((v, i) => [v, i + 1]));  // what lay outside is gone
  fs.writeFileSync(out, [...used.keys()].map(v => `v ${points[v][0]} ${points[v][1]} 0\n`).join("") +
                        opened.map(t => `f ${t.map(v => used.get(v)).join(" ")}\n`).join(""));
  return user + system;
}

module.exports = { cut };
if (require.main === module) cut(cdt2d, ...process.argv.slice(2));
