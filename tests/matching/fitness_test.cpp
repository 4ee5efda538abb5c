// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/fitness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "matching/scene.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

struct Mapped {
  MatchingScene scene{shapes::shuffled(shapes::creature(4), 5)};
  Matching matching = scene.matching(60);
  DenseMap truth = make_dense_map(matching, scene.truth(matching.landmarks), {true, true, false}, 1);
};

TEST(VertexFitness, IsNearZeroForAPerfectMap) {
  Mapped m;
  const std::vector<double> fitness = vertex_fitness(m.matching, m.truth, m.scene.diffusion);
  ASSERT_EQ(static_cast<int>(fitness.size()), m.scene.surface.vertices());
  EXPECT_GE(*std::min_element(fitness.begin(), fitness.end()), 0);
  EXPECT_LT(*std::max_element(fitness.begin(), fitness.end()), 0.03);
}

// An arm whose partners are wrong by a fifth of a unit is worse there, and only there.
TEST(VertexFitness, IsWorseWhereTheMapIsWrong) {
  Mapped m;
  const MatchingScene& s = m.scene;
  const DistanceFields arm = s.solver.fields({s.shape.pair[0]}, 1);
  DenseMap wrong = m.truth;
  const float near = static_cast<float>(0.3 * s.surface.unit()), far = static_cast<float>(0.6 * s.surface.unit());
  for (int v = 0; v < s.surface.vertices(); ++v)
    if (arm(0, v) < near)
      for (int step = 0; step < 6; ++step) {
        int best = wrong.partner[v];
        for_each_neighbor(s.surface, best, [&](int w) {
          if (s.surface.point(w)[2] > s.surface.point(best)[2]) best = w;
        });
        wrong.partner[v] = best;
      }
  const std::vector<double> before = vertex_fitness(m.matching, m.truth, m.scene.diffusion),
                            after = vertex_fitness(m.matching, wrong, m.scene.diffusion);
  std::vector<double> there, elsewhere;
  for (int v = 0; v < s.surface.vertices(); ++v) {
    const float other = arm(0, s.shape.partner[v]);  // from the other arm
    if (arm(0, v) < near / 2) there.push_back(after[v] - before[v]);
    if (arm(0, v) > far && other > far) elsewhere.push_back(after[v] - before[v]);
  }
  ASSERT_GT(there.size(), 10u);
  ASSERT_GT(elsewhere.size(), 100u);
  EXPECT_GT(mean(there), 0.05);
  EXPECT_LT(std::abs(mean(elsewhere)), 0.002);
}

TEST(VertexFitness, CollapsedPartsAreStretchedAndSaid) {
  Mapped m;
  DenseMap collapsed = m.truth;
  std::fill(collapsed.partner.begin(), collapsed.partner.end(), 17);
  EXPECT_GT(mean(vertex_fitness(m.matching, collapsed, m.scene.diffusion)),
            10 * mean(vertex_fitness(m.matching, m.truth, m.scene.diffusion)));
}

}  // namespace
}  // namespace ga_symmetry
