// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "ga_symmetry/errors.h"
#include "partners/known_creature.h"

namespace ga_symmetry {
namespace {

TEST(SymmetryColors, PartnersAreAlikeOthersAreNot) {
  const Partners& p = creature().partners;
  const std::vector<Color> colors = vertex_colors(creature().mesh, p, ColorBy::symmetry);
  std::set<Color> left;
  int lefts = 0;
  for (std::size_t v = 0; v < colors.size(); ++v) {
    ASSERT_EQ(colors[v], colors[p.partner[v]]) << v;
    if (p.side[v] > 0) left.insert(colors[v]), ++lefts;
    if (p.partner[v] == static_cast<int>(v)) {
      EXPECT_LT(*std::max_element(colors[v].begin(), colors[v].end()), 60);
    }
  }
  EXPECT_GT(static_cast<double>(left.size()), 0.9 * lefts);
}

// One scale for every mesh: what else is on it changes no colour.
TEST(FitnessColors, BlueIsPerfectRedIsPoor) {
  EXPECT_EQ(fitness_color(0), (Color{0, 0, 255}));
  EXPECT_EQ(fitness_color(kRedFitness / 2), (Color{0, 255, 0}));
  EXPECT_EQ(fitness_color(kRedFitness), (Color{255, 0, 0}));
  for (const double poor : {1.0, 1e6, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(fitness_color(poor), (Color{255, 0, 0}));
  Partners p = creature().partners;
  p.fitness[3] = 0.05;
  const Color good = vertex_colors(creature().mesh, p, ColorBy::fitness)[3];
  p.fitness.assign(p.fitness.size(), 10);
  p.fitness[3] = 0.05;
  const std::vector<Color> colors = vertex_colors(creature().mesh, p, ColorBy::fitness);
  EXPECT_EQ(colors[3], good);
  EXPECT_EQ(colors[4], (Color{255, 0, 0}));
}

TEST(SymmetryColors, GreyWithoutAPartner) {
  Partners p = creature().partners;
  p.partner[7] = -1;
  for (const auto& colors :
       {vertex_colors(creature().mesh, p, ColorBy::symmetry), vertex_colors(creature().mesh, p, ColorBy::sides)})
    EXPECT_EQ(colors[7], (Color{128, 128, 128}));
  p.side.pop_back();
  EXPECT_THROW(vertex_colors(creature().mesh, p, ColorBy::symmetry), InvalidOption);
  EXPECT_THROW(vertex_colors(creature().mesh, p, ColorBy::sides), InvalidOption);
}

TEST(SideColors, OneColourASide) {
  const Partners& p = creature().partners;
  const std::vector<Color> colors = vertex_colors(creature().mesh, p, ColorBy::sides);
  std::set<Color> of_side[3];
  for (std::size_t v = 0; v < colors.size(); ++v) of_side[p.side[v] + 1].insert(colors[v]);
  for (const auto& colors_of : of_side) EXPECT_EQ(colors_of.size(), 1u);
  EXPECT_NE(of_side[0], of_side[2]);
}

}  // namespace
}  // namespace ga_symmetry
