"""Figure 9 of the paper: aspect ratios after a cut, and whether its claims about them held."""

from analysis import load, naming

STEM = "fig9_aspect_ratio"
LIMIT = 3
MEASURES = ["vertices_added", "ar_max_all", "ar_mean_all", "ar_p99_all", "ar_max_cut", "over_3_cut",
            "ar_max_cut_strict", "ar_max_cut_outside_wedges"]
LIMIT_TESTS = {"strict": "ar_max_cut_strict", "outside wedges": "ar_max_cut_outside_wedges"}


def held(run, column):
    """How many cuts stayed below the limit, and of how many; a failed cut did not."""
    values = run.rows[column].dropna()
    return int((values < LIMIT).sum()), len(values) + load.count(run.failed)


def paper_method(run):
    """{parameter: run} of the paper's method."""
    everything = run.everything()
    parameters = sorted(set(everything[everything["method"] == "bowyer_watson"]["parameter"]), key=naming.natural)
    return {parameter: run.select(method="bowyer_watson", parameter=parameter) for parameter in parameters}


def claim_sentence(run):
    counts = {parameter: {name: held(cuts, column) for name, column in LIMIT_TESTS.items()}
              for parameter, cuts in paper_method(run).items()}
    counts = {parameter: tests for parameter, tests in counts.items() if tests["strict"][1]}
    if not counts:
        return f"The claim 'maximum AR < {LIMIT}' of the paper's method was not tested: no cuts by bowyer_watson."
    shares = "; ".join(f"{parameter or 'no parameter'}: " + ", ".join(f"{good}/{n} {name}" for name, (good, n) in tests.items())
                       for parameter, tests in counts.items())
    missed = any(good < n for tests in counts.values() for good, n in tests.values())
    return (f"The paper's claim 'maximum AR < {LIMIT}' {'did not hold' if missed else 'held in every cut'}. Cuts below "
            f"{LIMIT} by its method (strict: outside forced corners; then also outside forced wedges): {shares}.")


def average_sentence(run):
    shares = [f"{parameter or 'no parameter'}: {good}/{n}" for parameter, cuts in paper_method(run).items()
              for good, n in [held(cuts, "ar_mean_all")] if n]
    if not shares:
        return "The paper's text, 'average aspect ratio less than 3', was not tested: no cuts by bowyer_watson."
    return f"Cuts with a mean below {LIMIT}, as the paper's text says, by its method: {'; '.join(shares)}."


def print_numbers(run):
    columns = ["sheet", "triangles", "method", "cuts", "failed", "max AR q1", "median", "q3", "whole sheet", "mean AR",
               "p99 AR", "<3 strict", "<3 outside wedges"]
    rows = []
    for sheet in naming.sheet_order(run.everything()["sheet"]):
        on_sheet = run.select(sheet=sheet)
        for resolution in sorted(set(on_sheet.everything()["resolution"])):
            for (method, parameter), look in naming.looks(on_sheet.variants("ar_max_cut")).items():
                cuts = on_sheet.select(resolution=resolution, method=method, parameter=parameter)
                if len(cuts.everything()):
                    rows.append([sheet, str(resolution), look.label, *numbers(cuts)])
    load.print_table("Aspect ratio after the cut, medians over the cuts (max AR: triangles the cut made or changed)",
                     columns, rows)


def numbers(cuts):
    """The right part of a line of print_numbers."""
    shares = ["{}/{}".format(*held(cuts, column)) for column in LIMIT_TESTS.values()]
    medians = [cuts.rows[c].median() for c in ("ar_max_all", "ar_mean_all", "ar_p99_all")]
    return [str(load.count(cuts.rows)), str(load.count(cuts.failed)),
            *cuts.rows["ar_max_cut"].quantile([0.25, 0.5, 0.75]), *medians, *shares]


def print_rounds(run):
    """How the local split grows from round to round, at the lowest resolution of the paper's grid."""
    everything = run.everything()
    sheet = naming.sheet_order(everything["sheet"])[0]
    resolution = everything[everything["sheet"] == sheet]["resolution"].min()
    rows = []
    for parameter, cuts in paper_method(run.select(sheet=sheet, resolution=resolution)).items():
        medians = cuts.rows[["over_3_cut", "vertices_added", "ar_max_cut"]].median()
        rows.append([parameter or "no parameter", str(load.count(cuts.rows)), *medians])
    if rows:
        load.print_table(f"Round by round: bowyer_watson, {sheet}, {resolution} triangles, medians over the cuts",
                         ["local split", "cuts", "triangles AR>3", "vertices added", "max AR"], rows)
