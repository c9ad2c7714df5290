// Seams: edges of the border at rest that are one line of the sheet, as where the panels of a garment are sewn
// together, or a tube is cut open to lie flat. Each side of a seam has vertices of its own at rest; in space they are
// one.
//
// Nothing of a seam is kept up to date: what is sewn to what follows from the border and the seams of the uncut sheet.
// Vertices that have seams are held at rest (Sheet::hold), and no border moves but along itself, so that an edge of the
// border lies on a seam just where both its ends do.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

class Sheet;

/// One edge of the uncut sheet, from both its sides: first[0] is sewn to second[0], first[1] to second[1]. Rest space.
struct Seam {
  std::array<Point2, 2> first, second;
  bool operator==(const Seam&) const = default;
};

/// The border edges of `mesh` whose ends are sewn to those of another one; of three such edges two are a seam each with
/// the first. Where vertices along a seam are not those of the other side, as a method leaves them that refines one
/// side alone, the straight lines between vertices that both have.
/// \pre `mesh` passed check_and_repair()
std::vector<Seam> seams_of(const MeshData& mesh);

/// A part of a seam's side: an edge of the border.
struct SewnEdge {
  HalfEdge edge;
  std::size_t seam;
  bool first;         ///< its side
  double begin, end;  ///< of the half-edge, along the seam: 0 at its [0], 1 at its [1]
  double low() const { return begin < end ? begin : end; }
  double high() const { return begin < end ? end : begin; }
};

/// Places along a seam that differ by less are one: both sides compute them with rounding.
constexpr double seam_rounding = 1e-7;

/// All of them, in order of the seams, the first side before the second, each from 0 to 1. Cost: the whole sheet.
std::vector<SewnEdge> sewn_edges(const Sheet& sheet);

/// What a seam asks of a vertex of the opened sheet: it goes along with one or two others.
struct SeamTie {
  DeformedIndex vertex;
  std::array<DeformedIndex, 2> masters;  ///< [1] is invalid where its weight is 0; may hang on those of another seam
  std::array<double, 2> weights;         ///< add up to 1
  bool operator==(const SeamTie&) const = default;
};

/// The ties that keep the sheet sewn. The lips of an incision that runs over a seam stay apart. A vertex that only one
/// side has hangs on the nearest two along the seam that both have: between these both sides are straight, so no gap
/// opens.
/// \param rank  per deformed slot: of those that are one, that of the highest rank is the master; one of pinned_rank
///              hangs on nothing. Empty: all are equal, and the first one is
/// Each vertex once, in rising order. Cost: the whole sheet.
std::vector<SeamTie> seam_ties(const Sheet& sheet, std::span<const std::uint8_t> rank = {});
constexpr std::uint8_t pinned_rank = 2;

}  // namespace cutbench
