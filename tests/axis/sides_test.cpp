// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geodesics/sampling.h"
#include "partners/known_creature.h"
#include "surface/neighbors.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

int pieces(const Surface& surface, const std::vector<float>& function) {
  std::vector<int> piece(surface.vertices(), -1);
  int count = 0;
  for (int start = 0; start < surface.vertices(); ++start) {
    if (piece[start] >= 0) continue;
    std::vector<int> stack{start};
    piece[start] = count;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int corner = 0; corner < 3 * surface.triangles(); ++corner) {
        if (surface.triangle[corner] != v) continue;
        for (const int w : {surface.triangle[next_corner(corner)], surface.triangle[previous_corner(corner)]})
          if (piece[w] < 0 && (function[w] > 0) == (function[v] > 0)) piece[w] = count, stack.push_back(w);
      }
    }
    ++count;
  }
  return count;
}

TEST(ConnectSides, JoinsWhatIsCutOffAndDropsWhatIsStray) {
  const TriangleMesh mesh = shapes::icosphere(3);
  const Surface surface = make_surface(mesh);
  std::vector<float> clean;
  const auto point = [&](int v) { return &mesh.position[3 * surface.mesh_vertex[v]]; };
  for (int v = 0; v < surface.vertices(); ++v) clean.push_back(static_cast<float>(point(v)[0]) + 0.01f);
  auto function = clean;
  connect_sides(surface, function);
  EXPECT_EQ(function, clean) << "two sides in one piece each were changed";
  // A weak spot in the middle of the other side goes over to it, and nothing else changes.
  const auto within = [&](int v, double x, double y, double z, double radius) {
    const double* p = point(v);
    return std::hypot(p[0] - x, p[1] - y, p[2] - z) < radius;
  };
  for (int v = 0; v < surface.vertices(); ++v)
    if (within(v, -1, 0, 0, 0.3)) function[v] = 0.01f;
  ASSERT_EQ(pieces(surface, function), 3);
  connect_sides(surface, function);
  EXPECT_EQ(pieces(surface, function), 2);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_EQ(function[v] > 0, clean[v] > 0);
  // A strong part of the left that a weak ditch cuts off is joined to it again: the part keeps its sign.
  function = clean;
  for (int v = 0; v < surface.vertices(); ++v)
    if (within(v, 1, 0, 0, 0.6) && !within(v, 1, 0, 0, 0.35)) function[v] = -0.01f;
  ASSERT_EQ(pieces(surface, function), 4);
  const auto before = function;
  connect_sides(surface, function);
  EXPECT_EQ(pieces(surface, function), 2);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_TRUE(before[v] <= 0 || function[v] > 0) << v;
}

TEST(ConnectSides, PiecesAtABorderStay) {
  const TriangleMesh mesh = shapes::grid(20, 20);
  const Surface surface = make_surface(mesh);
  std::vector<float> function;
  for (int v = 0; v < surface.vertices(); ++v)
    function.push_back(static_cast<float>(0.1 - std::abs(mesh.position[3 * v] - 0.5)));  // a strip across
  const auto before = function;
  ASSERT_EQ(pieces(surface, function), 3);
  connect_sides(surface, function);
  EXPECT_EQ(function, before);
}

// The work is that of the surface, not of the surface times its stray pieces.
TEST(ConnectSides, TakesAFewRoundsHoweverManyStrayPiecesThereAre) {
  const TriangleMesh mesh = shapes::icosphere(5);
  const Surface surface = make_surface(mesh);
  std::vector<float> function;
  std::vector<char> near_stray(surface.vertices(), 0);
  int stray = 0;
  for (int v = 0; v < surface.vertices(); ++v) {
    const float x = static_cast<float>(mesh.position[3 * surface.mesh_vertex[v]]);
    const bool alone = std::abs(x) > 0.2f && !near_stray[v];
    if (alone) {
      ++stray;
      near_stray[v] = 1;
      for_each_neighbor(surface, v, [&](int w) {
        near_stray[w] = 1;
        for_each_neighbor(surface, w, [&](int u) { near_stray[u] = 1; });
      });
    }
    function.push_back(alone ? -0.001f * x : x + 1e-4f);
  }
  ASSERT_GT(stray, 500);
  EXPECT_LE(connect_sides(surface, function), 3);
  EXPECT_EQ(pieces(surface, function), 2);
}

// Landmarks on both sides, every tenth with a wrong image: no limb may change sides for it.
TEST(LeftRightFunction, OneSideIsOneSideEverywhere) {
  const Creature& c = creature();
  const Surface surface = make_surface(c.mesh);
  const GeodesicSolver solver(surface);
  const Landmarks from = evenly_spaced_samples(surface, solver, 80, 1);
  Landmarks to;
  for (const int v : from.vertex) to.vertex.push_back(c.partners.partner[v]);
  for (std::size_t i = 5; i < to.vertex.size(); i += 10) to.vertex[i] = to.vertex[i - 1];
  to.field = solver.fields(to.vertex, 1);
  const auto side = sides(surface, left_right_function(surface, from, to));
  int same = 0, other = 0, axis = 0;
  for (int v = 0; v < surface.vertices(); ++v) {
    if (std::abs(c.straight.mesh.position[3 * v]) < 0.2) continue;  // two edges from the axis, or nearer
    const int product = side[v] * c.partners.side[v];
    ++(product > 0 ? same : product < 0 ? other : axis);
  }
  EXPECT_EQ(std::min(same, other), 0) << same << " as by construction, " << other << " the other way";
  EXPECT_LT(axis, 0.01 * surface.vertices());
}

TEST(Sides, OfAnEdgeThatCrossesTheAxisTheNearerEndIsOnIt) {
  const Surface surface = make_surface(shapes::grid(5, 5));
  std::vector<float> function;
  for (int v = 0; v < surface.vertices(); ++v)
    function.push_back(static_cast<float>(surface.point(v)[0]) - static_cast<float>(surface.point(7)[0]) - 0.01f);
  // Columns at -0.51, -0.26, -0.01, 0.24, 0.49 from the axis: the third is on it.
  const std::vector<int> side = sides(surface, function);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_EQ(side[v], v % 5 < 2 ? -1 : v % 5 == 2 ? 0 : 1) << v;
}

}  // namespace
}  // namespace ga_symmetry
