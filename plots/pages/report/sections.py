"""The figures and the table of the paper, and further experiments beside them: what the paper shows, and what was found."""

import html
from dataclasses import dataclass

from analysis import fall, frame_files, load
from analysis.paper import fig8_edge_quality
from analysis.scenes import overview
from pages import claims
from pages.report.markup import table_of


@dataclass(frozen=True)
class Section:
    title: str
    paper: str  # what it shows and claims
    stem: str
    figures: tuple  # names of PNGs, those that matter most first
    find: object = None  # a function of the results' folder, to (verdict, text, table or None), or None: not run


def simulations(results, stem):
    """[(folder, description)] of a stem's scenes, method by method."""
    return [(f.parent, frame_files.read_description(f.parent)) for f in sorted((results / stem).glob(f"{stem}*/*/simulation.json"))]


def runs_of(stem, extra=lambda results: ""):
    """Whether all simulations of a stem ran to the end, and a table of them. There is no verdict on the paper's words about
    them, which name no measure."""
    def find(results):
        made = simulations(results, stem)
        if not made:
            return None
        rows = [[d["scene"].replace("_", " "), d["method"], ", ".join(c["status"] for c in d["cuts"]),
                 str(d["triangles_after"]), str(d["unknowns"]), d["verdict"]] for _, d in made]
        failed = sum(d["verdict"] != "ok" for _, d in made)
        return ("failed" if failed else "ran to the end",
                f"{len(made) - failed} of {len(made)} simulations ran to the end without a failure (solver, inverted "
                f"triangles, energy growth above 1 %). {extra(results)}".strip(),
                table_of(["scene", "method", "cuts", "triangles after", "unknowns", "verdict"], rows))
    return find


def fall_of(stem):
    def sentence(results):
        folders = [f for f, d in simulations(results, stem) if d["scene"] in ("falling_piece", "fig6_partial_and_cutout_cutout")]
        return fall.sentence(folders)
    return sentence


def swirl(results):
    if not simulations(results, fig8_edge_quality.STEM) or not fig8_edge_quality.Reference(results / fig8_edge_quality.STEM).is_there():
        return None
    rows, worth = fig8_edge_quality.measured(results / fig8_edge_quality.STEM)
    table = [[fig8_edge_quality.SCENES[scene].replace("\n", " "), f"{time:g}", " ".join(method).strip(), mm, degrees, worth[scene, time][1],
              verdict] for scene, time, method, mm, degrees, verdict in rows]
    return ("held" if fig8_edge_quality.swirls(rows) else "not held", fig8_edge_quality.answer(rows),
            table_of(["scene", "time, s", "method", "distance of the lips, mm", "angle, degrees",
                      f"sheet of {fig8_edge_quality.COARSER} triangles, degrees", "verdict"], table))


def level_of_detail(results):
    made = {d["method"]: d for _, d in simulations(results, "fig10_level_of_detail")}
    if not {"conventional_split", overview.METHOD} <= set(made):
        return None
    before = made["conventional_split"]["triangles_before"]
    ours, plain = made[overview.METHOD]["unknowns"], made["conventional_split"]["unknowns"]
    uncut = 3 * (round((before / 2) ** 0.5) + 1) ** 2
    share = (ours - plain) / uncut
    return ("held" if share <= claims.FEW else "not held",
            f"The paper's method with one round of local split needs {ours} unknowns, the conventional split {plain}: the difference is "
            f"{100 * share:.0f} % of the {uncut} unknowns of the uncut sheet ('small' here: at most {100 * claims.FEW:g} %). All "
            "exact methods cut through the same points, so that no incision is finer than another.",
            table_of(["method", "triangles", "unknowns"], [[m, str(d["triangles_after"]), str(d["unknowns"])]
                                                           for m, d in made.items()]))


def paper_times(_):
    paper = load.pd.read_csv(load.REPOSITORY / "results/published/table1.csv")
    return "", "The paper's numbers (i7-4790S, 3.2 GHz, one core); ours are in the figures and claims here.", table_of(
        ["triangles", "geometry, ms", "solver, ms", "total, ms"],
        [[str(int(r.triangles)), r.geometry_ms, r.solver_ms, r.total_ms] for r in paper.itertuples()])


