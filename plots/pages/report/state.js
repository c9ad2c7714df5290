"use strict";
// What the reader has chosen. It is kept in the URL's hash, so that a link restores it: #sort=error_percent&sheet=grid. What has
// its default is left out. A hash without "=" is the name of a part of the page.
const state = {
  defaults: { at: "" },
  values: {},
  onChange: [],

  get(name) { return this.values[name] ?? this.defaults[name]; },

  list(name) { return this.get(name).split(",").filter(Boolean); },

  read() {
    const text = location.hash.slice(1);
    const said = new URLSearchParams(text.includes("=") ? text : { at: decodeURIComponent(text) });
    this.values = {};
    for (const name of Object.keys(this.defaults)) if (said.has(name)) this.values[name] = said.get(name);
  },

  set(changes) {
    Object.assign(this.values, changes);
    history.replaceState(null, "", "#" + this.text());
    for (const tell of this.onChange) tell();
  },

  text(changes = {}) {
    const chosen = Object.entries({ ...this.values, ...changes }).filter(([name, value]) => value !== this.defaults[name]);
    return new URLSearchParams(chosen).toString();
  },
};

// An element with attributes and children; texts are never read as HTML.
function element(tag, attributes = {}, ...children) {
  const made = ["svg", "g", "path", "line", "text", "title"].includes(tag)
    ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// A menu whose choice is kept under `name`; a value that a link made up counts as the default.
function menu(name, label, options) {
  const select = element("select", { name });
  for (const { value, label } of options) select.append(element("option", { value }, label));
  select.addEventListener("change", () => state.set({ [name]: select.value }));
  const show = () => {
    if (!options.some(({ value }) => value === state.get(name))) delete state.values[name];
    select.value = state.get(name);
  };
  return { show, label: element("label", {}, label, select) };
}

// Three digits, an exponent where there would be many zeros.
function digits(x) {
  if (x === null || x === undefined) return "–";
  if (!Number.isFinite(+x)) return "∞";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 1e-4) return x.toExponential(1);
  return size >= 100 ? Math.round(x).toLocaleString("en") : x.toPrecision(3);
}

const words = (name) => name.replaceAll("_", " ");

const sourceLine = (from) => element("li", {}, element("code", {}, `results/${from.file}`), `: suite version ${from.version}, commit ${from.commit}, seed ${from.seed}, `,
  element("code", {}, from.command));
