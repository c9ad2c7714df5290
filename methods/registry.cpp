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
#include "methods/bowyer_watson/split_readings.h"
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

const std::vector<MethodRow>& ablation_methods() {
  using Before = WarpAndRefine::Before;
  using After = WarpAndRefine::After;
  constexpr std::pair<Before, const char*> befores[] = {{Before::nothing, "nothing"},
                                                        {Before::snap, "snap"},
                                                        {Before::warp, "warp"},
                                                        {Before::thin, "thin"},
                                                        {Before::warp_and_thin, "warp+thin"}};
  constexpr std::pair<After, const char*> afters[] = {{After::nothing, "nothing"},
                                                      {After::flips, "flips"},
                                                      {After::smoothing, "smoothing"},
                                                      {After::refine, "refine"},
                                                      {After::constraint, "tie"}};
  static const auto rows = [&] {
    std::vector<MethodRow> made;
    for (const auto& [before, first] : befores)
      for (const auto& [after, then] : afters) {
        WarpAndRefine::Options options;
        options.before = before;
        options.after = after;
        const Promises promises{
            .keeps_area = true,
            .conforming = true,
            .incision_bound = {.longest_edges = before == Before::snap ? options.snap : 0, .chord_tolerances = 1}};
        made.push_back({std::string("ablation:") + first + ":" + then,
                        "warp_and_refine, in part",
                        {},
                        promises,
                        [options](double) { return std::make_unique<WarpAndRefine>(options); }});
      }
    return made;
  }();
  return rows;
}

namespace {

const Promises& promises_of(const std::vector<MethodRow>& all, const std::string& name) {
  return std::find_if(all.begin(), all.end(), [&](const MethodRow& r) { return r.name == name; })->promises;
}

/// The methods that may simplify the path, each with this licence as its parameter.
void append_tolerances(std::vector<MethodRow>& all) {
  const Parameter tolerance{
      "tolerance",
      path_tolerance,
      "largest distance of the path that was asked for from the incision's edges, mean rest edges, or "
      "the chord tolerance where that is smaller; 0: every crossing stays",
      {.least = 0, .most = 0.5}};
  const auto append = [&](const char* name, auto make) {
    all.push_back({std::string(name) + ":tolerance", std::string(name) + " with another tolerance for the path",
                   tolerance, promises_of(all, name), make});
  };
  append("active_node", [](double to) { return std::make_unique<ActiveNode>(ActiveNode::Options{.tolerance = to}); });
  append("adaptive_remesh",
         [](double to) { return std::make_unique<AdaptiveRemesh>(AdaptiveRemesh::Options{.tolerance = to}); });
  append("cisamr", [](double to) { return std::make_unique<Cisamr>(to); });
  append("global_remesh", [](double to) { return std::make_unique<GlobalRemesh>(to); });
  append("warp_and_refine", [](double to) {
    WarpAndRefine::Options options;
    options.warping.tolerance = to;
    options.reshaping.tolerance = to;
    return std::make_unique<WarpAndRefine>(options);
  });
}

/// adaptive_remesh with another weight of what the deformed sheet asks for.
void append_deformed_terms(std::vector<MethodRow>& all) {
  const auto append = [&](const char* name, const char* of, Parameter parameter, double DeformedTerms::*of_term) {
    parameter.value = DeformedTerms().*of_term;
    all.push_back({std::string("adaptive_remesh:") + name, std::string("adaptive_remesh with another term of ") + of,
                   parameter, promises_of(all, "adaptive_remesh"), [of_term](double value) {
                     AdaptiveRemesh::Options options;
                     options.deformed.*of_term = value;
                     return std::make_unique<AdaptiveRemesh>(options);
                   }});
  };
  append("angle", "curvature",
         {"angle",
          0,
          "by which the sheet bends along an edge at most, radians; 0: no such term",
          {.least = 0.05, .most = 3, .or_zero = true}},
         &DeformedTerms::angle);
  append("compression", "compression",
         {"amplitude",
          0,
          "amplitude of the buckles for which a compressed sheet is made fine, mean rest edges; 0: no such term",
          {.least = 0.01, .most = 10, .or_zero = true}},
         &DeformedTerms::compression);
  append("velocity", "velocity",
         {"velocity",
          0,
          "by which the ends of an edge differ at most in a moving sheet, m/s; 0: no such term",
          {.least = 0.01, .most = 100, .or_zero = true}},
         &DeformedTerms::velocity);
  append("stress", "stress",
         {"stress",
          0,
          "over Young's modulus, for which a moving sheet is as fine as at a tip; 0: no such term",
          {.least = 1e-4, .most = 10, .or_zero = true}},
         &DeformedTerms::stress);
}

/// The paper's local split, read otherwise.
void append_split_readings(std::vector<MethodRow>& all) {
  using Reading = SplitReading::Reading;
  const Parameter rounds{"rounds", 1, "rounds of the local split", {.least = 0, .most = 6, .whole = true}};
  const auto append = [&](const char* name, const char* summary, Reading reading) {
    all.push_back({std::string("bowyer_watson:") + name, summary, rounds, exact_split, [reading](double value) {
                     return std::make_unique<SplitReading>(reading, BowyerWatson::Options{.rounds = to_int(value)});
                   }});
  };
  append("grouped", "bowyer_watson, midpoints of all that lies in one triangle of the sheet at a time",
         Reading::grouped);
  append("region", "bowyer_watson, the local split's Delaunay triangulation over all that the cut changed",
         Reading::region);
  append("longest_edge", "bowyer_watson over all that the cut changed, midpoints of the longest edge alone",
         Reading::longest_edge);
}

std::vector<MethodRow>& nameable_table() {
  static auto rows = [] {
    std::vector<MethodRow> all = all_methods();
    all.insert(all.end(), ablation_methods().begin(), ablation_methods().end());
    append_tolerances(all);
    append_split_readings(all);
    append_deformed_terms(all);
    all.push_back({"cut_polygons:stabilisation",
                   "cut_polygons with another stabilisation",
                   {"tau",
                    CutPolygons::Options().stabilisation,
                    "stabilisation of a polygon over Young's modulus, dimensionless: 0.5 makes a square the bilinear "
                    "quadrilateral, 1.5 as stiff as two triangles",
                    {.least = 0.01, .most = 10}},
                   exact_split,
                   [](double tau) {
                     return std::make_unique<CutPolygons>(CutPolygons::Options{.thin = {}, .stabilisation = tau});
                   }});
    all.push_back({"cut_polygons:all_unknowns",
                   "cut_polygons without polygons that have a vertex inside",
                   {"thinness", 0.7, "as that of cut_polygons", {.least = 0, .most = 1}},
                   exact_split,
                   [](double thinness) {
                     return std::make_unique<CutPolygons>(
                         CutPolygons::Options{.thin = {.thinness = thinness, .all_unknowns = true}});
                   }});
    all.push_back({"phantom_node:consistent_mass",
                   "phantom_node with the mass of its linear fields",
                   {"ghost",
                    0,
                    "ghost penalty, dimensionless, for statics: usually 0.01 to 1; 0: none",
                    {.least = 0, .most = 100}},
                   exact_split,
                   [](double ghost) {
                     return std::make_unique<PhantomNode>(CopyOptions{.lumped_mass = false, .ghost = ghost});
                   }});
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