def text_file(name):
    """A table that a program printed, as it is."""
    def find(results):
        for file in (results / name.partition(".")[0] / name, results / "reference" / name):
            if file.is_file():
                return "", "", f'<div class="wide"><pre>{html.escape(file.read_text(encoding="utf-8"))}</pre></div>'
        return None
    return find


SECTIONS = [
    Section("Figure 5: single cuts", "Shows a straight and a curved cut in a sheet of 800 triangles: 'realistic and accurate "
            "cut surfaces with arbitrary shapes even in low-resolution meshes'.", "fig5_single_cuts",
            ("fig5_single_cuts",), runs_of("fig5_single_cuts")),
    Section("Figure 6: cut from a side, part cut out", "Shows a cut from a side and a part that is cut out; 'each subdivided "
            "mesh subsequently has an independent deformation basis function'.", "fig6_partial_and_cutout",
            ("fig6_partial_and_cutout",),
            runs_of("fig6_partial_and_cutout", fall_of("fig6_partial_and_cutout"))),
    Section("Figure 7: re-cut and several cuts", "Shows intersected cuts and several cuts in one sheet: 'robust simulation of "
            "complex cuts'.", "fig7_recut_and_multiple", ("fig7_recut_and_multiple",),
            runs_of("fig7_recut_and_multiple")),
    Section("Figure 8: the cut edge", "'With simply subdividing intersected elements without further optimization, it leads to "
            "a swirling cut edge. In contrast, our method provides smooth, physically accurate incisions.'", fig8_edge_quality.STEM,
            (f"{fig8_edge_quality.STEM}_lips", fig8_edge_quality.STEM, f"{fig8_edge_quality.STEM}_mesh"), swirl),
    Section("Figure 9: aspect ratio", "Compares the maximum aspect ratio after a cut with conventional subdivision's; the "
            "conclusion says a maximum, the text a 'low average aspect ratio (less than 3)'.", "fig9_aspect_ratio",
            ("fig9_aspect_ratio", "fig9_aspect_ratio_mean")),
    Section("Table 1: computation time", "Geometry 0.865 to 4.130 ms and 'solver' 0.203 to 0.853 ms a cut, from 800 to 12800 "
            "triangles.", "table1_timing", ("table1_timing", "table1_timing_in_motion", "table1_timing_phases",
                                            "table1_timing_sheets"), paper_times),
    Section("Figure 10: level of detail", "Shows finer triangles round the incision than by conventional subdivision, 'with a "
            "small number of additional DOFs'.", "fig10_level_of_detail",
            ("fig10_level_of_detail", "fig10_level_of_detail_error"), level_of_detail),
    Section("Accuracy", "'A stable and physically accurate incision'; it gives no measure. Here: problems with exact solutions.",
            "accuracy", ("accuracy", "accuracy_budgets", "accuracy_problems", "accuracy_profile", "accuracy_shape",
                         "accuracy_unknowns")),
    Section("Verification", "No comparison with exact solutions.", "verification", ("verification_extrapolated", "verification")),
    Section("Progressive cut", "4.2: the path passes through one element in step i and through the next in step i + 1.",
            "progressive_cut", ("progressive_cut",), runs_of("progressive_cut")),
    Section("Cut picked on the deformed sheet", "4.1.1: control points are picked on the surface and carried to the rest shape.",
            "picked_cut", ("picked_cut",), runs_of("picked_cut")),
    Section("Falling piece", "Pieces separate and move independently.", "falling_piece", ("falling_piece", "falling_piece_mesh"),
            runs_of("falling_piece", fall_of("falling_piece"))),
    Section("All scenes and their energy budgets", "The paper shows a video and no energies.", "",
            ("contact_sheet", "energy_budget")),
    Section("Robustness", "'Robust simulation of complex cuts': no number of trials is given.", "robustness", (),
            text_file("robustness.txt")),
]
