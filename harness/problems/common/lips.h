// The lips of a cut as a method opened them, and how far they gape.
#pragma once

#include <vector>

#include "harness/fem/tips/tip_functions.h"
#include "harness/problems/common/elastic_field.h"
#include "harness/problems/common/stress_intensity.h"

namespace cutbench {

/// A place on the requested curve, and the length of the curve that it stands for.
struct LipSample {
  Point2 at, normal;
  double length;
};

/// The gape at each sample, m along its normal: that of the nearest opened edge at that place. 0 where no opened edge
/// is within `reach`: the curve was not opened there.
/// `of_tips` are coefficients of `functions`, which may be null.
std::vector<double> opening(const Sheet& sheet, const Field& displacement, const std::vector<LipSample>& samples,
                            double reach, const TipFunctions* functions = nullptr, const Eigen::VectorXd& of_tips = {});
/// The same of an exact field.
std::vector<double> opening(const ElasticField& field, const std::vector<LipSample>& samples);

/// The L2 norm of found - exact along the curve, over that of exact: the measure `opening`.
/// \pre a value for each sample
double opening_error(const std::vector<LipSample>& samples, const std::vector<double>& found,
                     const std::vector<double>& exact);

}  // namespace cutbench
