// The adversarial cuts of cuts that the robustness run draws from. They meet vertices, edges, older cuts and themselves
// exactly, or miss them by a few units in the last place.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

struct AdversarialCase {
  std::string family;       ///< how its first cut was drawn: one of adversarial_families()
  std::vector<Curve> cuts;  ///< one to five, made one after the other
};

std::span<const char* const> adversarial_families();
/// The cut families that its ordinary cuts are drawn from: always the same ones, whatever cut_families() gains, so that
/// a published seed gives the same cases in later versions.
std::span<const char* const> adversarial_cut_families();

/// Case i: depends on (seed, i) and the uncut sheet alone. Every curve passes check_curve().
AdversarialCase make_adversarial_case(std::uint64_t seed, std::size_t i, const Sheet& sheet);

/// The smallest distance, in mean rest edges, at which anything of the case just meets or just misses something: its
/// lines the sheet's vertices, its tips and corners the sheet's edges, and each cut the corners of those before it. By
/// brute force. 0 where they meet.
double nearest_event(const std::vector<Curve>& cuts, const Sheet& sheet);

}  // namespace cutbench
