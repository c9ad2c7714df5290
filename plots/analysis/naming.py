"""What everything is called in tables, captions and legends: a label, colour, marker and line for each method and parameter,
the order of the sheets, and the sentences at the end of every caption."""

import zlib
from dataclasses import dataclass, replace

import numpy as np

from analysis import load, shares
from analysis.load import VARIANT, count, cut_columns, family_column

AR_DEFINITION = ("Aspect ratio AR = longest edge / height on it = l_max² / (2 area): right isosceles 2, "
                 "equilateral 1.155.")


@dataclass(frozen=True)
class Look:
    label: str
    colour: str
    marker: str
    line: str = "-"
    width: float = 1.0  # points; curves drawn first are wider, so that one hidden behind another can still be seen
    program: bool = False  # a program of its own, no method of the harness
    share: str = ""  # of its cuts, beside the label: shares.Share.beside()
    few: bool = False  # under half of its cuts were made

    def drawn(self):
        """Keywords for plot()."""
        edge = dict(markerfacecolor="white", markeredgewidth=0.7, markeredgecolor=self.colour) if self.few else \
            dict(markeredgewidth=0.3, markeredgecolor="white")
        return dict(color=self.colour, marker=self.marker, linestyle=self.line, linewidth=self.width,
                    markersize=2.2 + self.width, **edge)


KNOWN = {  # in the order of the legend
    ("conventional_split", ""): Look("conventional split", "#444444", "s", width=2.4),
    ("bowyer_watson", "rounds=0"): Look("bowyer watson, rounds=0", "#56b4e9", "o", width=2.1),
    ("bowyer_watson", "rounds=1"): Look("bowyer watson, rounds=1", "#0072b2", "^"),
    ("bowyer_watson", "rounds=3"): Look("bowyer watson, rounds=3", "#0b2f66", "v"),
    ("cgal_cdt", ""): Look("cgal cdt", "#d55e00", "D"),
    ("body_fitted (reference)", ""): Look("body-fitted mesh (reference)", "#111111", "*", "--"),
    ("body_fitted_graded (reference)", ""): Look("body-fitted mesh, graded at tips", "#555555", "*", ":"),
    ("every_edge", ""): Look("every edge tested", "#8a8a8a", "h", ":"),
}
PROGRAM = " (program)"
PROGRAM_TIME = (" The time of a program is that of its process, from start to end unless it reports its own, not of the "
                "geometry with warm caches.")
FREE_COLOURS = ["#009e73", "#cc79a7", "#e69f00", "#7b3294", "#8c564b", "#b2182b", "#66a61e", "#01665e"]
FREE_MARKERS = ["P", "X", "<", ">", "p", "H", "d", "8"]
SHEETS = {"grid": "the paper's grid", "alternating": "alternating", "delaunay": "Delaunay", "graded": "graded"}


def words(method):
    """A method's name in figures and their tables: the one that the program knows, with blanks."""
    return method.replace("_", " ")


def looks(variants, programs=(), counts=None):
    """The Look of each (method, parameter), in the order of the legend; those whose method is one of `programs` say so. A method
    that KNOWN does not name gets the free colour its name hashes to (the next one if another method of this figure has
    it), its parameters lighter shades of it. \param counts  {variant: shares.Share}: those who made few of their cuts come last"""
    chosen = {v: look for v, look in KNOWN.items() if v in variants}
    unknown = sorted(set(variants) - set(KNOWN), key=lambda v: (v[0], natural(v[1])))
    colours = {method: look.colour for (method, _), look in reversed(KNOWN.items())}
    for method in dict.fromkeys(method for method, _ in unknown):
        if method not in colours:
            slot = zlib.crc32(method.encode())
            some_free = not set(FREE_COLOURS) <= set(colours.values())
            while some_free and FREE_COLOURS[slot % len(FREE_COLOURS)] in colours.values():
                slot += 1
            colours[method] = FREE_COLOURS[slot % len(FREE_COLOURS)]
        for i, (_, parameter) in enumerate(v for v in unknown if v[0] == method):
            label = words(method) + (f", {parameter}" if parameter else "")
            label += PROGRAM * (method in programs)
            marker = FREE_MARKERS[(zlib.crc32(method.encode()) + i) % len(FREE_MARKERS)]
            line = ("-", "--", "-.", ":")[(i + any(m == method for m, _ in KNOWN)) % 4]
            chosen[method, parameter] = Look(label, lighter(colours[method], min(0.25 * i, 0.6)), marker, line,
                                        program=method in programs)
    for variant in counts or {}:
        if variant in chosen:
            chosen[variant] = replace(chosen[variant], share=counts[variant].beside(), few=counts[variant].is_few)
    return dict(sorted(chosen.items(), key=lambda item: item[1].few))


def looks_of(run, variants):
    """looks() with what became of the run's cuts."""
    programs = load.programs(run.everything(), run.context)
    return looks(variants, programs, shares.of_run(run, programs))


def natural(parameter):
    """Sorts rounds=2 before rounds=10."""
    name, _, value = parameter.partition("=")
    try:
        return name, float(value), value
    except ValueError:
        return name, 0.0, value


def lighter(colour, share):
    """Of "#rrggbb", mixed with that share of white."""
    parts = np.array([int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]) * (1 - share) + share
    return "#" + "".join(f"{round(part * 255):02x}" for part in parts)


def sheet_order(sheets):
    """The paper's grid first, then by SHEETS, then the rest by name."""
    return [s for s in SHEETS if s in set(sheets)] + sorted(set(sheets) - set(SHEETS))


def sheet_title(sheet):
    return SHEETS.get(sheet, sheet)


def provenance(run, cases, with_machine=False, with_crosses=True, per=("sheet", "resolution")):
    """The sentences at the end of every caption. `cases`: the table of the cuts drawn; those with equal variant and `per`
    make one point."""
    context = run.context
    made = cases.drop_duplicates(VARIANT + cut_columns(cases)).groupby(VARIANT + list(per)).size()
    n = "0" if made.empty else str(made.min()) if made.min() == made.max() else f"{made.min()} to {made.max()}"
    everything = run.everything()
    refused = run.failed["status"] == "refused"
    failed = count(run.failed[(run.failed["verdict"] != "ok") | (run.failed["status"] == "failed")])  # in some row
    commit = str(context.get("commit") or "unknown")[:10]
    state = {True: " with uncommitted changes", None: " (state of the tree unknown)"}.get(context.get("dirty"), "")
    families = ", ".join(sorted(set(everything[family_column(everything)])))
    text = [f"n = {n} cuts per point ({families}); {failed} of {count(everything)} cuts failed"
            + (f", {count(run.failed[refused])} refused" if refused.any() else "") + (" (×, with their number)." if len(run.failed) and with_crosses else "."),
            f"Seed {context.get('seed', ', '.join(sorted(set(everything['seed']))))}, commit {commit}{state}."]
    if with_machine:
        text.append(f"{context.get('cpu', 'unknown CPU')}; {context.get('compiler', 'unknown compiler')} "
                    f"{context.get('flags', '')}, one thread.")
    return " ".join(text + [f"Command: {context.get('command', 'unknown')}"])
