#include "methods/variants.h"

#include <algorithm>
#include <string>
#include <utility>

#include "harness/base/conversions.h"
#include "methods/active_node/active_node.h"
#include "methods/adaptive_remesh/adaptive_remesh.h"
#include "methods/bowyer_watson/bowyer_watson.h"
#include "methods/bowyer_watson/split_readings.h"
#include "methods/cisamr/cisamr.h"
#include "methods/cut_polygons/cut_polygons.h"
#include "methods/global_remesh/global_remesh.h"
#include "methods/phantom_node/phantom_node.h"
#include "methods/warp_and_refine/warp_and_refine.h"

namespace cutbench {

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
    all.push_back({std::string("bowyer_watson:") + name, summary, rounds, promises_of(all, "bowyer_watson"),
                   [reading](double value) {
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

void append_polygons_and_copies(std::vector<MethodRow>& all) {
  all.push_back({"cut_polygons:stabilisation",
                 "cut_polygons with another stabilisation",
                 {"tau",
                  CutPolygons::Options().stabilisation,
                  "stabilisation of a polygon over Young's modulus, dimensionless: 0.5 makes a square the bilinear "
                  "quadrilateral, 1.5 as stiff as two triangles",
                  {.least = 0.01, .most = 10}},
                 promises_of(all, "cut_polygons"),
                 [](double tau) {
                   return std::make_unique<CutPolygons>(CutPolygons::Options{.thin = {}, .stabilisation = tau});
                 }});
  all.push_back({"cut_polygons:all_unknowns",
                 "cut_polygons without polygons that have a vertex inside",
                 {"thinness", 0.7, "as that of cut_polygons", {.least = 0, .most = 1}},
                 promises_of(all, "cut_polygons"),
                 [](double thinness) {
                   return std::make_unique<CutPolygons>(
                       CutPolygons::Options{.thin = {.thinness = thinness, .all_unknowns = true}});
                 }});
  all.push_back(
      {"phantom_node:consistent_mass",
       "phantom_node with the mass of its linear fields",
       {"ghost", 0, "ghost penalty, dimensionless, for statics: usually 0.01 to 1; 0: none", {.least = 0, .most = 100}},
       promises_of(all, "phantom_node"),
       [](double ghost) { return std::make_unique<PhantomNode>(CopyOptions{.lumped_mass = false, .ghost = ghost}); }});
}

}  // namespace

void append_variants(std::vector<MethodRow>& all) {
  append_tolerances(all);
  append_split_readings(all);
  append_deformed_terms(all);
  append_polygons_and_copies(all);
}

}  // namespace cutbench
