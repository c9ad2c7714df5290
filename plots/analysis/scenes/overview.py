"""The scenes that have frames: their titles and order, and of each the method that is shown."""

from analysis import frame_files, load

METHOD = "bowyer_watson rounds=1"  # the paper's
SHOWN = ["warp_and_refine", METHOD]  # each scene by the first of these that cut it
ALIKE = {"fig8_edge_quality_cg", "fig8_edge_quality_hinges", "fig8_edge_quality_unconverged"}  # look like fig8_edge_quality_patches
TITLES = {
    "falling_piece": "A disc falls out of a sheet", "picked_cut": "A cut picked in motion",
    "progressive_cut": "A blade that advances", "fig5_single_cuts_curved": "Figure 5: a curved cut",
    "fig5_single_cuts_straight": "Figure 5: a straight cut", "fig6_partial_and_cutout_cutout": "Figure 6: a part cut out",
    "fig6_partial_and_cutout_partial": "Figure 6: a cut from a side", "fig7_recut_and_multiple_multiple": "Figure 7: several cuts",
    "fig7_recut_and_multiple_recut": "Figure 7: a cut across a cut", "fig8_edge_quality_patches": "Figure 8: the cut edge",
    "fig8_edge_quality_cg": "Figure 8, by CG", "fig8_edge_quality_hinges": "Figure 8, hinges",
    "fig8_edge_quality_unconverged": "Figure 8, CG stopped early", "fig10_level_of_detail": "Figure 10: a winding cut",
    "sewn_shirt": "A shirt is cut up the front", "skin_ellipse": "An ellipse out of skin", "sleeve_ring": "A sleeve is cut round",
}


def folders_of(results):
    """Of each scene that one of SHOWN cut, the folder by the first of these."""
    scenes = {}
    for file in results.glob("*/*/*/simulation.json"):
        method = frame_files.read_description(file.parent)["method"]
        rank = next((i for i, m in enumerate(SHOWN) if m in (method, method.partition(" ")[0])), None)
        if rank is not None:
            scenes.setdefault(file.parent.parent, []).append((rank, file.parent))
    if not scenes:
        load.stop(f"{results} has no frames by {' or '.join(SHOWN)}; experiments/reproduce fig5_single_cuts makes some")
    return sorted((min(found)[1] for found in scenes.values()), key=scene_number)


def title(scene):
    return TITLES.get(scene, scene.replace("_", " "))


def scene_number(folder):
    """Figures first, fig5 before fig10."""
    return [(not folder.parent.name.startswith("fig"), "")] + [(int(part) if part.isdigit() else 0, part)
            for part in folder.parent.name.replace("fig", "").split("_")]
