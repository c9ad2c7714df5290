// Warp and refine
#pragma once

#include "harness/cut/cutting_method.h"
#include "harness/cut/embed_plainly.h"
#include "harness/cut/path_curve.h"
#include "harness/cut/reshape.h"
#include "harness/cut/warp.h"

namespace cutbench {

class WarpAndRefine : public CuttingMethod {
 public:
  struct Options {
    bool warp = true, thin = true, flip = true, smooth = true, refine = true;
    Warp::Options warping;
    Reshape::Options reshaping;
  };
  explicit WarpAndRefine(const Options& options)
      : options_(options), warp_(options.warping), reshape_(options.reshaping) {}

  void embed(Sheet& sheet, Subdivision& trace) override;
  void improve(Sheet& sheet) override;
  int recovered_segments() const override { return recovered_; }

 private:
  Options options_;
  Warp warp_;
  PathCurve curve_;
  Reshape reshape_;
  PatchWork work_;
  int recovered_ = 0;
};

}  // namespace cutbench
