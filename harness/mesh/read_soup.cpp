#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/texture.h"
#include "harness/mesh/triangulate.h"

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

/// The face as triangles of corners in it.
std::vector<std::array<std::size_t, 3>> parts(const MeshData& mesh, const Face& face, const std::string& where) {
  if (face.size() == 3) return {{0, 1, 2}};
  std::vector<Point3> corners;
  for (std::size_t i : face) {
    if (i >= mesh.deformed.size()) throw InputError(where + " has a corner that doesn't exist; correct it");
    corners.push_back(mesh.deformed[i]);
  }
  const auto triangles = triangulate(corners);
  if (triangles.empty())
    throw InputError(where + " can't be triangulated: it crosses itself, or has no area; correct it");
  return triangles;
}

MeshData from_soup(const SpacePoints& points, const Faces& faces, const std::string& name, bool triangulated) {
  MeshData mesh;
  for (const Kernel::Point_3& p : points) mesh.deformed.push_back({p.x(), p.y(), p.z()});
  std::size_t number = 0, polygons = 0;
  for (const Face& face : faces) {
    const std::string where = name + ": face " + std::to_string(++number) + " of " + std::to_string(faces.size());
    if (face.size() < 3 || (face.size() > 3 && !triangulated))
      throw InputError(where + " has " + std::to_string(face.size()) + " corners; " +
                       (face.size() > 3 ? "only triangles are read: triangulate the mesh, or give --triangulate"
                                        : "a triangle has three: delete it"));
    polygons += face.size() > 3;
    // check_and_repair looks at the range; here an index too large for 32 bits must only not turn into a good one.
    for (const auto& part : parts(mesh, face, where)) {
      auto& triangle = mesh.triangles.emplace_back();
      std::transform(part.begin(), part.end(), triangle.begin(),
                     [&](std::size_t k) { return face[k] > to_size(INT32_MAX) ? -1 : to_int32(face[k]); });
    }
  }
  if (polygons > 0)
    mesh.notes.push_back(name + ": faces triangulated: " + std::to_string(polygons) + " of " +
                         std::to_string(faces.size()));
  return mesh;
}

/// Some programs leave the number of edges out, which CGAL insists on.
std::string with_edge_count(const std::string& text) {
  std::size_t from = 0;
  bool keyword = false;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::istringstream line(text.substr(from, std::min(text.find('#', from), end) - from));
    std::vector<std::string> words;
    for (std::string word; line >> word;) words.push_back(word);
    if (!words.empty() && !keyword) {
      if (words.front() != "OFF") return text;
      keyword = true;
      words.erase(words.begin());
    }
    if (words.size() == 2 && words.front() != "BINARY") {
      const std::size_t last = text.find(words.back(), text.find(words.front(), from) + words.front().size());
      return text.substr(0, last + words.back().size()) + " 0" + text.substr(last + words.back().size());
    }
    if (!words.empty()) return text;
    from = end + 1;
  }
  return text;
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

/// What a PLY's header says before CGAL reads it. CGAL takes an element before the first `property` for granted, and
/// any text without `end_header` for an empty mesh.
struct PlyHeader {
  bool sound = false;
  std::set<std::string> elements;
};

PlyHeader header_of_ply(std::istream& in) {
  PlyHeader header;
  std::string line;
  for (int number = 1; !header.sound && std::getline(in, line); ++number) {
    std::string keyword, name;
    std::istringstream(line) >> keyword >> name;
    if (number <= 2) continue;  // `ply` and `format`, which CGAL does look at
    if (keyword == "property" && header.elements.empty()) break;
    if (keyword == "element") header.elements.insert(name);
    header.sound = keyword == "end_header";
  }
  in.clear();
  in.seekg(0);
  return header;
}

namespace ply = CGAL::IO::internal;

