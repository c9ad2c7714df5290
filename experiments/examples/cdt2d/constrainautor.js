#!/usr/bin/env node
// delaunator and @kninnug/constrainautor of npm: the whole sheet is triangulated anew, then made to have the path's edges.
// Constrained edges must not cross: clean-pslg divides them before, and the sheet is opened, as whole_sheet.js does.
// usage: node constrainautor.js mesh.obj path.json out.obj [time.json]      once before: npm ci, in this folder
"use strict";
const fs = require("fs");
const Constrainautor = require("@kninnug/constrainautor");
const { cut } = require("./whole_sheet.js");

async function main(mesh, path, out, time) {
  const { default: Delaunator } = await import("delaunator");
  const triangulate = (points, edges) => {
    const made = Delaunator.from(points);
    new Constrainautor(made, edges).delaunify(true);
    return Array.from({ length: made.triangles.length / 3 }, (_, i) => [...made.triangles.slice(3 * i, 3 * i + 3)]);
  };
  const us = cut(triangulate, mesh, path, out);
  if (time) fs.writeFileSync(time, JSON.stringify({ us }));
}

main(...process.argv.slice(2)).catch(error => {
  console.error(String(error));
  process.exit(1);
});
