#include "methods/registry.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/names.h"
#include "harness/mesh/mesh_data.h"
#include "methods/active_node/active_node.h"
#include "methods/adaptive_remesh/adaptive_remesh.h"
#include "methods/bowyer_watson/bowyer_watson.h"
#include "methods/cgal_cdt/cgal_cdt.h"
#include "methods/cgal_refine/cgal_refine.h"
#include "methods/cisamr/cisamr.h"
#include "methods/conventional_split/conventional_split.h"
#include "methods/cut_polygons/cut_polygons.h"
#include "methods/delaunay_refine/delaunay_refine.h"
#include "methods/edge_release/edge_release.h"
#include "methods/element_deletion/element_deletion.h"
#include "methods/example/example.h"
#include "methods/global_remesh/global_remesh.h"
#include "methods/longest_edge/longest_edge.h"
#include "methods/phantom_node/phantom_node.h"
#include "methods/snap_or_split/snap_or_split.h"
#include "methods/split_and_tie/split_and_tie.h"
#include "methods/variants.h"
#include "methods/vertex_snap/vertex_snap.h"
#include "methods/virtual_node/virtual_node.h"
#include "methods/warp_and_refine/warp_and_refine.h"

namespace cutbench {

namespace {

constexpr Promises exact_split{.exact_incision = true, .keeps_area = true, .conforming = true, .keeps_vertices = true};

/// The baseline, then by name.
std::vector<MethodRow>& table() {
  static std::vector<MethodRow> rows{
      {"conventional_split",
       "crossed triangles are divided into two, three or four, in a static order",
       {},
       exact_split,
       [](double) { return std::make_unique<ConventionalSplit>(); }},
      {"active_node",
       "after a Delaunay split a node goes along the path, flips edges, takes in what is near and leaves a vertex "
       "every h",
       {"spacing",
        1,
        "between vertices of the path, in mean rest edges; 0: every crossing stays",
        {.least = 0.25, .most = 4, .or_zero = true}},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 0, .chord_tolerances = 1}},
       [](double spacing) { return std::make_unique<ActiveNode>(ActiveNode::Options{.spacing = spacing}); }},
      {"adaptive_remesh",
       "edges round the cut are split, flipped and collapsed to a size field that is fine at the tips",
       {"tip",
        0.2,
        "edge length asked for at the tips, mean rest edges; 0: flips alone",
        {.least = 0.1, .most = 1, .or_zero = true}},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 0, .chord_tolerances = 1}},
       [](double tip) { return std::make_unique<AdaptiveRemesh>(AdaptiveRemesh::Options{.tip = tip}); }},
      {"bowyer_watson",
       "the paper's Bowyer-Watson in each crossed triangle, then its local split, stopped after `rounds`",
       {"rounds",
        1,
        "rounds of the local split; 0: the best diagonal alone",
        {.least = 0, .most = 6, .whole = true}},  // ill-shaped triangles multiply by 3.8 in each round
       exact_split,
       [](double rounds) { return std::make_unique<BowyerWatson>(BowyerWatson::Options{.rounds = to_int(rounds)}); }},
      {"cgal_cdt",
       "CGAL's constrained Delaunay triangulation of the strip of crossed triangles",
       {},
       exact_split,
       [](double) { return std::make_unique<CgalCdt>(); }},
      {"cgal_refine",
       "CGAL's Delaunay refinement round the cut",
       {"bound",
        3,
        "largest aspect ratio allowed outside forced wedges; 0: constrained Delaunay alone",
        {.least = 2, .most = 1000, .or_zero = true}},
       exact_split,
       [](double bound) {
         return std::make_unique<CgalRefine>(
             CgalRefine::Options{.bound = bound == 0 ? std::numeric_limits<double>::infinity() : bound});
       }},
      {"cisamr",
       "on structured grids vertices near the path move onto it; two phases of CISAMR, without refinement and tips",
       {},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 0, .chord_tolerances = 1}},
       [](double) { return std::make_unique<Cisamr>(path_tolerance); }},
      {"cut_polygons",
       "conventional split; thin parts and their neighbours are one element together, a polygon",
       {"thinness",
        0.7,
        "4 area / perimeter over that of the divided triangle, below which a part is thin",
        {.least = 0, .most = 1}},
       exact_split,
       [](double thinness) {
         return std::make_unique<CutPolygons>(CutPolygons::Options{.thin = {.thinness = thinness}});
       }},
      {"delaunay_refine",
       "local Delaunay refinement round the cut, by off-centres",
       {"bound",
        3,
        "largest aspect ratio allowed outside forced wedges; 0: flips alone",
        {.least = 2, .most = 1000, .or_zero = true}},
       exact_split,
       [](double bound) {
         return std::make_unique<DelaunayRefine>(
             DelaunayRefinement::Options{.bound = bound == 0 ? std::numeric_limits<double>::infinity() : bound});
       }},
      {"edge_release",
       "the path is rounded to existing edges, which are opened: a staircase",
       {},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = true,
        .incision_bound = {.longest_edges = 1, .chord_tolerances = 1}},
       [](double) { return std::make_unique<EdgeRelease>(); }},
      {"element_deletion",
       "crossed triangles are removed from the sheet",
       {},
       {.exact_incision = false,
        .keeps_area = false,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 1, .chord_tolerances = 1}},
       [](double) { return std::make_unique<ElementDeletion>(); }},
      {"example",
       "an example to start from: crossed triangles are divided by the shorter diagonal",
       {},
       exact_split,
       [](double) { return std::make_unique<Example>(); }},
      {"global_remesh",
       "the whole sheet is meshed again by CGAL with the path in it",
       {},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 0, .chord_tolerances = 1}},
       [](double) { return std::make_unique<GlobalRemesh>(path_tolerance); }},
      {"longest_edge",
       "local split by longest-edge propagation, with Delaunay flips",
       {"cap",
        8,
        "vertices that the split may make, per vertex of the path; 0: flips alone",
        {.least = 0, .most = 100}},
       exact_split,
       [](double cap) { return std::make_unique<LongestEdge>(LongestEdge::Options{.cap = cap}); }},
      {"phantom_node",
       "crossed triangles are doubled with phantom nodes; the field is linear in each part without a tip",
       {},
       exact_split,
       [](double) { return std::make_unique<PhantomNode>(CopyOptions{}); }},
      {"snap_or_split",
       "crossings near a vertex move to the vertex, the others are split",
       {"tolerance", 0.25, "fraction of the edge up to which a crossing goes to the vertex", {.least = 0, .most = 0.5}},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = true,
        .incision_bound = {.longest_edges = 0.5, .chord_tolerances = 1}},
       [](double tolerance) { return std::make_unique<SnapOrSplit>(tolerance); }},
      {"split_and_tie",
       "conventional split; vertices of slivers are constrained to well-shaped triangles on their side",
       {"thinness",
        0.1,
        "altitude over the longest edge nearby below which a triangle is a sliver",
        {.least = 0, .most = 0.3}},
       exact_split,
       [](double thinness) { return std::make_unique<SplitAndTie>(SplitAndTie::Options{.thinness = thinness}); }},
      {"vertex_snap",
       "the nearest vertices move onto the path, the remaining crossings are split",
       {"reach", 0.5, "fraction of the edge over which a vertex comes to a crossing", {.least = 0, .most = 0.5}},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 1, .chord_tolerances = 1}},
       [](double reach) { return std::make_unique<VertexSnap>(VertexSnap::Options{.reach = reach}); }},
      {"virtual_node",
       "crossed triangles are copied whole, each copy with the material of a piece",
       {},
       exact_split,
       [](double) { return std::make_unique<VirtualNode>(); }},
      {"warp_and_refine",
       "vertices near the path move onto it, short edges are removed, flips and smoothing, then refinement",
       {"reach", 0.4, "fraction of the edge over which a vertex comes to a crossing", {.least = 0, .most = 0.5}},
       {.exact_incision = false,
        .keeps_area = true,
        .conforming = true,
        .keeps_vertices = false,
        .incision_bound = {.longest_edges = 0, .chord_tolerances = 1}},
       [](double reach) {
         WarpAndRefine::Options options;
         options.warping.reach = reach;
         return std::make_unique<WarpAndRefine>(options);
       }},
  };
  return rows;
}

}  // namespace

