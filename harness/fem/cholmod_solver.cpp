#include "harness/fem/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <vector>

// Declared here, because <omp.h> may be that of another OpenMP library (clang's) than the one CHOLMOD runs on, which is
// GNU's and is linked by name.
extern "C" void omp_set_max_active_levels(int levels);

namespace cutbench {

namespace {

// A direct solve is as good as it can be where the backward error is at rounding level (Higham, Accuracy and Stability
// of Numerical Algorithms, 2002, 7.1), though on slivers |b - A x| / |b| may be far from it.
constexpr double accepted_residual = 1e-8, accepted_backward_error = 1e-12;  // see SolveReport

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

/// The lower triangle in compressed columns, over all unknowns. Held unknowns have 1 on the diagonal and nothing else.
template <int D>
class CompressedColumns {
 public:
  /// False where it has this pattern already.
  bool set_pattern(const SystemMatrix<D>& a);
  void set_values(const SystemMatrix<D>& a);
  double largest() const {  ///< |entry|, which no norm of the matrix is below
    double all = 0;
    for (const double v : values_) all = std::max(all, std::abs(v));
    return all;
  }
  cholmod_sparse view();
  /// METIS's order of the vertices, which share an unknown's neighbours, spread over their unknowns: a graph a D-th of
  /// the size, and as good an order. Empty where it fails.
  std::vector<std::int32_t> order(cholmod_common& common);

 private:
  /// Element `from` of a part's blocks, counted through all of them, is added to values_[to].
  struct Copy {
    std::int32_t from, to;
  };
  struct Source {
    std::int32_t column, part, slot;  ///< part 0: the blocks; k: scalar term k - 1
    bool operator<(const Source& other) const {
      return column != other.column ? column < other.column : part < other.part;
    }
  };
  void add_column(std::int32_t column, int coordinate);

