// The work that is done on the sheet's border, of exact fields.
#pragma once

#include <functional>

#include "harness/problems/common/elastic_field.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

/// J: integrals round the unit square, half of t.u of the cut plate, and half of (t0.u - t.u0), 0 being before the cut.
struct BorderWork {
  double after = 0, released = 0;
};

/// By Gauss's rule, on panels that end where a cut crosses the border; without what is `cut_off`, of the field's frame.
BorderWork border_work(const ElasticField& field, const ElasticField& before, const std::vector<Curve>& cuts,
                       const std::function<bool(Complex)>& cut_off = {});

}  // namespace cutbench