/// Where programs put a vertex's texture coordinates.
constexpr std::array<std::array<const char*, 2>, 4> ply_textures{
    {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};

bool read_vertices(std::istream& in, ply::PLY_element& element, SpacePoints& points, std::vector<Point2>& textures) {
  const auto has = [&](const char* tag) { return element.has_property<double>(tag); };
  const auto texture = std::find_if(ply_textures.begin(), ply_textures.end(),
                                    [&](const auto& tags) { return has(tags[0]) && has(tags[1]); });
  for (std::size_t item = 0; item < element.number_of_items(); ++item) {
    for (std::size_t k = 0; k < element.number_of_properties(); ++k) element.property(k)->get(in);
    if (in.fail()) return false;
    std::tuple<Kernel::Point_3> point;
    ply::process_properties(element, point,
                            CGAL::make_ply_point_reader(CGAL::make_nth_of_tuple_property_map<0>(point)));
    points.push_back(std::get<0>(point));
    if (texture == ply_textures.end()) continue;
    Point2& place = textures.emplace_back();
    element.assign(place.x, (*texture)[0]);
    element.assign(place.y, (*texture)[1]);
  }
  return true;
}

template <class... Integers>
bool read_faces_of(std::istream& in, ply::PLY_element& element, Faces& faces, const char* tag) {
  return ((element.has_property<std::vector<Integers>>(tag) &&
           ply::read_PLY_faces<Integers>(in, element, faces, CGAL::Emptyset_iterator(), tag)) ||
          ...);
}

bool read_faces(std::istream& in, ply::PLY_element& element, Faces& faces) {
  using std::int16_t, std::int32_t, std::int8_t, std::uint16_t, std::uint32_t, std::uint8_t;
  for (const char* tag : {"vertex_indices", "vertex_index"})
    if (read_faces_of<int32_t, uint32_t, int16_t, uint16_t, int8_t, uint8_t>(in, element, faces, tag)) return true;
  return false;
}

/// By CGAL's parts: CGAL::IO::read_PLY passes over faces with indices of 8 or 16 bits, and texture coordinates.
bool read_ply_parts(std::istream& in, SpacePoints& points, std::vector<Point2>& textures, Faces& faces) {
  ply::PLY_reader reader(false);
  if (!reader.init(in)) return false;
  for (std::size_t i = 0; i < reader.number_of_elements(); ++i) {
    ply::PLY_element& element = reader.element(i);
    if (element.name() == "vertex" || element.name() == "vertices") {
      if (!read_vertices(in, element, points, textures)) return false;
    } else if (element.name() == "face" || element.name() == "faces") {
      return read_faces(in, element, faces);
    } else {
      for (std::size_t item = 0; item < element.number_of_items(); ++item)
        for (std::size_t k = 0; k < element.number_of_properties(); ++k) element.property(k)->get(in);
    }
  }
  return !in.fail();
}

/// Old programs end lines by a carriage return alone.
std::string with_line_feeds(std::string text) {
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

/// Takes the texture coordinates of a PLY's vertices for rest positions, or not (rest_choice.h).
void take_texture(MeshData& mesh, std::vector<Point2> textures, const std::string& name, RestFrom rest) {
  if (rest == RestFrom::plane || rest == RestFrom::space || textures.empty()) return;
  mesh.rest = std::move(textures);
  if (rest == RestFrom::vt) return;
  const RestDecision decision = decide_rest(mesh);
  if (!decision.note.empty()) mesh.notes.push_back(name + ": " + decision.note);
  if (!decision.vt) mesh.rest.clear();
}

template <class Reader>
MeshData read_soup(std::istream& in, const std::string& name, const char* format, bool triangulated, Reader read) {
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
  return from_soup(points, faces, name, triangulated);
}

/// \param textures  of its vertices; none where it says nothing of them
MeshData ply_of(const std::string& text, const std::string& name, bool triangulated, std::vector<Point2>& textures) {
  std::istringstream in(with_line_feeds(text));
  const PlyHeader header = header_of_ply(in);
  if (header.elements.contains("tristrips"))
    throw InputError(name + ": its triangles are strips (tristrips), which are not read; export them as faces");
  return read_soup(in, name, "PLY", triangulated, [&](std::istream& s, SpacePoints& points, Faces& faces) {
    return header.sound && read_ply_parts(s, points, textures, faces);
  });
}

}  // namespace

MeshData read_off(const std::string& text, const std::string& name, bool triangulated) {
  std::istringstream in(with_edge_count(with_line_feeds(text)));
  return read_soup(in, name, "OFF", triangulated, [&](std::istream& s, SpacePoints& points, Faces& faces) {
    if (announces_more_than_it_holds(s, text.size())) return false;
    return CGAL::IO::read_OFF(s, points, faces, CGAL::parameters::verbose(false));
  });
}

MeshData read_ply(const std::string& text, const std::string& name, const MeshReading& reading) {
  std::vector<Point2> textures;
  MeshData mesh = ply_of(text, name, reading.triangulate, textures);
  take_texture(mesh, std::move(textures), name, reading.rest);
  return mesh;
}

Texture read_ply_texture(const std::string& text, const std::string& name, const MeshReading& reading,
                         const MeshData& read) {
  std::vector<Point2> textures;
  MeshData mesh = ply_of(text, name, reading.triangulate, textures);
  take_texture(mesh, textures, name, reading.rest);
  if (textures.empty() || !mesh.rest.empty()) return {};
  Texture result;
  for (std::size_t t = 0; t < mesh.triangles.size() && t < read.triangles.size(); ++t) {
    auto& corners = result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = textures[to_size(mesh.triangles[t][k])];
      if (!std::isfinite(corners[k].x) || !std::isfinite(corners[k].y)) return {};
    }
    const Point3 second = read.deformed[to_size(read.triangles[t][1])];
    const auto off = [&](std::size_t k) {
      return length(second + -1.0 * mesh.deformed[to_size(mesh.triangles[t][k])]);
    };
    if (off(2) < off(1)) std::swap(corners[1], corners[2]);  // reading turned it round
  }
  return result;
}

}  // namespace cutbench
