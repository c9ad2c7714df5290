"""The frames of a scene, one folder for each method, and what the captions say of them."""

from analysis import frame_files, load, naming


def folders(results, scene):
    """The folders with the frames of each method."""
    found = sorted(d.parent for d in (results / scene).glob("*/simulation.json"))
    if not found:
        load.stop(f"{results / scene} has no frames; experiments/reproduce {results.name} makes them")
    return found


def read_shot(results, scene, time):
    """[(description, frame)] of each method at a time (s), in the order of every legend."""
    read = [(frame_files.read_description(d), d) for d in folders(results, scene)]
    known = [f"{method} {parameter}".strip() for method, parameter in naming.KNOWN]
    read.sort(key=lambda r: (known.index(r[0]["method"]) if r[0]["method"] in known else len(known), r[0]["method"]))
    return [(description, frame_files.read_frame(d, time)) for description, d in read]


def same(values, what):
    """The value that all panels share. Panels with different values are not compared: the program ends."""
    values = list(dict.fromkeys(values))
    if len(values) > 1:
        load.stop(f"the panels differ in {what}: {', '.join(map(str, values))}; simulate the scenes again")
    return values[0]


def commits(described):
    """`commit 0123456789`, or several."""
    names = {str(d["commit"] or "unknown")[:10] + (" with uncommitted changes" if d["dirty"] else "") for d in described}
    return "commit " + ", ".join(sorted(names))


def solvers(shots, panels):
    """`cholmod`, or by scene where they differ; of each scene it is the same."""
    def named(description):
        return (description["solver"] or "no solver") + (f" to {description['solver_tolerance']:g}" if description["solver"] == "cg" else "")
    names = [same((named(d) for d, _ in column), "the solver") for column in panels]
    names = [name + (f", {column[0][0]['newton']} solves a step" if column[0][0].get("newton", 1) > 1 else "")
             for name, column in zip(names, panels)]
    return names[0] if len(set(names)) == 1 else ", ".join(f"{s.title}: {n}" for s, n in zip(shots, names))
