"""Remedies for thin triangles."""

from analysis.methods import remedies
from pages.facts.table import condition, number, plain, signed, table

COLUMNS = {"conventional_split": "-", "cut_polygons": "the unknowns", "split_and_tie": "the unknowns", "active_node": "the mesh",
           "phantom_node": "unknowns and mass", "phantom_node:consistent_mass": "the unknowns", "virtual_node": "unknowns and mass",
           "warp_and_refine": "the mesh", "snap_or_split": "the path", "edge_release": "the path", "adaptive_remesh": "the mesh", "delaunay_refine": "the mesh"}
MEDIAN, HIGH, WORST, ERROR, ENDS, MASS = 2, 3, 4, 9, 10, -1  # places in rows_of()


def shown(row):
    return row[0] in COLUMNS and row[MASS] != "scaled" and not (row[0].startswith("phantom_node") and row[1] in ("ghost=0.1", "ghost=0.01"))


@table("remedies")
def of_remedies(published):
    head = ["remedy", "changes", "eigenvalue: median", "95 %", "error, % [95 %]"]
    rows = []
    for row in filter(shown, published.remedies):
        changes = COLUMNS[row[0]] if not row[MASS] else "the mass" if row[0] == "conventional_split" else "mesh and mass"
        rows.append([remedies.label(row[0], "", row[MASS]), changes, plain(row[MEDIAN]), plain(row[HIGH]),
                     f"{signed(row[ERROR])} [{', '.join(signed(end) for end in row[ENDS])}]"])
    return head, rows


@number("remedies.cuts")
def cuts(published):
    return f"{published.remedy_cuts:,}"


@condition("stabilised_bounds", "with a stabilised mass the worst eigenvalue of all cuts is below 3")
def stabilised_bounds(published):
    return all(row[WORST] < 3 for row in published.remedies if row[MASS] == "stabilised")
