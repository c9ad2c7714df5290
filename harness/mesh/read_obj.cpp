#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/base/number_from_chars.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/seam_fans.h"
#include "harness/mesh/texture.h"
#include "harness/mesh/triangulate.h"

namespace cutbench {

namespace {

/// The next run of characters that are not blank, taken off the front of `line`; empty at its end.
std::string_view next_token(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r\v\f";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view token = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(token.size());
  return token;
}

class ObjReader {
 public:
  ObjReader(const std::string& name, bool as_is, const MeshReading& reading)
      : name_(name), as_is_(as_is), reading_(reading) {}

  MeshData read(std::string_view text) {
    if (text.find('\0') != std::string_view::npos)
      throw InputError(name_ + ": not a text file, so not an OBJ; check the extension");
    if (constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; text.starts_with(byte_order_mark))
      text.remove_prefix(byte_order_mark.size());
    if (text.find('\n') == std::string_view::npos) line_end_ = '\r';  // as old programs end lines
    comments_tell_ = text.starts_with(vt_are_texture);
    if ((comments_tell_ || text.starts_with(vt_are_rest)) && reading_.rest == RestFrom::automatic) rest_said_ = true;
    std::string line;
    while (!text.empty()) {
      take_line(text, line);
      read_line(line);
    }
    return build();
  }

  /// After read(). \param read  of the same file, repaired
  Texture texture(const MeshData& read) const {
    Texture result;
    for (std::size_t t = 0; t < faces_.size() && t < read.triangles.size(); ++t) {
      auto& corners = result.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner& corner = faces_[t].corners[k];
        if (!exists(corner.v, positions_.size()) || !exists(corner.vt, textures_.size())) return {};
        corners[k] = textures_[to_size(corner.vt - 1)];
        if (!std::isfinite(corners[k].x) || !std::isfinite(corners[k].y)) return {};
      }
      if (is_turned(faces_[t], read, read.triangles[t])) std::swap(corners[1], corners[2]);
    }
    return result;
  }

  /// Are rest positions the `vt` of the file, as `rest` came from it?
  bool took_vt(const MeshData& read) const { return !comments_tell_ && !read.rest.empty(); }