  std::vector<std::int32_t> begin_, rows_;
  std::vector<double> values_;
  std::vector<std::int32_t> graph_begin_, graph_rows_;  // the lower triangle per vertex, likewise
  std::vector<std::int32_t> ones_;                      // places of the held unknowns in values_
  std::vector<std::vector<Copy>> copies_;               // per part
  std::vector<Source> sources_;                         // of one vertex, by column
  // What the pattern was made from.
  std::uint64_t pattern_ = 0;
  std::vector<std::uint8_t> held_;
  std::vector<const void*> parts_;
};

template <int D>
std::vector<const void*> parts_of(const SystemMatrix<D>& a) {
  std::vector<const void*> parts{a.blocks};
  for (const auto& term : a.scalar) parts.push_back(term.matrix);
  return parts;
}

template <int D>
bool CompressedColumns<D>::set_pattern(const SystemMatrix<D>& a) {
  std::vector<const void*> parts = parts_of(a);
  if (!begin_.empty() && pattern_ == a.pattern && parts_ == parts && held_ == *a.held) return false;
  pattern_ = a.pattern, parts_ = std::move(parts), held_ = *a.held;
  begin_.assign(1, 0), rows_.clear(), ones_.clear();
  graph_begin_.assign(1, 0), graph_rows_.clear();
  copies_.resize(parts_.size());
  for (auto& copies : copies_) copies.clear();
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    // Row i of the symmetric matrix is its column i.
    sources_.clear();
    const auto collect = [&](const auto& matrix, std::size_t part) {
      std::int32_t slot = matrix.first_slot(i);
      for (const std::int32_t j : matrix.columns(i)) {
        if (j >= static_cast<std::int32_t>(i)) sources_.push_back({j, static_cast<std::int32_t>(part), slot});
        ++slot;
      }
    };
    collect(*a.blocks, 0);
    for (std::size_t k = 0; k < a.scalar.size(); ++k) collect(*a.scalar[k].matrix, k + 1);
    std::sort(sources_.begin(), sources_.end());
    for (std::size_t k = 0; k < sources_.size(); ++k)
      if (k == 0 || sources_[k].column != sources_[k - 1].column) graph_rows_.push_back(sources_[k].column);
    graph_begin_.push_back(static_cast<std::int32_t>(graph_rows_.size()));
    for (int k = 0; k < D; ++k) add_column(static_cast<std::int32_t>(D * i) + k, k);
  }
  values_.resize(rows_.size());
  return true;
}

template <int D>
void CompressedColumns<D>::add_column(std::int32_t column, int coordinate) {
  const auto held = [&](std::int32_t unknown) { return held_[static_cast<std::size_t>(unknown)] != 0; };
  const auto next = [&] { return static_cast<std::int32_t>(rows_.size()); };
  if (held(column)) {
    ones_.push_back(next());
    rows_.push_back(column);
  } else {
    for (auto source = sources_.begin(); source != sources_.end();) {
      const auto end =
          std::find_if(source, sources_.end(), [&](const Source& other) { return other.column != source->column; });
      for (int k = 0; k < D; ++k) {
        const std::int32_t row = D * source->column + k, to = next();
        if (row < column || held(row)) continue;
        bool any = false;
        for (auto s = source; s != end; ++s) {
          if (s->part > 0 && k != coordinate) continue;
          // Entry (coordinate, k) of block (i, j), which is stored column by column, is (k, coordinate) of (j, i).
          const std::int32_t from = s->part > 0 ? s->slot : D * D * s->slot + D * k + coordinate;
          copies_[static_cast<std::size_t>(s->part)].push_back({from, to});
          any = true;
        }
        if (any) rows_.push_back(row);
      }
      source = end;
    }
  }
  begin_.push_back(next());
}

template <int D>
void CompressedColumns<D>::set_values(const SystemMatrix<D>& a) {
  std::fill(values_.begin(), values_.end(), 0.0);
  const auto value = [&](std::int32_t to) -> double& { return values_[static_cast<std::size_t>(to)]; };
  for (const std::int32_t to : ones_) value(to) = 1;
  for (const Copy& copy : copies_[0]) value(copy.to) += a.blocks->block(copy.from / (D * D))(copy.from % (D * D));
  for (std::size_t k = 0; k < a.scalar.size(); ++k)
    for (const Copy& copy : copies_[k + 1])
      value(copy.to) += a.scalar[k].factor * a.scalar[k].matrix->block(copy.from)(0);
}

/// Lower triangle of a symmetric matrix; `values` may be null: the pattern alone.
cholmod_sparse sparse_view(std::vector<std::int32_t>& begin, std::vector<std::int32_t>& rows, double* values) {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = begin.size() - 1;
  sparse.nzmax = rows.size();
  sparse.p = begin.data(), sparse.i = rows.data(), sparse.x = values;
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT, sparse.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN, sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = sparse.packed = 1;
  return sparse;
}

template <int D>
cholmod_sparse CompressedColumns<D>::view() {
  return sparse_view(begin_, rows_, values_.data());
}

template <int D>
std::vector<std::int32_t> CompressedColumns<D>::order(cholmod_common& common) {
  cholmod_sparse graph = sparse_view(graph_begin_, graph_rows_, nullptr);
  std::vector<std::int32_t> of_vertices(graph.ncol), of_unknowns;
  if (!cholmod_metis(&graph, nullptr, 0, 1, of_vertices.data(), &common)) return {};
  for (const std::int32_t i : of_vertices)
    for (int k = 0; k < D; ++k) of_unknowns.push_back(D * i + k);
  return of_unknowns;
}

cholmod_dense dense_view(Field& v) {
  cholmod_dense dense{};
  dense.nrow = dense.nzmax = dense.d = static_cast<std::size_t>(v.size());
  dense.ncol = 1;
  dense.x = v.data();
  dense.xtype = CHOLMOD_REAL, dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

template <int D>
class CholmodSolver final : public LinearSolver<D> {
 public:
  void setup(const SystemMatrix<D>& a) override {
    matrix_ = &a;
    cholmod_common& common = cholmod_.common;
    if (columns_.set_pattern(a)) cholmod_.free_factor();
    columns_.set_values(a);
    cholmod_sparse sparse = columns_.view();
    if (!cholmod_.factor) {
      std::vector<std::int32_t> order = columns_.order(common);
      if (!order.empty()) cholmod_.factor = cholmod_analyze_p(&sparse, order.data(), nullptr, 0, &common);
    }
    factored_ = cholmod_.factor && cholmod_factorize(&sparse, cholmod_.factor, &common) &&
                common.status == CHOLMOD_OK && cholmod_.factor->minor == cholmod_.factor->n;
  }

  SolveReport solve(const Field& b, Field& x, const Field& /*start*/) override {
    project(*matrix_->held, b, b_);
    x.setZero(b.size());
    const double norm = b_.norm();
    SolveReport report;
    const bool nothing = b_.isZero(0);
    report.residual = nothing ? 0 : 1;  // of x = 0
    if (!factored_) return report;
    // No iterative refinement: on slivers, where the residual is not at rounding level, it gains a factor of 1.5.
    if (!nothing) {
      if (!back_substitute(x)) return report;
      matrix_->multiply(x, r_);
      report.residual = (b_ - r_).norm() / norm;
    }
    report.converged = report.residual <= accepted_residual ||
                       report.residual * norm <= accepted_backward_error * columns_.largest() * x.norm();
    return report;
  }

 private:
  bool back_substitute(Field& x) {
    cholmod_dense right = dense_view(b_);
    if (!cholmod_solve2(CHOLMOD_A, cholmod_.factor, &right, nullptr, &cholmod_.solution, nullptr, &cholmod_.work_y,
                        &cholmod_.work_e, &cholmod_.common))
      return false;
    const auto* solution = static_cast<const double*>(cholmod_.solution->x);
    project(*matrix_->held, Eigen::Map<const Field>(solution, x.size()), x);
    return true;
  }

  Cholmod cholmod_;
  CompressedColumns<D> columns_;
  const SystemMatrix<D>* matrix_ = nullptr;
  bool factored_ = false;
  Field b_, r_;  ///< right-hand side, A x
};

}  // namespace

template <int D>
std::unique_ptr<LinearSolver<D>> make_cholmod_solver() {
  return std::make_unique<CholmodSolver<D>>();
}

template std::unique_ptr<LinearSolver<2>> make_cholmod_solver();
template std::unique_ptr<LinearSolver<3>> make_cholmod_solver();

}  // namespace cutbench
