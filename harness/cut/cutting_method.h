// SPDX-License-Identifier: MIT
// The socket for cutting methods: one class, one required function.
//
// The harness traces the path, calls embed() and improve(), opens the incision, takes the times and undoes a cut that
// failed; a method only changes triangles, through the sheet's editing calls, and holds no timer, counter, log or file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/mesh/ties.h"
#include "harness/path/subdivision.h"

namespace cutbench {

class CuttingMethod {
 public:
  virtual ~CuttingMethod() = default;

  /// A reason, known before the cut, why this method can't cut this sheet: the cut is refused and nothing changed.
  virtual std::optional<std::string> why_unsupported(const Sheet&) const { return {}; }

  /// Changes the mesh so that every segment of the trace is a chain of edges marked `path`. Sheet vertices made for the
  /// nodes are entered in them (Subdivision::Node::vertex). Pieces along edges are marked by the harness afterwards.
  /// A method that does not promise exact_incision may put another trace in its place, of the same sheet.
  /// Throws CutFailed, or CutRefused.
  virtual void embed(Sheet& sheet, Subdivision& trace) = 0;

  /// Improves the mesh round the embedded path, still closed. May divide a marked edge; must not flip, move or lose
  /// one.
  virtual void improve(Sheet&) {}

  /// Whether ties() may give any, of phantoms, too, and such as make sense at rest alone: to be known before a cut.
  enum class Tying : std::uint8_t { nothing, vertices, phantoms, phantoms_at_rest };
  virtual Tying tying() const { return Tying::nothing; }
  /// What is to be solved for on a sheet that this method cut, any number of times; none: every vertex of its own.
  /// Looks at everything, and depends on the two sheets alone. \param before  the sheet that the first cut was made in,
  /// of whose slots none has moved since (Sheet::compact would)
  virtual Ties ties(const Sheet& /*before*/, const Sheet& /*cut*/) const { return {}; }

  /// Path segments that embed() had to recover because its triangulation did not contain them, in the last cut.
  virtual int recovered_segments() const { return 0; }

  /// improve() met a limit of its own in the last cut, and left the rest as it was.
  virtual bool stopped_early() const { return false; }
};

/// The one number of a method that may be swept.
struct Knob {
  std::string name;  ///< empty: the method has none
  double value = 0;  ///< default
  std::string meaning;
};

/// What a method guarantees for every cut it does not refuse. The tests hold it to that.
struct Promises {
  bool exact_incision = false;  ///< opens the traced path itself: no shortcut, no shift
  bool keeps_area = false;      ///< the rest area is unchanged
  bool conforming = false;      ///< the result is a conforming triangulation
  bool keeps_vertices = false;  ///< no vertex of the sheet moves in rest space
};

/// A row of the table of methods.
struct MethodRow {
  std::string name, summary;
  Knob knob;
  Promises promises;
  std::function<std::unique_ptr<CuttingMethod>(double knob)> make;  ///< throws InputError: a value out of range
};

}  // namespace cutbench
