#include <map>
#include <string_view>

#include "harness/base/conversions.h"
#include "harness/base/number_from_chars.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/parts_at_rest.h"
#include "harness/mesh/quality.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

namespace {

/// Text that grows: numbers in the shortest form that reads back bit-equal, whatever the locale.
class Text {
 public:
  Text& operator<<(std::string_view s) {
    text_ += s;
    return *this;
  }
  Text& operator<<(char c) {
    text_ += c;
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> Text& operator<<(Number x) {
    char digits[32];
    text_.append(digits, number_to_chars(digits, digits + sizeof digits, x));
    return *this;
  }
  Text& operator<<(const Point2& p) { return *this << p.x << ' ' << p.y; }
  Text& operator<<(const Point3& p) { return *this << p.x << ' ' << p.y << ' ' << p.z; }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

double rest_aspect_ratio(const MeshData& mesh, const std::array<std::int32_t, 3>& triangle) {
  auto rest = [&](std::int32_t v) { return mesh.rest[to_size(v)]; };
  return aspect_ratio(rest(triangle[0]), rest(triangle[1]), rest(triangle[2]));
}

}  // namespace

std::vector<std::int32_t> pieces_of(const MeshData& mesh) {
  UnionFind joined = parts_at_rest(mesh);
  for (std::size_t v = 0; v < mesh.sewn.size(); ++v) joined.join(v, to_size(mesh.sewn[v]));
  std::map<std::size_t, std::int32_t> number;
  std::vector<std::int32_t> result;
  for (const auto& triangle : mesh.triangles)
    result.push_back(number.try_emplace(joined.find(triangle[0]), to_int32(number.size())).first->second);
  return result;
}

ObjPoints obj_points(const MeshData& mesh) {
  Text text;
  std::vector<std::size_t> point(mesh.deformed.size());
  std::map<std::int32_t, std::size_t> point_of_sewn;
  for (std::size_t v = 0; v < point.size(); ++v) {
    const std::int32_t sewn = mesh.sewn.empty() ? to_int32(v) : mesh.sewn[v];
    const auto [place, is_new] = point_of_sewn.try_emplace(sewn, point_of_sewn.size() + 1);
    point[v] = place->second;
    if (is_new) text << "v " << mesh.deformed[v] << '\n';
  }
  return {text.str(), point};
}

std::string obj_text(const MeshData& mesh) {
  Text text;
  const auto [points, point] = obj_points(mesh);
  text << vt_are_rest << '\n' << points;
  for (const Point2& p : mesh.rest) text << "vt " << p << '\n';
  const auto point_of = [&, &point = point](std::int32_t v) {  // what is broken stays so
    return v >= 0 && v < std::ssize(point) ? to_int64(point[to_size(v)]) : to_int64(v) + 1;
  };
  for (const auto& triangle : mesh.triangles) {
    text << 'f';
    for (std::int32_t v : triangle) text << ' ' << point_of(v) << '/' << v + 1;
    text << '\n';
  }
  return text.str();
}

std::string off_text(const MeshData& mesh) {
  Text text;
  text << "OFF\n" << mesh.deformed.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Point3& p : mesh.deformed) text << p << '\n';
  for (const auto& [a, b, c] : mesh.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  return text.str();
}

std::string vtu_text(const MeshData& mesh, std::span<const MeshColumn> columns) {
  Text text;
  // \param counted  " NumberOfTuples=..." where they are not as many as vertices or triangles
  auto array = [&text](std::string_view type, std::string_view name, int components, const auto& values, auto put,
                       const std::string& counted = {}) {
    text << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components << '"'
         << counted << " format=\"ascii\">\n";
    for (const auto& value : values) put(value), text << '\n';
    text << "</DataArray>\n";
  };
  auto put_columns = [&](MeshColumn::Of of) {
    for (const MeshColumn& column : columns) {
      if (column.of != of) continue;
      const std::string count = std::to_string(column.values.size() / to_size(column.components));
      array(
          column.whole ? "Int32" : "Float64", column.name, column.components, column.values,
          [&](double value) { column.whole ? text << to_int64(value) : text << value; },
          of == MeshColumn::Of::sheet ? " NumberOfTuples=\"" + count + '"' : "");
    }
  };
  std::vector<std::size_t> ends(mesh.triangles.size());
  for (std::size_t t = 0; t < ends.size(); ++t) ends[t] = 3 * (t + 1);

  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
       << "<UnstructuredGrid>\n<FieldData>\n";
  put_columns(MeshColumn::Of::sheet);
  text << "</FieldData>\n<Piece NumberOfPoints=\"" << mesh.deformed.size() << "\" NumberOfCells=\""
       << mesh.triangles.size() << "\">\n<Points>\n";
  array("Float64", "deformed", 3, mesh.deformed, [&](const Point3& p) { text << p; });
  text << "</Points>\n<Cells>\n";
  array("Int32", "connectivity", 1, mesh.triangles, [&](const auto& t) { text << t[0] << ' ' << t[1] << ' ' << t[2]; });
  array("Int64", "offsets", 1, ends, [&](std::size_t end) { text << end; });
  array("UInt8", "types", 1, mesh.triangles, [&](const auto&) { text << 5; });  // VTK_TRIANGLE
  text << "</Cells>\n<PointData>\n";
  array("Float64", "rest", 3, mesh.rest, [&](const Point2& p) { text << p << " 0"; });
  put_columns(MeshColumn::Of::vertices);
  text << "</PointData>\n<CellData>\n";
  array("Int32", "piece", 1, pieces_of(mesh), [&](std::int32_t piece) { text << piece; });
  array("Float64", "aspect_ratio", 1, mesh.triangles, [&](const auto& t) { text << rest_aspect_ratio(mesh, t); });
  array("Float64", "strain", 1, mesh.triangles, [&](const auto& t) { text << stretch_of(mesh, t).strain(); });
  put_columns(MeshColumn::Of::triangles);
  text << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return text.str();
}

}  // namespace cutbench
