#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/mesh_text.h"

namespace cutbench {

namespace {

using SpacePoints = std::vector<Kernel::Point_3>;

/// CGAL gives a face the size the file announces before it reads it: a nonsensical size must not ask for the memory.
struct Face : std::vector<std::size_t> {
  void resize(std::size_t corners) {
    if (corners > 1000) throw std::length_error("a face of more than 1000 corners");
    std::vector<std::size_t>::resize(corners);
  }
};
using Faces = std::vector<Face>;

MeshData from_soup(const SpacePoints& points, const Faces& faces, const std::string& name) {
  MeshData mesh;
  for (const Kernel::Point_3& p : points) mesh.deformed.push_back({p.x(), p.y(), p.z()});
  for (const Face& face : faces) {
    if (face.size() != 3)
      throw InputError(name + ": face " + std::to_string(mesh.triangles.size() + 1) + " of " +
                       std::to_string(faces.size()) + " has " + std::to_string(face.size()) +
                       " corners; only triangles are read: triangulate the mesh");
    // check_and_repair looks at the range; here an index too large for 32 bits must only not turn into a good one.
    auto& triangle = mesh.triangles.emplace_back();
    std::transform(face.begin(), face.end(), triangle.begin(),
                   [](std::size_t i) { return i > to_size(INT32_MAX) ? -1 : to_int32(i); });
  }
  return mesh;
}

/// CGAL asks for the memory of all the elements an OFF file announces before it reads the first.
bool announces_more_than_it_holds(std::istream& in, std::uintmax_t bytes) {
  CGAL::File_header_OFF header;
  in >> header;
  const bool result = header.size_of_vertices() > bytes || header.size_of_facets() > bytes;
  in.clear();
  in.seekg(0);
  return result;
}

/// CGAL takes an element before the first `property` for granted, and any text without `end_header` for an empty mesh.
bool has_ply_header(std::istream& in) {
  bool has_element = false, sound = false;
  std::string line, keyword;
  for (int number = 1; !sound && std::getline(in, line); ++number) {
    keyword.clear();
    std::istringstream(line) >> keyword;
    if (number <= 2) continue;  // `ply` and `format`, which CGAL does look at
    if (keyword == "property" && !has_element) break;
    has_element = has_element || keyword == "element";
    sound = keyword == "end_header";
  }
  in.clear();
  in.seekg(0);
  return sound;
}

template <class Reader>
MeshData read_soup(std::istream& in, const std::string& name, const char* format, Reader read) {
  SpacePoints points;
  Faces faces;
  bool complete = false;
  try {
    complete = read(in, points, faces);
  } catch (const std::exception&) {  // a nonsensical number of corners
  }
  if (!complete)
    throw InputError(name + ": not a complete " + format +
                     " file: cut short, a bad number or an index out of range; export it again");
  return from_soup(points, faces, name);
}

}  // namespace

MeshData read_off(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  return read_soup(in, name, "OFF", [&](std::istream& s, SpacePoints& points, Faces& faces) {
    if (announces_more_than_it_holds(s, text.size())) return false;
    return CGAL::IO::read_OFF(s, points, faces, CGAL::parameters::verbose(false));
  });
}

MeshData read_ply(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  return read_soup(in, name, "PLY", [](std::istream& s, SpacePoints& points, Faces& faces) {
    return has_ply_header(s) && CGAL::IO::read_PLY(s, points, faces, CGAL::parameters::verbose(false));
  });
}

}  // namespace cutbench
