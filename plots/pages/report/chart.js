"use strict";
// The Pareto chart: time against error, both logarithmic, in the pixels of its place.
const SHAPES = {
  circle: (r) => `M${-r},0a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0Z`,
  square: (r) => `M${-r},${-r}H${r}V${r}H${-r}Z`,
  diamond: (r) => `M0,${-1.3 * r}L${1.3 * r},0L0,${1.3 * r}L${-1.3 * r},0Z`,
  up: (r) => `M0,${-1.2 * r}L${1.2 * r},${r}H${-1.2 * r}Z`,
  down: (r) => `M0,${1.2 * r}L${1.2 * r},${-r}H${-1.2 * r}Z`,
  cross: (r) => `M${-r},${-r}L${r},${r}M${r},${-r}L${-r},${r}`,
  plus: (r) => `M${-r},0H${r}M0,${-r}V${r}`,
};

function marker(group, radius, hollow) {
  return element("path", { class: "mark", d: SHAPES[group.shape](radius), fill: hollow ? "#fff" : group.colour, stroke: group.colour,
    "stroke-width": ["cross", "plus"].includes(group.shape) ? 2.5 : 1.5 });
}

// Round numbers of each decade, as many of them as fit.
function ticks(low, high, most) {
  for (const leads of [[1, 1.5, 2, 3, 4, 5, 7], [1, 2, 5], [1, 3], [1]]) {
    const found = [];
    for (let d = Math.floor(Math.log10(low)); d <= Math.log10(high); d++)
      for (const lead of leads) if (lead * 10 ** d >= low && lead * 10 ** d <= high) found.push(lead * 10 ** d);
    if (found.length <= most || leads.length === 1) return found;
  }
}

