"use strict";
// Joins the parts, and goes where the link says.
function goTo(name) {
  const target = name && document.getElementById(name);
  if (!target) return;
  for (let part = target; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  target.scrollIntoView();
}

const json = (name) => { const held = document.getElementById(name); return held && JSON.parse(held.textContent); };
makeTable(json("comparison"));
if (json("points")) makeChart(json("points"));

let went = "";
state.onChange.push(() => { if (state.get("at") !== went) goTo(state.get("at")); went = state.get("at"); });
document.addEventListener("click", (event) => {  // a link within the page keeps the rest of the choices
  const link = event.target.closest?.('a[href^="#"]');
  const name = link?.getAttribute("href").slice(1);
  if (!name || name.includes("=")) return;
  event.preventDefault();
  went = "";
  state.set({ at: name });
});
document.addEventListener("toggle", (event) => {  // an unfolded part is in the link, too
  const part = event.target;
  if (part.open && part.id && state.get("at") !== part.id) { went = part.id; state.set({ at: part.id }); }
}, true);

function restore() { went = ""; state.read(); for (const tell of state.onChange) tell(); }
window.addEventListener("hashchange", restore);
restore();
