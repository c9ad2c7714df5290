// What a computed field on a cut window is compared with, and by which measures.
#pragma once

#include "harness/problems/in_plane/border_work.h"
#include "harness/problems/in_plane/static_solve.h"
#include "harness/problems/in_plane/window_problem.h"

namespace cutbench {

/// The exact side of all measures, worked out once for all solutions on a cut sheet.
class WindowComparison {
 public:
  WindowComparison(const WindowCase& window, const Specimen& specimen, const Sheet& sheet, const StaticSolve& solve,
                   const ElasticField& field);
  std::vector<Measure> measures(const StaticSolve::Solution& solution) const;

 private:
  /// A point of a quadrature rule.
  struct Sample {
    Point2 from_corner;  ///< from the element's corner 0
    double weight;
    Eigen::Matrix2d stress;
    Eigen::Vector2d displacement;
  };
  struct SampledElement {
    std::size_t element, end;  ///< of its samples; they begin where those of the element before end
  };
  struct RimEdge {
    std::size_t element;
    Point2 middle;
    double length, hoop;  ///< exact hoop stress in its middle
    Eigen::Vector2d tangent;
  };
  /// What a norm of an error is made of.
  struct Sums {
    double energy = 0, error_energy = 0, error_squared = 0, exact_squared = 0, worst_stress = 0;
  };
  bool looked_at(std::size_t element) const;
  void find_fallen();
  void sample_elements();
  void find_rim();
  double work_on_lips() const;
  Sums sum(const StaticSolve::Solution& solution) const;
  double rim_error(const StaticSolve::Solution& solution) const;
  /// Over the tips where K is measured, of each tip's.
  StressIntensity mean(const std::function<StressIntensity(std::size_t i)>& of_tip) const;
  Point2 in_rest(Point2 local) const;
  Point2 turned(Point2 local) const;

  const WindowCase& window_;
  const Sheet& sheet_;
  const StaticSolve& solve_;
  const ElasticField& field_;
  BorderWork border_;
  double missing_ = 0;  ///< twice the exact energy of deleted material, J
  std::vector<std::uint8_t> fallen_;
  std::vector<SampledElement> elements_;
  std::vector<Sample> samples_;
  std::vector<LipSample> lips_;
  std::vector<double> opening_;
  std::vector<RimEdge> rim_;
  std::vector<Tip> tips_;  ///< where K is measured
  std::vector<InteractionIntegral> intensities_;
};

}  // namespace cutbench