function makeChart(data) {
  const place = document.querySelector("#plot"), status = document.querySelector("#point");
  const hint = status.textContent;
  for (const { name, options } of data.choices) state.defaults[name] = data.chosen[name] ?? options[0].value;
  const menus = data.choices.map(({ name, label, options }) => menu(name, label, options));
  document.querySelector("#choices").append(...menus.map((m) => m.label));

  const group = (method) => data.groups.find(({ methods }) => methods.includes(method)) ?? data.groups.at(-1);
  const percent = (x) => `${digits(100 * x)} %`;
  const sentence = (p) => `${words(p.method)}, ${p.resolution.toLocaleString("en")} triangles, solver ${words(p.solver)}: ` +
    `${digits(p.ms)} ms (quartiles ${digits(p.ms_low)} to ${digits(p.ms_high)}; the cut ${digits(p.cut_ms)} ms), error ${percent(p.error)} ` +
    `(${percent(p.error_low)} to ${percent(p.error_high)}). ${p.n} motions, of which ${p.failed} ended early` +
    `${p.grew ? ` and ${Math.round(100 * p.grew)} % gained energy` : ""}; ${p.cases} error cases of ${p.kinds} kinds.` +
    (p.layer === 1 ? " On the front." : "");

  function axes(svg, box, x, y, limits) {
    const line = (x1, y1, x2, y2, stroke) => svg.append(element("line", { x1, y1, x2, y2, stroke }));
    for (const t of ticks(limits.x0, limits.x1, box.width / 55)) {
      line(x(t), box.top, x(t), box.bottom, "#e3e3e3");
      svg.append(element("text", { x: x(t), y: box.bottom + 15, "text-anchor": "middle" }, +t.toPrecision(2)));
    }
    for (const t of ticks(limits.y0, limits.y1, 12)) {
      line(box.left, y(t), box.right, y(t), "#e3e3e3");
      svg.append(element("text", { x: box.left - 5, y: y(t) + 4, "text-anchor": "end" }, `${+(100 * t).toPrecision(2)} %`));
    }
    line(box.left, box.bottom, box.right, box.bottom, "#333");
    line(box.left, box.top, box.left, box.bottom, "#333");
    svg.append(element("text", { x: (box.left + box.right) / 2, y: box.bottom + 33, "text-anchor": "middle" }, "ms for a cut and the 0.25 s after it"));
    if (data.real_time_ms > limits.x0 && data.real_time_ms < limits.x1) {
      const at = x(data.real_time_ms);
      svg.append(element("line", { x1: at, x2: at, y1: box.top, y2: box.bottom, stroke: "#777", "stroke-dasharray": "5 4" }),
        element("text", { x: at - 4, y: box.top + 10, "text-anchor": "end" }, "real time"));
    }
  }

  // Names of the front's points, each where it covers no marker and no other name; none where there is no room.
  function names(svg, box, front, all) {
    const taken = all.map(([px, py]) => [px - 5, py - 5, px + 5, py + 5]);
    for (const [px, py, p] of front) {
      const width = 6 * p.method.length, text = words(p.method);
      for (const [dx, dy] of [[9, 4], [-9 - width, 4], [4, -9], [4, 17], [-width / 2, -11], [-width / 2, 19], [-width - 2, -8], [-width - 2, 17],
        [-width / 2, -24], [-width / 2, 32]]) {
        const here = [px + dx, py + dy - 10, px + dx + width, py + dy + 2];
        if (here[0] < box.left || here[2] > box.right + 5 || here[1] < box.top - 8 || here[3] > box.bottom) continue;
        if (taken.some((t) => t[0] < here[2] && here[0] < t[2] && t[1] < here[3] && here[1] < t[3])) continue;
        taken.push(here);
        svg.append(element("text", { x: px + dx, y: py + dy, fill: group(p.method).colour, "aria-hidden": "true" }, text));
        break;
      }
    }
  }

  function mark(p, px, py, x, y, small) {
    const { colour } = group(p.method), label = sentence(p), open = state.list("open").includes(p.method);
    const made = element("g", { class: "point", tabindex: 0, role: "button", "aria-label": label, "data-method": p.method,
      "data-triangles": p.resolution, "data-layer": p.layer, opacity: p.layer === 1 || open ? 1 : 0.5 }, element("title", {}, label));
    if (p.layer === 1) {
      const bars = { stroke: colour, opacity: 0.5 };
      made.append(element("line", { x1: x(p.ms_low), x2: x(p.ms_high ?? p.ms), y1: py, y2: py, ...bars }),
        element("line", { x1: px, x2: px, y1: y(p.error_low), y2: y(p.error_high), ...bars }));
    }
    const drawn = marker(group(p.method), small ? 4 : 6, p.grew > 0.5);
    drawn.setAttribute("transform", `translate(${px},${py})`);
    made.append(drawn);
    if (open) made.append(element("path", { d: SHAPES.circle(11), transform: `translate(${px},${py})`, fill: "none", stroke: "#000" }));
    const tell = () => { status.textContent = label; };
    const choose = () => state.set({ open: p.method, at: `row-${p.method}` });
    for (const event of ["pointerenter", "focus"]) made.addEventListener(event, tell);
    made.addEventListener("click", choose);
    made.addEventListener("keydown", (event) => { if (["Enter", " "].includes(event.key)) { event.preventDefault(); choose(); } });
    return made;
  }

  function draw() {
    const key = ["measure", "solver", "cuts", "step", "stiffness"].map((name) => state.get(name)).join("|");
    const points = data.points[key] ?? [], width = place.clientWidth, height = Math.min(480, Math.max(300, 0.6 * width));
    const box = { left: 48, right: width - 12, top: 14, bottom: height - 42, width: width - 60 };
    const label = `Time against error, ${points.length} points, ${points.filter((p) => p.layer === 1).length} on the front`;
    const svg = element("svg", { width, height, role: "group", "aria-label": label }, element("title", {}, label));
    const note = [data.absent[key], "Small marker: the smaller sheet. Strong: on the front; bars: quartiles of the time, and how the error changes with the kind " +
      "of problem. Hollow, on no front: energy grew in over half of the motions."];
    document.querySelector("#chart-note").textContent = note.filter(Boolean).join(" ");
    place.replaceChildren(svg);
    if (!points.length) return void svg.append(element("text", { x: 20, y: 40 }, "There are no records of this setting."));
    const limits = { x0: Math.min(...points.map((p) => p.ms)) / 1.4, x1: Math.max(...points.map((p) => p.ms)) * 1.4,
      y0: Math.min(...points.map((p) => p.error)) / 1.2, y1: Math.max(...points.map((p) => p.error)) * 1.2 };
    const scale = (low, high, from, to) => (v) => from + (to - from) * Math.min(1, Math.max(0, Math.log(v / low) / Math.log(high / low)));
    const x = scale(limits.x0, limits.x1, box.left, box.right), y = scale(limits.y0, limits.y1, box.bottom, box.top);
    axes(svg, box, x, y, limits);
    const smallest = Math.min(...points.map((p) => p.resolution));
    const front = points.filter((p) => p.layer === 1).sort((a, b) => a.ms - b.ms).map((p) => [x(p.ms), y(p.error), p]);
    svg.append(element("path", { class: "front", d: "M" + front.map(([px, py]) => `${px},${py}`).join("L"), fill: "none", stroke: "#111", "stroke-dasharray": "2 3" }));
    const behind = points.filter((p) => p.layer !== 1);
    for (const p of [...behind, ...front.map((f) => f[2])]) svg.append(mark(p, x(p.ms), y(p.error), x, y, p.resolution === smallest));
    names(svg, box, front, points.map((p) => [x(p.ms), y(p.error)]));
  }

  for (const g of data.groups.filter((g) => Object.values(data.points).flat().some((p) => group(p.method) === g))) {
    const picture = element("svg", { width: 16, height: 16, "aria-hidden": "true" }), drawn = marker(g, 5, false);
    drawn.setAttribute("transform", "translate(8,8)");
    picture.append(drawn);
    document.querySelector("#legend").append(element("li", {}, picture, g.name));
  }
  document.querySelector("#chart-records ul").append(...data.origins.map(sourceLine));
  let shown = "";
  state.onChange.push(() => {
    menus.forEach((m) => m.show());
    const now = [...data.choices.map(({ name }) => state.get(name)), state.get("open")].join("|");
    if (now !== shown) { draw(); status.textContent = hint; }
    shown = now;
  });
  let width = 0;
  new ResizeObserver(() => { if (place.clientWidth !== width) { width = place.clientWidth; draw(); } }).observe(place);
}
