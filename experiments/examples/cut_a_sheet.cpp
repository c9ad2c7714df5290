// A sheet given as arrays is cut; then its lips, and what each new vertex and triangle was before. Links cutbench::cut.
#include <cutbench/base/conversions.h>
#include <cutbench/cut/cut.h>
#include <cutbench/mesh/check_and_repair.h>
#include <cutbench/mesh/parents.h>
#include <cutbench/methods/registry.h>

#include <cstdio>

using namespace cutbench;

namespace {

/// A strip of four squares, 2 triangles each.
MeshData strip() {
  MeshData mesh;
  for (int i = 0; i < 5; ++i)
    for (const double y : {0.0, 1.0}) mesh.rest.push_back({1.0 * i, y});
  for (const Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
  for (int i = 0; i < 8; i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  check_and_repair(mesh, "strip");  // throws InputError, or repairs, saying so in mesh.notes
  return mesh;
}

/// The vertex of the opened sheet that h begins at.
int begin_of(const Sheet& sheet, HalfEdge h) {
  return sheet.triangle(triangle_of(h)).deformed[to_size(corner_of(h))].value;
}

/// The two vertices, one for each lip, at each end of the incision's edges; at a tip they are one.
void print_lips(const Sheet& sheet) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (!sheet.triangle(TriangleIndex(t)).alive() || sheet.mark(h) != EdgeMark::incision) continue;
      const HalfEdge other = Sheet::next(sheet.opposite(h));  // from the same rest vertex, on the other lip
      std::printf("lips %d %d\n", begin_of(sheet, h), begin_of(sheet, other));
    }
}

void print_parents(const Sheet& before, const Sheet& cut) {
  const Parents parents = parents_of(before, cut);
  for (std::size_t d = before.deformed_slots(); d < parents.vertices.size(); ++d) {
    std::printf("vertex %zu =", d);
    for (const VertexPart& part : parents.vertices[d]) std::printf(" %+g * vertex %d", part.weight, part.vertex.value);
    std::printf("\n");
  }
  for (std::size_t t = 0; t < parents.triangles.size(); ++t)
    if (parents.triangles[t].valid()) std::printf("triangle %zu was in %d\n", t, parents.triangles[t].value);
}

}  // namespace

int main() {
  const Sheet before(strip());
  Sheet sheet = before;
  Locator locator(sheet);  // keep both for the next cut of this sheet
  Cutter cutter;
  const MethodRow& row = find_method("conventional_split");
  const auto method = row.make(row.parameter.value);
  const Curve curve{Curve::Kind::polyline, false, {{1.25, -0.5}, {2.75, 0.7}}};  // from outside to a tip
  const CutOutcome outcome = cutter.cut(sheet, locator, curve, *method, {});
  std::printf("%s, %zu triangles\n", name_of(outcome.status), sheet.triangle_count());
  print_lips(sheet);
  print_parents(before, sheet);
  return outcome.status == Status::ok ? 0 : 1;
}