const std::vector<MethodRow>& all_methods() { return table(); }

namespace {

std::vector<MethodRow>& nameable_table() {
  static auto rows = [] {
    std::vector<MethodRow> all = all_methods();
    all.insert(all.end(), ablation_methods().begin(), ablation_methods().end());
    append_variants(all);
    return all;
  }();
  return rows;
}

}  // namespace

const std::vector<MethodRow>& nameable_methods() { return nameable_table(); }

void add_methods(const std::vector<MethodRow>& more) {
  std::vector<MethodRow>& nameable = nameable_table();
  for (const MethodRow& row : more) {
    if (std::any_of(table().begin(), table().end(), [&](const MethodRow& r) { return r.name == row.name; }))
      throw InputError("method \"" + row.name + "\" is in the table; choose another name");
    table().push_back(row);
    nameable.push_back(row);
  }
}

const MethodRow& find_method(const std::string& name) {
  const auto& rows = nameable_methods();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const MethodRow& r) { return r.name == name; });
  if (row != rows.end()) return *row;
  std::vector<std::string> known;
  for (const auto& r : all_methods()) known.push_back(r.name);
  throw InputError("unknown method \"" + name + "\"; " + suggestion(name, known, "`cutbench methods` lists them"));
}

}  // namespace cutbench
