"""Adversarial cuts, counted."""

from pages.facts.table import condition, number, percent, table

CROSS_CHECK = "cgal_whole_sheet (cross-check)"
OUTCOMES = {"ok": "right", "noop": "right: there was nothing to do", "deviated": "deviated, by the declared policy", "refused": "refused"}
BROKEN = ["failed", "wrong", "crashed", "timed_out"]


def own(published):
    return published.robustness[published.robustness["method"] != CROSS_CHECK]


def cross_check(published):
    return published.robustness[published.robustness["method"] == CROSS_CHECK]


def counted(rows):
    return [f"{rows[outcome].sum():,.0f}" for outcome in OUTCOMES] + [f"{rows[BROKEN].sum().sum():,.0f}"]


@table("robustness")
def outcomes(published):
    names = [*OUTCOMES.values(), "failed, wrong, crashed or hung"]
    return ["", f"our {own(published)['method'].nunique()} methods", "CGAL's triangulation of the whole sheet"], [
        list(row) for row in zip(names, counted(own(published)), counted(cross_check(published)))]


@number("robustness.tried")
def tried(published):
    return f"{own(published)['tried'].sum():,.0f}"


@number("robustness.near")
def near(published):
    """% of the cases with an event nearer than 1e-9 mean edges."""
    one = own(published)[own(published)["method"] == "example"]
    return percent(100 * one["near_event_cases"].sum() / one["cases"].sum())


@number("robustness.cross_check_wrong")
def cross_check_wrong(published):
    rows = cross_check(published)
    return percent(100 * rows["wrong"].sum() / rows["tried"].sum())


@condition("none_wrong", "no adversarial cut failed, was wrong, crashed or hung, of half a million or more")
def none_wrong(published):
    return own(published)[BROKEN].to_numpy().sum() == 0 and own(published)["tried"].sum() >= 500000


@condition("cisamr_refuses_most", "over half of the refused cuts are cisamr's")
def cisamr_refuses_most(published):
    refused = own(published).groupby("method")["refused"].sum()
    return refused["cisamr"] > refused.sum() / 2
