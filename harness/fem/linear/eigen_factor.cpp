#include <Eigen/SparseCholesky>

#include "harness/base/conversions.h"
#include "harness/fem/linear/compressed_columns.h"
#include "harness/fem/linear/factor.h"

namespace cutbench {

namespace {

/// The order is made anew where the pattern has changed.
template <int D>
class EigenFactor final : public Factor<D> {
 public:
  bool factor(const SystemMatrix<D>& a) override {
    const bool is_new = columns_.set_pattern(a);
    columns_.set_values(a);
    held_ = *a.held;
    const auto lower = columns_.lower_triangle();
    if (is_new) ldlt_.analyzePattern(lower);
    if (!columns_.all_finite()) return false;
    ldlt_.factorize(lower);
    return ldlt_.info() == Eigen::Success && ldlt_.vectorD().minCoeff() > 0;
  }
  bool is_new(const SystemMatrix<D>& a) const override { return !columns_.has_pattern(a); }
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) override {
    x = ldlt_.solve(b);
    for (std::size_t u = 0; u < held_.size(); ++u)
      if (held_[u]) x.row(to_index(u)).setZero();
    return true;
  }
  double largest_entry() const override { return columns_.largest(); }

 private:
  CompressedColumns<D> columns_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt_;
  std::vector<std::uint8_t> held_;
};

}  // namespace

template <int D>
std::unique_ptr<Factor<D>> make_eigen_factor() {
  return std::make_unique<EigenFactor<D>>();
}

template std::unique_ptr<Factor<1>> make_eigen_factor();
template std::unique_ptr<Factor<2>> make_eigen_factor();
template std::unique_ptr<Factor<3>> make_eigen_factor();

}  // namespace cutbench
