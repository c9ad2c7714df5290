#include "harness/fem/linear/compressed_columns.h"

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

template <int D>
std::vector<const void*> parts_of(const SystemMatrix<D>& a) {
  std::vector<const void*> parts{a.blocks};
  for (const auto& term : a.scalar) parts.push_back(term.matrix);
  return parts;
}

}  // namespace

template <int D>
bool CompressedColumns<D>::has_pattern(const SystemMatrix<D>& a) const {
  return !begin_.empty() && pattern_ == a.pattern && parts_ == parts_of(a) && held_ == *a.held;
}

template <int D>
bool CompressedColumns<D>::set_pattern(const SystemMatrix<D>& a) {
  if (has_pattern(a)) return false;
  pattern_ = a.pattern;
  parts_ = parts_of(a);
  held_ = *a.held;
  begin_.assign(1, 0);
  rows_.clear();
  ones_.clear();
  graph_begin_.assign(1, 0);
  graph_rows_.clear();
  copies_.resize(parts_.size());
  for (auto& copies : copies_) copies.clear();
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    // Row i of the symmetric matrix is its column i.
    sources_.clear();
    const auto collect = [&](const auto& matrix, std::size_t part) {
      std::int32_t slot = matrix.first_slot(i);
      for (const std::int32_t j : matrix.columns(i)) {
        if (j >= to_int32(i)) sources_.push_back({j, to_int32(part), slot});
        ++slot;
      }
    };
    collect(*a.blocks, 0);
    for (std::size_t k = 0; k < a.scalar.size(); ++k) collect(*a.scalar[k].matrix, k + 1);
    std::sort(sources_.begin(), sources_.end());
    for (std::size_t k = 0; k < sources_.size(); ++k)
      if (k == 0 || sources_[k].column != sources_[k - 1].column) graph_rows_.push_back(sources_[k].column);
    graph_begin_.push_back(to_int32(graph_rows_.size()));
    for (int k = 0; k < D; ++k) add_column(to_int32(D * i) + k, k);
  }
  values_.resize(rows_.size());
  return true;
}

template <int D>
void CompressedColumns<D>::add_column(std::int32_t column, int coordinate) {
  const auto held = [&](std::int32_t unknown) { return held_[to_size(unknown)] != 0; };
  const auto next = [&] { return to_int32(rows_.size()); };
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
          copies_[to_size(s->part)].push_back({from, to});
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
  const auto value = [&](std::int32_t to) -> double& { return values_[to_size(to)]; };
  for (const std::int32_t to : ones_) value(to) = 1;
  for (const Copy& copy : copies_[0]) value(copy.to) += a.blocks->block(copy.from / (D * D))(copy.from % (D * D));
  for (std::size_t k = 0; k < a.scalar.size(); ++k)
    for (const Copy& copy : copies_[k + 1])
      value(copy.to) += a.scalar[k].factor * a.scalar[k].matrix->block(copy.from)(0);
}

template class CompressedColumns<1>;
template class CompressedColumns<2>;
template class CompressedColumns<3>;

}  // namespace cutbench
