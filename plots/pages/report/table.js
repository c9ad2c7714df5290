"use strict";
// The table of all methods.
function makeTable(data) {
  const head = document.querySelector("#methods thead"), body = document.querySelector("#methods tbody");
  const titles = { sheet: "sheet", family: "cut family", triangles: "triangles" };
  const plural = { sheet: "sheets", family: "cut families", triangles: "sizes" };
  Object.assign(state.defaults, { sort: data.columns[0].key, desc: "", find: "", open: "",
    ...Object.fromEntries(Object.keys(data.filters).map((name) => [name, "all"])) });

  const menus = Object.entries(data.filters).map(([name, values]) =>
    menu(name, titles[name], values.map((value) => ({ value, label: value === "all" ? `all ${plural[name]}` : words(value) }))));
  const find = element("input", { type: "search", name: "find", placeholder: "part of a name" });
  find.addEventListener("input", () => state.set({ find: find.value }));
  document.querySelector("#filters").append(...menus.map((m) => m.label), element("label", {}, "method", find));
  document.querySelector("#filters").addEventListener("submit", (event) => event.preventDefault());

  const value = (column, index) => {
    const found = data.cells[column.key][column.by.map((name) => state.get(name)).join("|")]?.[index] ?? null;
    return found === "inf" ? Infinity : found;
  };

  function heading(column) {
    const sorted = state.get("sort") === column.key, down = sorted && state.get("desc") === "1";
    const unused = Object.keys(titles).filter((name) => !column.by.includes(name) && state.get(name) !== "all");
    const button = element("button", { type: "button", title: column.definition }, column.label, sorted ? (down ? " ▼" : " ▲") : "");
    button.addEventListener("click", () => state.set({ sort: column.key,
      desc: (sorted ? !down : column.better === "higher") ? "1" : "" }));
    return element("th", { class: "n", scope: "col", "data-key": column.key, "aria-sort": sorted ? (down ? "descending" : "ascending") : "none" },
      button, element("small", {}, [column.unit, `${column.better} is better`].filter(Boolean).join(", ")),
      ...(unused.length ? [element("small", {}, `of all ${unused.map((name) => plural[name]).join(", ")}`)] : []));
  }

  function about(method) {
    const stems = [...new Set(data.columns.map((column) => column.stem))];
    const text = method.summary ? `${method.summary[0].toUpperCase()}${method.summary.slice(1)}.` : "";
    const lines = [text, method.parameter && `Parameter ${method.parameter}${method.meaning ? `: ${method.meaning}` : ""}.`,
      method.promises.length && `It promises: ${method.promises.join(", ")}.`, method.program && "A program of its own.", method.share && `Made / refused / wrong: ${method.share}.`,
      method.outside && `${method.outside} more cuts are on sheets that it declares not to take.`];
    return element("div", { class: "about" }, ...lines.filter(Boolean).map((line) => element("p", {}, line)),
      element("p", {}, element("a", { href: "#" + state.text({ open: method.name, at: `row-${method.name}` }) }, "Link to this row"), "."),
      element("p", {}, "Records: ", ...stems.filter((stem) => data.origins[stem])
        .flatMap((stem) => [element("code", {}, `results/${data.origins[stem].file}`), " "])));
  }

  function rowOf(method, index, best) {
    const open = state.list("open"), isOpen = open.includes(method.name);
    const button = element("button", { type: "button", "aria-expanded": isOpen }, words(method.name),
      ...(method.share ? [element("small", {}, ` ${method.share}`)] : []));
    button.addEventListener("click", () => {
      state.set({ open: (isOpen ? open.filter((name) => name !== method.name) : [...open, method.name]).join(","), at: "" });
      document.querySelector(`#row-${CSS.escape(method.name)} button`)?.focus();
    });
    const cells = data.columns.map((column) => {
      const x = value(column, index);
      return element("td", { class: x !== null && x === best[column.key] ? "n best" : "n", "data-value": x ?? "" }, digits(x));
    });
    const row = element("tr", { id: `row-${method.name}`, class: isOpen ? "open" : "" }, element("td", {}, button), ...cells);
    return isOpen ? [row, element("tr", { class: "more" }, element("td", { colspan: data.columns.length + 1 }, about(method)))] : [row];
  }

  function show() {
    menus.forEach((m) => m.show());
    if (document.activeElement !== find) find.value = state.get("find");
    const column = data.columns.find(({ key }) => key === state.get("sort")) ?? data.columns[0];
    const sign = state.get("desc") === "1" ? -1 : 1, part = words(state.get("find").toLowerCase());
    const rows = data.methods.map((method, index) => ({ method, index, x: value(column, index) }))
      .filter(({ method }) => words(method.name).includes(part))
      .filter(({ index }) => data.columns.some((c) => value(c, index) !== null));
    rows.sort((a, b) => a.method.few - b.method.few || (a.x === null) - (b.x === null) || (a.x === b.x ? 0 : sign * (a.x < b.x ? -1 : 1)) ||
      (a.method.name < b.method.name ? -1 : 1));
    const best = {};
    for (const c of data.columns) {
      const all = rows.map(({ index }) => value(c, index)).filter((x) => x !== null);
      const low = Math.min(...all), high = Math.max(...all);
      best[c.key] = low === high ? null : c.better === "higher" ? high : low;
    }
    const focused = document.activeElement?.closest("th")?.dataset.key;
    head.replaceChildren(element("tr", {}, element("th", { scope: "col" }, "method"), ...data.columns.map(heading)));
    body.replaceChildren(...rows.flatMap(({ method, index }) => rowOf(method, index, best)));
    if (focused) head.querySelector(`[data-key="${focused}"] button`)?.focus();
  }

  document.querySelector("#table-note").append("Bold: the best of a column. Compare within a column: each is of one run, with a version " +
    "and a machine of its own." + (data.setting ? ` Cut and motion after it: ${data.setting}.` : ""));
  document.querySelector("#table-records ul").append(...Object.values(data.origins).map(sourceLine));
  document.querySelector("#columns dl").append(...data.columns.flatMap((column) =>
    [element("dt", {}, column.label), element("dd", {}, column.definition)]));
  state.onChange.push(show);
}
