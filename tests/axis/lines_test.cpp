// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to draw of a symmetry that is known: pairs, and the axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "partners/known_creature.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

TEST(Pairs, SpreadOverTheLeftAndNested) {
  const auto pairs = spread_pairs(creature().mesh, creature().partners, 40);
  ASSERT_EQ(pairs.size(), 40u);
  std::set<int> used;
  for (const SymmetricPair& pair : pairs) {
    EXPECT_EQ(creature().partners.side[pair.vertex], 1);
    EXPECT_EQ(pair.partner, creature().partners.partner[pair.vertex]);
    EXPECT_TRUE(used.insert(pair.vertex).second) << "chosen twice";
  }
  const auto fewer = spread_pairs(creature().mesh, creature().partners, 10);
  for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_EQ(fewer[i].vertex, pairs[i].vertex);
  const auto& side = creature().partners.side;
  EXPECT_EQ(spread_pairs(creature().mesh, creature().partners, 100000).size(),
            static_cast<std::size_t>(std::count(side.begin(), side.end(), 1)));
  EXPECT_THROW(spread_pairs(creature().mesh, creature().partners, 0), InvalidOption);
}

TEST(Pairs, NoneWithoutPartners) {
  Partners p = creature().partners;
  std::fill(p.partner.begin(), p.partner.end(), -1);
  EXPECT_TRUE(spread_pairs(creature().mesh, p, 10).empty());
}

// Points of the axis on the straight creature, where it is the plane x = 0.
TEST(AxisLines, OneClosedLineInThePlane) {
  const Creature& c = creature();
  const auto lines = axis_lines(c.mesh, c.partners, 1);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_GT(lines[0].size(), 50u);
  EXPECT_EQ(position_of(c.mesh, lines[0].front()), position_of(c.mesh, lines[0].back())) << "not closed";
  double off = 0;
  for (const SurfacePoint& point : lines[0]) off += std::abs(position_of(c.straight.mesh, point)[0]);
  // The creature is about 4 long, its edges about 0.08; bending moves the middle of the distances by a little.
  EXPECT_LT(off / static_cast<double>(lines[0].size()), 0.08);
  const auto threads = axis_lines(c.mesh, c.partners, 3);
  ASSERT_EQ(threads[0].size(), lines[0].size());
  for (std::size_t i = 0; i < lines[0].size(); ++i) EXPECT_EQ(threads[0][i].weight, lines[0][i].weight);
}

// A thin tail on the axis is nearly its own mirror image: a map that leaves it in place is hardly wrong, but tells
// nothing of its sides.
TEST(AxisLines, OneLineThoughTheMapLeavesTheTailInPlace) {
  const Creature& c = creature();
  Partners p = c.partners;
  const double* tip = &c.straight.mesh.position[3 * c.straight.axis[1]];
  int in_place = 0;
  for (std::size_t v = 0; v < p.partner.size(); ++v) {
    const double* x = &c.straight.mesh.position[3 * v];
    if (std::hypot(x[0] - tip[0], x[1] - tip[1], x[2] - tip[2]) > 0.8) continue;
    p.partner[v] = static_cast<int>(v);
    ++in_place;
  }
  ASSERT_GT(in_place, 50);
  EXPECT_EQ(axis_lines(c.mesh, p, 1).size(), 1u);
}

// Mirrored in x its axis goes twice around the tube, mirrored in z twice around the hole.
TEST(AxisLines, ATorusKeepsBothItsLines) {
  const TriangleMesh mesh = shapes::torus(48, 24);
  for (const int mirrored : {0, 2}) {
    Partners p;
    for (int v = 0; v < mesh.vertices(); ++v) {
      double at[3] = {mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]};
      p.side.push_back(std::abs(at[mirrored]) < 1e-9 ? 0 : at[mirrored] > 0 ? 1 : -1);
      at[mirrored] = -at[mirrored];
      int nearest = 0;
      const auto distance = [&](int w) {
        return std::hypot(mesh.position[3 * w] - at[0], mesh.position[3 * w + 1] - at[1],
                          mesh.position[3 * w + 2] - at[2]);
      };
      for (int w = 1; w < mesh.vertices(); ++w)
        if (distance(w) < distance(nearest)) nearest = w;
      ASSERT_LT(distance(nearest), 1e-9);
      p.partner.push_back(nearest);
      p.fitness.push_back(0);
    }
    const auto lines = axis_lines(mesh, p, 1);
    ASSERT_EQ(lines.size(), 2u) << "mirrored in "
                                << "xyz"[mirrored];
    for (const auto& line : lines) {
      EXPECT_EQ(position_of(mesh, line.front()), position_of(mesh, line.back())) << "not closed";
      for (const SurfacePoint& point : line) EXPECT_LT(std::abs(position_of(mesh, point)[mirrored]), 0.1);
    }
  }
}

TEST(AxisLines, OneClosedLineOnTheSamples) {
  for (const std::string name : {"animal_graze", "animal_walk", "person_dance"}) {
    const TriangleMesh mesh = read_mesh(std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/" + name + ".off");
    const Result found = find_symmetry(mesh);
    const auto lines = axis_lines(mesh, found.partners, 0);
    ASSERT_EQ(lines.size(), 1u) << name;
    EXPECT_EQ(position_of(mesh, lines[0].front()), position_of(mesh, lines[0].back())) << name << ": not closed";
  }
}

TEST(AxisLines, NoneAfterARotation) {
  Partners p = creature().partners;
  std::fill(p.side.begin(), p.side.end(), 0);
  EXPECT_THROW(axis_lines(creature().mesh, p, 1), InvalidOption);
}

TEST(ValueAt, Interpolates) {
  const SurfacePoint point{{2, 0, 1}, {0.5, 0.25, 0.25}};
  EXPECT_DOUBLE_EQ(value_at({4, 8, 2}, point), 4);
}

}  // namespace
}  // namespace ga_symmetry
