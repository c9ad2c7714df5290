// What tests of meshes share: refusals, bit equality, and a slow, obvious check of what check_and_repair promises.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "harness/base/conversions.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

inline std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

/// `run` throws an InputError of one line that holds `part`.
inline void expect_refused(const std::function<void()>& run, const std::string& part) {
  const std::string what = error_of(run);
  EXPECT_NE(what.find(part), std::string::npos) << "expected: " << part << "\nis:       " << what;
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

inline std::string joined_notes(const MeshData& mesh) {
  std::string all;
  for (const std::string& note : mesh.notes) all += note + "|";
  return all;
}

inline bool bit_equal(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

inline void expect_bit_equal(const MeshData& a, const MeshData& b) {
  ASSERT_EQ(a.rest.size(), b.rest.size());
  ASSERT_EQ(a.deformed.size(), b.deformed.size());
  EXPECT_EQ(a.triangles, b.triangles);
  for (std::size_t v = 0; v < a.rest.size(); ++v) {
    const Point2 r = a.rest[v], s = b.rest[v];
    const Point3 p = a.deformed[v], q = b.deformed[v];
    EXPECT_TRUE(bit_equal(r.x, s.x) && bit_equal(r.y, s.y)) << v;
    EXPECT_TRUE(bit_equal(p.x, q.x) && bit_equal(p.y, q.y) && bit_equal(p.z, q.z)) << v;
  }
}

/// What check_and_repair promises, looked at in the slow, obvious way.
inline void expect_sound(MeshData mesh) {
  ASSERT_EQ(mesh.rest.size(), mesh.deformed.size());
  std::map<std::pair<int, int>, int> directed;
  std::vector<std::vector<std::size_t>> triangles_at(mesh.rest.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    auto rest = [&](int v) { return mesh.rest.at(to_size(v)); };
    EXPECT_EQ(orientation(rest(a), rest(b), rest(c)), 1) << "triangle " << t;
    EXPECT_EQ((++directed[{a, b}]), 1);
    EXPECT_EQ((++directed[{b, c}]), 1);
    EXPECT_EQ((++directed[{c, a}]), 1);
    for (int v : {a, b, c}) triangles_at[to_size(v)].push_back(t);
  }
  // One fan: all triangles at a vertex but one have their predecessor there, or all have one.
  for (std::size_t v = 0; v < triangles_at.size(); ++v) {
    ASSERT_FALSE(triangles_at[v].empty()) << "unused vertex " << v;
    std::set<std::size_t> reached{triangles_at[v].front()};
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t t : triangles_at[v])
        for (std::size_t s : std::set<std::size_t>(reached)) {
          int shared = 0;
          for (int i : mesh.triangles[t]) shared += std::ranges::count(mesh.triangles[s], i) > 0;
          if (shared >= 2) grew = reached.insert(t).second || grew;
        }
    }
    EXPECT_EQ(reached.size(), triangles_at[v].size()) << "bow-tie at vertex " << v;
  }
  const MeshData before = mesh;
  check_and_repair(mesh, "again");
  expect_bit_equal(before, mesh);
  EXPECT_EQ(before.notes, mesh.notes);
}

}  // namespace cutbench
