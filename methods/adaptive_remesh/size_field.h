// The edge length that adaptive_remesh asks for at a point: small at the tips of incisions, and growing with the
// distance from them up to the mean edge of the sheet,
//
//     s(p) = min(h, h_tip + g |p - nearest tip|).
//
// It is smaller where the deformed sheet asks for less (methods/adaptive_remesh/deformed_metric.h): a vertex has a
// metric m, the mean of its triangles' by area, each between 1 / h^2 and 1 / h_tip^2, and the edge a b has the length
// |e| sqrt((m_a + m_b) / 2), which is that of ARCSim for a metric without direction.
//
// Source: a size field as in Narain, Samii and O'Brien 2012, there a tensor; fine at the tips as in Pfaff, Narain, de
// Joya and O'Brien 2014, there from stress and round vertices that are about to tear. g bounds the gradation
// (Borouchaki, Hecht and Frey 1998; not read) of the first term alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

class SizeField {
 public:
  /// Forgets all tips and metrics. Lengths in rest units. \pre 0 < at_tip <= far, growth > 0
  /// \param vertices  slots of the sheet
  void begin(double far, double at_tip, double growth, std::size_t vertices) {
    far_ = far;
    at_tip_ = at_tip;
    growth_ = growth;
    tips_.clear();
    metric_.clear(vertices);
    has_metrics_ = false;
  }
  void add_tip(Point2 tip) { tips_.push_back(tip); }

  /// Farther from every tip, the field is `far`.
  double reach() const { return (far_ - at_tip_) / growth_; }

  double operator()(Point2 p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point2 tip : tips_) nearest = std::min(nearest, squared_length(p - tip));
    return std::min(far_, at_tip_ + growth_ * std::sqrt(nearest));
  }
  /// m of a triangle or vertex, within its bounds.
  double bounded(double metric) const { return std::clamp(metric, 1 / (far_ * far_), 1 / (at_tip_ * at_tip_)); }
  /// \param metric  bounded; where it is the least, it asks for nothing
  void set_metric(VertexIndex v, double metric) {
    metric_.grow(v() + 1);
    metric_.set(v, metric);
    has_metrics_ |= metric > bounded(0);
  }
  /// A vertex on the edge a b gets the mean of theirs.
  void set_between(VertexIndex v, VertexIndex a, VertexIndex b) {
    if (has_metrics_) set_metric(v, (metric(a) + metric(b)) / 2);
  }

  /// Length of the edge a b over the field at its middle.
  double relative_length(const Sheet& sheet, VertexIndex a, VertexIndex b) const {
    const Point2 p = sheet.rest(a), q = sheet.rest(b);
    const double length = std::sqrt(squared_length(q - p)), by_tips = length / (*this)(0.5 * p + 0.5 * q);
    return has_metrics_ ? std::max(by_tips, length * std::sqrt((metric(a) + metric(b)) / 2)) : by_tips;
  }

 private:
  double metric(VertexIndex v) const { return v() < metric_.size() ? metric_.get(v, bounded(0)) : bounded(0); }

  double far_ = 0, at_tip_ = 0, growth_ = 0;
  std::vector<Point2> tips_;
  StampedTable<VertexIndex, double> metric_;
  bool has_metrics_ = false;  // some vertex asks for shorter edges than `far`
};

}  // namespace cutbench
