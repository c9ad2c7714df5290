"""The methods by what they do to the sheet: a colour and a marker for each family, not for each method, and their names."""

from dataclasses import dataclass

from analysis import naming


@dataclass(frozen=True)
class Family:
    name: str
    colour: str
    marker: str
    methods: tuple = ()


FAMILIES = [
    Family("moves vertices", "#0072b2", "o", ("warp_and_refine", "vertex_snap", "cisamr", "active_node")),
    Family("moves the path", "#d55e00", "s", ("snap_or_split", "edge_release")),
    Family("constrains or doubles vertices", "#7b3294", "D", ("split_and_tie", "cut_polygons", "phantom_node", "virtual_node")),
    Family("refines", "#009e73", "^", ("delaunay_refine", "cgal_refine", "longest_edge", "global_remesh",
                                       "adaptive_remesh")),
    Family("splits crossed triangles", "#111111", "v", ("conventional_split", "cgal_cdt", "bowyer_watson", "example")),
    Family("deletes triangles", "#b8860b", "X", ("element_deletion",)),
]
OTHER = Family("other methods", "#777777", "P")


def family(method):
    """Of `method` or `method:variant`."""
    return next((f for f in FAMILIES if method.partition(":")[0] in f.methods), OTHER)


def name(method, programs=()):
    """A method without its parameter."""
    return naming.words(method).replace(":", ", ") + naming.PROGRAM * (method in programs)


def grouped(methods):
    """[(family, its methods)]: both in the order of `methods`, best first, of which each is somewhere."""
    groups = {}
    for method in methods:
        groups.setdefault(family(method), []).append(method)
    return list(groups.items())
