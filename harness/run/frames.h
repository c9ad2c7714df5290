// A moving sheet as other programs read it: a VTU file per frame, a PVD file that gives each its time (ParaView, VTK),
// and the last frame as an OBJ with the rest positions as `vt` (Blender, and `cutbench` itself).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

class Frames {
 public:
  /// Makes the folder where it isn't there; files of the names below are replaced.
  /// Throws InputError: no folder to make it in, or no right to write there.
  explicit Frames(const std::filesystem::path& folder);

  /// frame_0000.vtu and so on: see write_mesh(). \param posed  where the vertices are at that time (s)
  void add(const Sheet& posed, double time);
  /// frames.pvd, which names the frames of this run and no others, and last.obj.
  void finish(const Sheet& posed) const;

 private:
  std::filesystem::path folder_;
  std::vector<double> times_;
};

}  // namespace cutbench
