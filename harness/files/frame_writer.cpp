#include "harness/files/frame_writer.h"

#include <cstdio>

#include "harness/files/mesh_file.h"

namespace cutbench {

namespace {

std::string frame_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04zu.vtu", number);
  return name;
}

/// Per vertex: is it held (Sheet::hold)?
MeshColumn held_vertices(const Sheet& sheet) {
  MeshColumn held{"held", MeshColumn::Of::vertices, true, 1, {}};
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid()) held.values.push_back(sheet.is_held(v));
  return held;
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& folder) : folder_(folder), unfinished_(folder / "unfinished") {
  const std::filesystem::path parent = folder.has_parent_path() ? folder.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(parent, error))
    throw InputError("--frames " + folder.string() + ": there is no folder " + parent.string() + "; make it first");
  made_folder_ = std::filesystem::create_directory(folder, error);
  if (error) throw InputError("--frames " + folder.string() + ": can't be made (" + error.message() + ")");
  check_writable(folder / "frames.pvd", "--frames");
  std::filesystem::remove_all(unfinished_, error);  // of a run that was killed
  std::filesystem::create_directory(unfinished_);
}

FrameWriter::~FrameWriter() {
  std::error_code ignored;
  std::filesystem::remove_all(unfinished_, ignored);
  if (made_folder_) std::filesystem::remove(folder_, ignored);  // only where it is empty
}

void FrameWriter::add(const Sheet& posed, double time) {
  const MeshColumn held = held_vertices(posed);
  mesh_file(posed.to_mesh_data(), unfinished_ / frame_name(times_.size()), {&held, 1}).place();
  times_.push_back(time);
}

void FrameWriter::finish(const Sheet& posed) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t i = 0; i < times_.size(); ++i) {
    std::filesystem::rename(unfinished_ / frame_name(i), folder_ / frame_name(i));
    char entry[96];
    std::snprintf(entry, sizeof entry, "<DataSet timestep=\"%.12g\" part=\"0\" file=\"%s\"/>\n", times_[i],
                  frame_name(i).c_str());
    text += entry;
  }
  WholeFile(folder_ / "frames.pvd", text + "</Collection>\n</VTKFile>\n").place();
  write_mesh(posed.to_mesh_data(), folder_ / "last.obj");
}

}  // namespace cutbench
