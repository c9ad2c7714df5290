#include "harness/fem/linear/cholmod_factor.h"

#include <cholmod.h>

#include <numeric>

#include "harness/base/conversions.h"
#include "harness/fem/linear/compressed_columns.h"

// Declared here, because <omp.h> may be that of another OpenMP library (clang's) than the one CHOLMOD runs on, which is
// GNU's and is linked by name.
extern "C" void omp_set_max_active_levels(int levels);

namespace cutbench {

namespace {

constexpr double outgrown = 1.25;  // entries of the factor over those in the last new order

/// cholmod_common and what belongs to it.
struct Cholmod {
  Cholmod() {
    // Debian's CHOLMOD asks for 4 threads whatever OMP_NUM_THREADS says. With no parallel region allowed it gets one.
    omp_set_max_active_levels(0);
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.print = 0;  // failures are reported, not printed
  }
  ~Cholmod() {
    free_factor();
    for (cholmod_dense** dense : {&solution, &work_y, &work_e}) cholmod_free_dense(dense, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  void free_factor() { cholmod_free_factor(&factor, &common); }

  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *work_y = nullptr, *work_e = nullptr;  // kept from solve to solve
};

/// Lower triangle of a symmetric matrix, which CHOLMOD only reads; `values` may be null: the pattern alone.
cholmod_sparse sparse_view(const std::vector<std::int32_t>& begin, const std::vector<std::int32_t>& rows,
                           const double* values) {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = begin.size() - 1;
  sparse.nzmax = rows.size();
  sparse.p = const_cast<std::int32_t*>(begin.data());
  sparse.i = const_cast<std::int32_t*>(rows.data());
  sparse.x = const_cast<double*>(values);
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = sparse.packed = 1;
  return sparse;
}

cholmod_dense dense_view(const Eigen::MatrixXd& b) {
  cholmod_dense dense{};
  dense.nrow = dense.d = to_size(b.rows());
  dense.ncol = to_size(b.cols());
  dense.nzmax = dense.nrow * dense.ncol;
  dense.x = const_cast<double*>(b.data());
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

}  // namespace

template <int D>
struct CholmodFactor<D>::Parts {
  explicit Parts(FactorOrder when) : order(when) {}
  void analyse(cholmod_sparse& sparse);
  std::vector<std::int32_t> metis_order();
  std::vector<std::int32_t> extended_order() const;
  bool analyse(cholmod_sparse& sparse, std::vector<std::int32_t> vertices);

  FactorOrder order;
  Cholmod cholmod;
  CompressedColumns<D> columns;
  std::vector<std::int32_t> vertices;  // in the order of elimination
  double entries_of_new_order = 0;
  std::size_t new_orders = 0;
  std::vector<std::uint8_t> held;
};

/// METIS's order of the vertices; empty where it fails.
template <int D>
std::vector<std::int32_t> CholmodFactor<D>::Parts::metis_order() {
  ++new_orders;
  cholmod_sparse graph = sparse_view(columns.graph_begin(), columns.graph_rows(), nullptr);
  std::vector<std::int32_t> all(graph.ncol);
  if (!cholmod_metis(&graph, nullptr, 0, 1, all.data(), &cholmod.common)) all.clear();
  return all;
}

template <int D>
std::vector<std::int32_t> CholmodFactor<D>::Parts::extended_order() const {
  const std::size_t n = columns.graph_begin().size() - 1;
  // The places of old vertices, and for a new one the place of the neighbour that it follows.
  std::vector<std::int32_t> place(n, -1), all(n);
  for (std::size_t k = 0; k < vertices.size(); ++k) place[to_size(vertices[k])] = to_int32(k);
  const auto follow = [&](std::int32_t v, std::int32_t neighbour) {
    if (v < to_int32(vertices.size())) return;
    auto& mine = place[to_size(v)];
    mine = std::max(mine, place[to_size(neighbour)]);
  };
  for (std::size_t j = 0; j < n; ++j)
    for (std::int32_t k = columns.graph_begin()[j]; k < columns.graph_begin()[j + 1]; ++k) {
      const std::int32_t i = columns.graph_rows()[to_size(k)];
      follow(i, to_int32(j));
      follow(to_int32(j), i);
    }
  std::iota(all.begin(), all.end(), 0);
  std::stable_sort(all.begin(), all.end(),
                   [&](std::int32_t a, std::int32_t b) { return place[to_size(a)] < place[to_size(b)]; });
  return all;
}

template <int D>
bool CholmodFactor<D>::Parts::analyse(cholmod_sparse& sparse, std::vector<std::int32_t> by) {
  cholmod.free_factor();
  vertices = std::move(by);
  std::vector<std::int32_t> unknowns;
  for (const std::int32_t v : vertices)
    for (int k = 0; k < D; ++k) unknowns.push_back(D * v + k);
  if (!unknowns.empty()) cholmod.factor = cholmod_analyze_p(&sparse, unknowns.data(), nullptr, 0, &cholmod.common);
  return cholmod.factor;
}

template <int D>
void CholmodFactor<D>::Parts::analyse(cholmod_sparse& sparse) {
  const bool extends =
      order == FactorOrder::extended && !vertices.empty() && vertices.size() + 1 <= columns.graph_begin().size();
  if (extends && analyse(sparse, extended_order()) && cholmod.common.lnz <= outgrown * entries_of_new_order) return;
  if (analyse(sparse, metis_order())) entries_of_new_order = cholmod.common.lnz;
}

template <int D>
CholmodFactor<D>::CholmodFactor(FactorOrder order) : parts_(std::make_unique<Parts>(order)) {}
template <int D>
CholmodFactor<D>::~CholmodFactor() = default;

template <int D>
bool CholmodFactor<D>::factor(const SystemMatrix<D>& a) {
  Cholmod& cholmod = parts_->cholmod;
  CompressedColumns<D>& columns = parts_->columns;
  if (columns.set_pattern(a)) cholmod.free_factor();
  columns.set_values(a);
  parts_->held = *a.held;
  cholmod_sparse sparse = sparse_view(columns.begin(), columns.rows(), columns.values().data());
  if (!cholmod.factor) parts_->analyse(sparse);
  return cholmod.factor && cholmod_factorize(&sparse, cholmod.factor, &cholmod.common) &&
         cholmod.common.status == CHOLMOD_OK && cholmod.factor->minor == cholmod.factor->n;
}

template <int D>
bool CholmodFactor<D>::is_new(const SystemMatrix<D>& a) const {
  return !parts_->cholmod.factor || !parts_->columns.has_pattern(a);
}

template <int D>
bool CholmodFactor<D>::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
  Cholmod& cholmod = parts_->cholmod;
  cholmod_dense right = dense_view(b);
  if (!cholmod_solve2(CHOLMOD_A, cholmod.factor, &right, nullptr, &cholmod.solution, nullptr, &cholmod.work_y,
                      &cholmod.work_e, &cholmod.common))
    return false;
  x = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(cholmod.solution->x), b.rows(), b.cols());
  for (std::size_t u = 0; u < parts_->held.size(); ++u)
    if (parts_->held[u]) x.row(to_index(u)).setZero();
  return true;
}

template <int D>
double CholmodFactor<D>::largest_entry() const {
  return parts_->columns.largest();
}

template <int D>
std::size_t CholmodFactor<D>::new_orders() const {
  return parts_->new_orders;
}

bool has_cholmod() { return true; }

std::string cholmod_version() {
  const auto part = [](int number) { return std::to_string(number); };
  return part(CHOLMOD_MAIN_VERSION) + "." + part(CHOLMOD_SUB_VERSION) + "." + part(CHOLMOD_SUBSUB_VERSION);
}

template <int D>
std::unique_ptr<Factor<D>> make_cholmod_factor(FactorOrder order) {
  return std::make_unique<CholmodFactor<D>>(order);
}

template std::unique_ptr<Factor<1>> make_cholmod_factor(FactorOrder);
template std::unique_ptr<Factor<2>> make_cholmod_factor(FactorOrder);
template std::unique_ptr<Factor<3>> make_cholmod_factor(FactorOrder);
template class CholmodFactor<1>;
template class CholmodFactor<2>;
template class CholmodFactor<3>;

}  // namespace cutbench
