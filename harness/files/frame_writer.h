// A moving sheet as other programs read it: a VTU file per frame, a PVD file that gives each its time (ParaView, VTK),
// and the last frame as an OBJ with the rest positions as `vt` (Blender, and `cutbench` itself).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// Nothing of it is there before finish(): the frames wait in the folder `unfinished` of the folder.
class FrameWriter {
 public:
  /// Makes the folder where it isn't there. Throws InputError: no folder to make it in, or no right to write there.
  explicit FrameWriter(const std::filesystem::path& folder);
  /// Without finish(), all is as it was before.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// frame_0000.vtu and so on: see write_mesh(); with `held`, 1 at vertices that pins or loads act on.
  /// \param posed  where the vertices are at that time (s)
  void add(const Sheet& posed, double time);
  /// Puts all in place: the frames, frames.pvd, which names those of this run and no others, and last.obj. Files of
  /// these names are replaced.
  void finish(const Sheet& posed);

 private:
  std::filesystem::path folder_, unfinished_;
  bool made_folder_;
  std::vector<double> times_;
};

}  // namespace cutbench
