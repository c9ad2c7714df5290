"""What the paper promises, and what its method did."""

import re

from analysis.paper import fig9_aspect_ratio
from pages.facts.table import condition, number, plain, table

WIDEST = 90  # characters of a claim's words that are shown


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
