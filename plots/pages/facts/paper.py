"""What the paper promises, and what its method did."""

import re

from analysis.paper import fig9_aspect_ratio
from pages.facts.table import condition, number, plain, table


@table("claims")
def claims(published):
    """The claims and verdicts of claims.md, which plots/pages/claims.py computes."""
    rows = []
    for line in published.text("claims.md").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 4 and cells[1].startswith("**"):
            rows.append([cells[0], cells[1].strip("*")])
    return ["claim", "verdict"], rows


@table("paper_shapes")
def shapes(published):
    head = ["rounds of local split", "cuts with all aspect ratios below 3", "largest aspect ratio, median"]
    return head, [[re.sub(r"\D", "", parameter), "{} of {:,}".format(*fig9_aspect_ratio.held(run, "ar_max_cut_strict")),
                   plain(run.rows["ar_max_cut"].median())] for parameter, run in fig9_aspect_ratio.paper_method(published.figure_9).items()]


@number("paper.cuts")
def cuts(published):
    return f"{max(fig9_aspect_ratio.held(run, 'ar_max_cut_strict')[1] for run in fig9_aspect_ratio.paper_method(published.figure_9).values()):,}"


@condition("paper_not_held", "no random curved cut by bowyer_watson, with any number of rounds, has all aspect ratios below 3")
def paper_not_held(published):
    return all(fig9_aspect_ratio.held(run, "ar_max_cut_strict")[0] == 0 for run in fig9_aspect_ratio.paper_method(published.figure_9).values())


def by_rounds(published, column):
    """Medians over the cuts, by rounds of local split."""
    return [run.rows[column].median() for run in fig9_aspect_ratio.paper_method(published.figure_9).values()]


@condition("rounds_make_more", "with each number of rounds of local split more triangles have an aspect ratio above 3, and the largest is larger")
def rounds_make_more(published):
    return all(values == sorted(values) and values[0] < values[-1] for values in (by_rounds(published, c) for c in ("over_3_cut", "ar_max_cut")))


@condition("split_passes_by_the_mean", "in over half of the cuts the mean over the sheet is below 3, by bowyer_watson without local split and by "
           "conventional_split")
def split_passes_by_the_mean(published):
    runs = [published.figure_9.select(method="conventional_split"), next(iter(fig9_aspect_ratio.paper_method(published.figure_9).values()))]
    held = [fig9_aspect_ratio.held(run, "ar_mean_all") for run in runs]
    return all(good > n / 2 for good, n in held)


def verdict(published, words):
    """Of the claim that has these words."""
    return next(row[1] for row in claims(published)[1] if words in row[0])


@condition("cost_claims_held", "claims.md: the claims on the growth of the cost and on updating the matrix held")
def cost_claims_held(published):
    return all(verdict(published, words) == "held" for words in ("cost that grows", "recalculating the global matrix"))


@condition("shapes_hardly_hurt", "claims.md, 'ill-shaped objects can inject significant errors': a tenfold aspect ratio raises the error of a direct "
           "solve surely by less than 2 %, that of 800 iterations of conjugate gradients by 3 to 15 %, surely by more than that of a direct solve")
def shapes_hardly_hurt(published):
    line = next(line for line in published.text("claims.md").splitlines() if "ill-shaped objects" in line)
    direct, stopped = ([float(x) for x in re.search(rf"{solver}: ([\d.]+) \[([\d.]+), ([\d.]+)\]", line).groups()]
                       for solver in ("direct solve", "cg, 800 iterations"))
    return direct[2] < 1.02 and 1.03 < stopped[0] < 1.15 and stopped[1] > direct[2]
