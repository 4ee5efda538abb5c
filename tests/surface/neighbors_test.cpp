// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shapes.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

std::vector<std::set<int>> by_edges(const Surface& s) {
  std::vector<std::set<int>> out(s.vertices());
  for (int c = 0; c < 3 * s.triangles(); ++c)
    for (const int w : {s.triangle[next_corner(c)], s.triangle[previous_corner(c)]}) out[s.triangle[c]].insert(w);
  return out;
}

// Two sheets that meet at a vertex, with the border through it.
TriangleMesh two_at_a_vertex() {
  TriangleMesh mesh = shapes::joined(shapes::grid(5, 5), shapes::grid(5, 5));
  std::replace(mesh.triangle.begin(), mesh.triangle.end(), 25, 12);
  return mesh;
}

TEST(Neighbors, EachOnceAlsoAtTheBorder) {
  for (const TriangleMesh& mesh : {shapes::icosphere(2), shapes::torus(12, 9), shapes::grid(7, 5), two_at_a_vertex()}) {
    const Surface s = make_surface(mesh);
    const auto expected = by_edges(s);
    for (int v = 0; v < s.vertices(); ++v) {
      std::vector<int> met;
      for_each_neighbor(s, v, [&](int w) { met.push_back(w); });
      EXPECT_EQ(met.size(), expected[v].size()) << v;
      EXPECT_EQ(std::set<int>(met.begin(), met.end()), expected[v]) << v;
    }
  }
}

TEST(Neighbors, AllOfThemOnAOneSidedSurface) {
  const Surface s = make_surface(shapes::moebius_strip());
  ASSERT_FALSE(s.orientable);
  const auto expected = by_edges(s);
  for (int v = 0; v < s.vertices(); ++v) {
    std::set<int> met;
    for_each_neighbor(s, v, [&](int w) { met.insert(w); });
    EXPECT_EQ(met, expected[v]) << v;
  }
}

TEST(SurfaceVertices, AreTheInverseOfMeshVertex) {
  TriangleMesh mesh = shapes::joined(shapes::sphere(), shapes::body());
  mesh.position.insert(mesh.position.begin(), {7, 7, 7});  // used by no face
  for (int& v : mesh.triangle) ++v;
  const Surface s = make_surface(mesh, true);
  const std::vector<int>& of = s.surface_vertex;
  ASSERT_EQ(static_cast<int>(of.size()), mesh.vertices());
  for (int v = 0; v < s.vertices(); ++v) EXPECT_EQ(of[s.mesh_vertex[v]], v);
  EXPECT_EQ(std::count(of.begin(), of.end(), -1), mesh.vertices() - s.vertices());
  EXPECT_EQ(of[0], -1);
}

}  // namespace
}  // namespace ga_symmetry
