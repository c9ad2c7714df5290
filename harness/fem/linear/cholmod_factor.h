// Supernodal Cholesky factorisation by CHOLMOD (Chen, Davis, Hager and Rajamanickam, ACM TOMS 35(3), 2008) in METIS
// ordering (Karypis and Kumar, SIAM J. Sci. Comput. 20(1), 1998), on one thread.
#pragma once

#include "harness/fem/linear/factor.h"

namespace cutbench {

template <int D>
class CholmodFactor final : public Factor<D> {
 public:
  explicit CholmodFactor(FactorOrder order = FactorOrder::anew);
  ~CholmodFactor() override;
  bool factor(const SystemMatrix<D>& a) override;
  bool is_new(const SystemMatrix<D>& a) const override;
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) override;
  double largest_entry() const override;
  std::size_t new_orders() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cutbench
