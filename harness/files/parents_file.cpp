#include "harness/files/parents_file.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/row_numbers.h"

namespace cutbench {

namespace {

using nlohmann::ordered_json;

int in_file(const MeshData& read, DeformedIndex old) {
  return read.file_vertices.empty() ? old.value : read.file_vertices[old()];
}

/// A vertex and its masters, those without weight left out.
std::vector<std::pair<int, double>> masters_of(const Constraint& constraint, const RowNumbers& number) {
  std::vector<std::pair<int, double>> masters;
  for (std::size_t k = 0; k < 3; ++k)
    if (constraint.weights[k] != 0) masters.emplace_back(number.of(constraint.masters[k]), constraint.weights[k]);
  return masters;
}

/// \param forward  h runs along the path
ordered_json lip_edge(const Sheet& cut, const RowNumbers& number, HalfEdge h, bool forward) {
  if (!h.valid()) return nullptr;
  const auto& corner = cut.triangle(triangle_of(h)).deformed;
  int from = number.of(corner[to_size(corner_of(h))]), to = number.of(corner[to_size(next_corner(corner_of(h)))]);
  if (!forward) std::swap(from, to);
  return {number.triangle[triangle_of(h)()], from, to};
}

/// Its key with the comma before it, or nothing.
std::string texture_json(const Texture& texture) {
  if (texture.empty()) return "";
  ordered_json triangles = ordered_json::array();
  for (const auto& [a, b, c] : texture) triangles.push_back({{a.x, a.y}, {b.x, b.y}, {c.x, c.y}});
  return ",\n\"texture\": " + triangles.dump();
}

/// Up to three vertices with their weights for each of `count`.
class PartColumns {
 public:
  PartColumns(const std::string& name, const std::string& weights, int count)
      : vertices_{name, MeshColumn::Of::vertices, true, 3, std::vector<double>(3 * to_size(count), -1)},
        weights_{weights, MeshColumn::Of::vertices, false, 3, std::vector<double>(3 * to_size(count), 0)} {}
  void put(int vertex, const std::vector<std::pair<int, double>>& parts) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      vertices_.values[3 * to_size(vertex) + k] = parts[k].first;
      weights_.values[3 * to_size(vertex) + k] = parts[k].second;
    }
  }
  void move_to(std::vector<MeshColumn>& columns) {
    columns.push_back(std::move(vertices_));
    columns.push_back(std::move(weights_));
  }

 private:
  MeshColumn vertices_, weights_;
};

std::vector<std::pair<int, double>> parents_of(const CutDetails& details, std::size_t slot) {
  std::vector<std::pair<int, double>> parts;
  for (const VertexPart& part : details.parents.vertices[slot])
    parts.emplace_back(in_file(details.read, part.vertex), part.weight);
  return parts;
}

}  // namespace

std::string details_json(const CutDetails& details) {
  const RowNumbers number(details.cut);
  ordered_json vertices = ordered_json::array(), triangles = vertices, incision = vertices, polygons = vertices,
               copies = vertices, constraints = vertices;
  for (std::size_t d = 0; d < number.vertex.size(); ++d)
    if (number.vertex[d] >= 0) vertices.push_back(parents_of(details, d));
  for (std::size_t t = 0; t < number.triangle.size(); ++t)
    if (number.triangle[t] >= 0) triangles.push_back(details.parents.triangles[t].value);
  for (const IncisionEdge& edge : details.incision)
    incision.push_back({{"cut", edge.cut},
                        {"left", lip_edge(details.cut, number, edge.left, true)},
                        {"right", lip_edge(details.cut, number, edge.right, false)}});
  for (const Polygon& polygon : details.constraints.polygons) {
    auto& members = polygons.emplace_back(ordered_json::array());
    for (const TriangleIndex t : polygon.triangles) members.push_back(number.triangle[t()]);
  }
  for (const DeformedIndex old : details.constraints.phantoms) copies.push_back(in_file(details.read, old));
  for (const Constraint& constraint : details.constraints.constraints)
    constraints.push_back({number.of(constraint.vertex), masters_of(constraint, number)});

  return "{\"vertices\": " + vertices.dump() + ",\n\"triangles\": " + triangles.dump() +
         ",\n\"incision\": " + incision.dump() + ",\n\"polygons\": " + polygons.dump() +
         ",\n\"copies\": " + copies.dump() + ",\n\"constraints\": " + constraints.dump() +
         texture_json(details.texture) + "}\n";
}

std::vector<MeshColumn> details_columns(const CutDetails& details) {
  const RowNumbers number(details.cut);
  std::vector<MeshColumn> columns;
  PartColumns parents("parents", "parent_weights", number.vertices);
  for (std::size_t d = 0; d < number.vertex.size(); ++d)
    if (number.vertex[d] >= 0) parents.put(number.vertex[d], parents_of(details, d));
  parents.move_to(columns);
  if (const auto& constraints = details.constraints.constraints; !constraints.empty()) {
    PartColumns masters("masters", "master_weights", number.vertices);
    for (const Constraint& constraint : constraints)
      masters.put(number.of(constraint.vertex), masters_of(constraint, number));
    masters.move_to(columns);
  }
  MeshColumn copies{"copies", MeshColumn::Of::sheet, true, 1, {}};
  for (const DeformedIndex old : details.constraints.phantoms) copies.values.push_back(in_file(details.read, old));
  if (!copies.values.empty()) columns.push_back(std::move(copies));
  MeshColumn parent{"parent", MeshColumn::Of::triangles, true, 1, {}};
  for (std::size_t t = 0; t < number.triangle.size(); ++t)
    if (number.triangle[t] >= 0) parent.values.push_back(details.parents.triangles[t].value);
  columns.push_back(std::move(parent));
  MeshColumn lips{"lips", MeshColumn::Of::triangles, true, 3, std::vector<double>(3 * to_size(number.triangles))};
  const auto put_lip = [&](HalfEdge h, double value) {
    if (h.valid()) lips.values[to_size(3 * number.triangle[triangle_of(h)()] + corner_of(h))] = value;
  };
  for (const IncisionEdge& edge : details.incision) {
    put_lip(edge.left, to_double(edge.cut + 1));
    put_lip(edge.right, -to_double(edge.cut + 1));
  }
  columns.push_back(std::move(lips));
  if (details.constraints.polygons.empty()) return columns;
  MeshColumn polygon{"polygon", MeshColumn::Of::triangles, true, 1, std::vector<double>(to_size(number.triangles), -1)};
  for (std::size_t p = 0; p < details.constraints.polygons.size(); ++p)
    for (const TriangleIndex t : details.constraints.polygons[p].triangles)
      polygon.values[to_size(number.triangle[t()])] = to_double(p);
  columns.push_back(std::move(polygon));
  return columns;
}

}  // namespace cutbench