 private:
  /// One corner of a face: numbers counted from 1, 0 for one that is not given; as is, `none` for nonsense.
  struct Corner {
    std::int64_t v = 0, vt = 0, vr = 0;
  };
  static constexpr std::int64_t none = -1;
  struct Face {
    std::array<Corner, 3> corners;
    std::size_t line = 0;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line) + ": " + what);
  }

  /// Off the front of `text`, without its comment; a line that ends in a backslash goes on in the one below.
  void take_line(std::string_view& text, std::string& line) {
    line.clear();
    for (bool goes_on = true; goes_on && !text.empty(); ++line_) {
      const std::size_t end = std::min(text.find(line_end_), text.size());
      std::string_view part = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (part.ends_with('\r')) part.remove_suffix(1);
      if (comments_tell_ && (part.starts_with("#vr ") || part.starts_with("#fr "))) part.remove_prefix(1);
      part = part.substr(0, part.find('#'));
      goes_on = part.ends_with('\\');
      if (goes_on) part.remove_suffix(1);
      line.append(part) += ' ';
    }
  }

  void read_line(std::string_view line) {
    const std::string_view keyword = next_token(line);
    if (keyword == "v") {
      const double x = number(line), y = number(line), z = number(line);
      positions_.push_back({x, y, z});
    } else if (keyword == "vt") {
      const double u = number(line), v = number(line);
      textures_.push_back({u, v});
    } else if (keyword == "f") {
      read_face(line);
    } else if (keyword == "l" || keyword == "curv") {
      has_lines_ = true;
    } else if (comments_tell_ && keyword == "vr") {
      const double x = number(line), y = number(line);
      rest_.push_back({x, y});
    } else if (comments_tell_ && keyword == "fr") {
      read_rest_of_face(line);
    }
  }

  void read_rest_of_face(std::string_view line) {
    if (faces_.empty()) fail(line_, "#fr before the first face");
    for (Corner& corner : faces_.back().corners) {
      const std::string_view token = next_token(line);
      corner.vr = index(token, rest_.size(), token);
    }
  }

  double number(std::string_view& line) const {
    std::string_view token = next_token(line);
    if (token.empty()) fail(line_, "a number is missing; write `v x y z` or `vt u v`");
    const std::string shown(token);
    if (token.front() == '+') token.remove_prefix(1);
    double value = 0;
    const auto [end, error] = number_from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc() || end != token.data() + token.size() || !(as_is_ || std::isfinite(value)))
      fail(line_, "'" + shown + "' is not a finite number; correct it");
    return value;
  }

  void read_face(std::string_view line) {
    std::vector<Corner> corners;
    for (std::string_view token = next_token(line); !token.empty(); token = next_token(line))
      corners.push_back(read_corner(token));
    if (corners.size() == 3) {
      faces_.push_back({{corners[0], corners[1], corners[2]}, line_});
    } else if (corners.size() > 3 && reading_.triangulate) {
      polygons_.push_back({faces_.size(), line_, std::move(corners)});
    } else {
      fail(line_, "a face with " + std::to_string(corners.size()) + " corners; " +
                      (corners.size() > 3 ? "only triangles are read: triangulate the mesh, or give --triangulate"
                                          : "a triangle has three: delete it"));
    }
  }

  Corner read_corner(std::string_view token) const {
    const std::string_view shown = token;
    const std::size_t slash = std::min(token.find('/'), token.size());
    Corner corner;
    corner.v = index(token.substr(0, slash), positions_.size(), shown);
    token.remove_prefix(std::min(slash + 1, token.size()));
    const std::string_view vt = token.substr(0, token.find('/'));
    if (!vt.empty()) corner.vt = index(vt, textures_.size(), shown);
    token.remove_prefix(std::min(vt.size() + 1, token.size()));
    if (token.find_first_not_of("-0123456789") != std::string_view::npos) fail_corner(shown);  // vn, else unused
    return corner;
  }

  /// `token` as a number counted from 1; a negative one counts back from the `count` elements read so far.
  std::int64_t index(std::string_view token, std::size_t count, std::string_view shown) const {
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    const std::int64_t resolved = value < 0 ? to_int64(count) + value + 1 : value;
    if (as_is_ && error == std::errc() && resolved < 1) return none;
    if (error != std::errc() || end != token.data() + token.size() || resolved < 1) fail_corner(shown);
    return resolved;
  }

  /// In the place of each polygon its triangles; after all lines, since a face may come before its vertices.
  void triangulate_polygons(MeshData& mesh) {
    std::vector<Face> all;
    std::size_t next = 0;
    for (const Polygon& polygon : polygons_) {
      all.insert(all.end(), faces_.begin() + to_index(next), faces_.begin() + to_index(polygon.before));
      next = polygon.before;
      std::vector<Point3> corners;
      for (const Corner& c : polygon.corners) {
        if (!exists(c.v, positions_.size())) fail_missing(polygon.line);
        corners.push_back(positions_[to_size(c.v - 1)]);
      }
      const auto triangles = triangulate(corners);
      if (triangles.empty())
        fail(polygon.line, "a face that can't be triangulated: it crosses itself, or has no area; correct it");
      for (const auto& [a, b, c] : triangles)
        all.push_back({{polygon.corners[a], polygon.corners[b], polygon.corners[c]}, polygon.line});
    }
    all.insert(all.end(), faces_.begin() + to_index(next), faces_.end());
    const std::size_t others = faces_.size();
    faces_ = std::move(all);
    mesh.notes.push_back(name_ + ": faces triangulated: " + std::to_string(polygons_.size()) + " of " +
                         std::to_string(polygons_.size() + others));
  }

  [[noreturn]] void fail_missing(std::size_t line) const {
    fail(line, "a corner beyond the " + std::to_string(positions_.size()) + " v and " +
                   std::to_string(textures_.size()) + " vt of the file, which may be cut short");
  }

  [[noreturn]] void fail_corner(std::string_view shown) const {
    fail(line_, "'" + std::string(shown) + "' is not a face corner; write v, v/vt, v//vn or v/vt/vn, counted from 1");
  }

  MeshData build() {
    MeshData mesh;
    if (faces_.empty() && polygons_.empty() && has_lines_)
      throw InputError(name_ + ": lines and no faces; a sheet is made of triangles: mesh the area between the lines");
    if (!polygons_.empty()) triangulate_polygons(mesh);
    bool any_vt = false;
    for (Face& face : faces_)
      for (Corner& c : face.corners) {
        if (textures_.empty() && !as_is_) c.vt = 0;  // some programs write numbers of vt and no vt
        any_vt = any_vt || place_of(c) != 0;
        if (!as_is_ && (c.v > std::ssize(positions_) || c.vt > std::ssize(textures_) || c.vr > std::ssize(rest_)))
          fail_missing(face.line);
      }
    if (!any_vt && reading_.rest == RestFrom::vt && !as_is_)
      throw InputError(name_ + ": no vt, so they can't be the rest positions; leave --rest vt out");
    const bool by_vt =
        any_vt && reading_.rest != RestFrom::plane && reading_.rest != RestFrom::space && with_rest(mesh);
    if (!by_vt) without_rest(mesh);
    return mesh;
  }

  void without_rest(MeshData& mesh) const {
    mesh.deformed = positions_;
    for (const Face& face : faces_) {
      auto& triangle = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = to_int32(face.corners[k].v - 1);
    }
  }

  /// Of a corner's rest position among places(): its `vt`, or what the comments say.
  std::int64_t place_of(const Corner& corner) const { return comments_tell_ ? corner.vr : corner.vt; }
  const std::vector<Point2>& places() const { return comments_tell_ ? rest_ : textures_; }

  /// Reading takes corner 1 and 2 of a triangle in the other order where it turns it round.
  bool is_turned(const Face& face, const MeshData& read, const std::array<std::int32_t, 3>& triangle) const {
    const Point3 second = read.deformed[to_size(triangle[1])];
    const auto off = [&](std::size_t k) { return length(second + -1.0 * positions_[to_size(face.corners[k].v - 1)]); };
    return off(2) < off(1);
  }

  /// The first `vt` a `v` is used with keeps the number of the `v`; others, compared by value because some programs
  /// write one `vt` per corner, get numbers after the last `v`.
  /// False, and no more than a note, where the `vt` are not to be taken.
  bool with_rest(MeshData& result) const {
    MeshData mesh;
    mesh.deformed = positions_;
    mesh.rest.resize(positions_.size());
    mesh.file_vertices.resize(positions_.size());
    std::iota(mesh.file_vertices.begin(), mesh.file_vertices.end(), 0);
    std::vector<bool> has_rest(positions_.size(), false);
    std::map<std::tuple<std::size_t, double, double>, std::int32_t> copies;
    auto vertex_of = [&](const Corner& corner) {
      if (!exists(corner.v, positions_.size())) return to_int32(corner.v - 1);
      if (!exists(place_of(corner), places().size())) return to_int32(none);
      const auto v = to_size(corner.v - 1);
      const Point2 rest = places()[to_size(place_of(corner) - 1)];
      const bool broken = !std::isfinite(rest.x) || !std::isfinite(rest.y);  // equal to nothing: marks the whole vertex
      if (!has_rest[v] || broken) {
        mesh.rest[v] = rest;
        has_rest[v] = true;
      }
      if (broken) return to_int32(v);
      if (mesh.rest[v] == rest) return to_int32(v);
      const auto next = to_int32(mesh.rest.size());
      const auto [copy, is_new] = copies.try_emplace({v, rest.x, rest.y}, next);
      if (is_new) {
        mesh.rest.push_back(rest);
        mesh.deformed.push_back(positions_[v]);
        mesh.file_vertices.push_back(to_int32(v));
      }
      return copy->second;
    };
    for (const Face& face : faces_) {
      auto& triangle = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (place_of(face.corners[k]) == 0)
          fail(face.line, "a corner without vt in a mesh with vt; give every corner a vt, or none, or --rest plane");
        triangle[k] = vertex_of(face.corners[k]);
      }
    }
    const bool said = rest_said_ || reading_.rest == RestFrom::vt;
    const RestDecision decision = said ? RestDecision{true, ""} : decide_rest(mesh);
    if (!decision.note.empty()) result.notes.push_back(name_ + ": " + decision.note);
    if (!decision.vt) return false;
    if (!copies.empty()) {
      mesh.sewn = mesh.file_vertices;
      result.notes.push_back(name_ + ": vertices added where one v has several vt: " + std::to_string(copies.size()) +
                             "; the sheet is sewn along these seams");
      part_fans_at_seams(mesh);
    }
    mesh.notes = std::move(result.notes);
    result = std::move(mesh);
    return true;
  }

  static bool exists(std::int64_t number, std::size_t count) { return number >= 1 && number <= to_int64(count); }

  struct Polygon {
    std::size_t before;  ///< of faces_: the one that follows it
    std::size_t line;
    std::vector<Corner> corners;
  };

  const std::string& name_;
  bool as_is_;
  MeshReading reading_;
  bool comments_tell_ = false;  ///< the rest positions, by vt_are_texture
  bool has_lines_ = false;
  char line_end_ = '\n';
  bool rest_said_ = false;  ///< the file itself says which they are
  std::size_t line_ = 0;    ///< of the line being read, from 1; where it was continued, its last
  std::vector<Point3> positions_;
  std::vector<Point2> textures_, rest_;  ///< `vt` and `#vr`
  std::vector<Face> faces_;
  std::vector<Polygon> polygons_;
};

}  // namespace

MeshData read_obj(std::string_view text, const std::string& name, bool as_is, const MeshReading& reading) {
  return ObjReader(name, as_is, reading).read(text);
}

Texture read_obj_texture(std::string_view text, const std::string& name, const MeshReading& reading,
                         const MeshData& read) {
  const bool may_take_vt = reading.rest == RestFrom::automatic || reading.rest == RestFrom::vt;
  if ((may_take_vt && text.starts_with(vt_are_rest)) || text.find("vt") == std::string_view::npos) return {};
  ObjReader reader(name, false, reading);
  if (reader.took_vt(reader.read(text))) return {};
  return reader.texture(read);
}

}  // namespace cutbench
