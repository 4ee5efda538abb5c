// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/spectral.h"

#include <gtest/gtest.h>

#include "matching/scene.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

// Every vertex a few edges off the truth, all in different directions.
SurfaceMap noisy(const MatchingScene& s, int edges) {
  SurfaceMap out;
  for (int v = 0; v < s.surface.vertices(); ++v) {
    int at = s.shape.partner[v];
    for (int step = 0; step < edges; ++step) {
      std::vector<int> around;
      for_each_neighbor(s.surface, at, [&](int w) { around.push_back(w); });
      at = around[(v + step) % around.size()];
    }
    out.partner.push_back(at);
    out.point.push_back({{at, at, at}, {1, 0, 0}});
  }
  return out;
}

TEST(SpectralRefinement, TakesNoiseOutOfAMap) {
  const MatchingScene& s = creature_scene();
  const SurfaceMap before = noisy(s, 3), after = spectral_refinement(s.matching(20), before, 1);
  EXPECT_LT(s.error(after.partner), 0.3 * s.error(before.partner));
  for (int v = 0; v < s.surface.vertices(); ++v) {
    double sum = 0;
    for (const double w : after.point[v].weight) sum += w;
    ASSERT_NEAR(sum, 1, 1e-6);
    ASSERT_EQ(after.point[v].vertex[0], after.partner[v]);
  }
}

TEST(SpectralRefinement, LeavesTheTruth) {
  const MatchingScene& s = creature_scene();
  EXPECT_LT(s.error(spectral_refinement(s.matching(20), noisy(s, 0), 1).partner), 0.003);
}

TEST(SpectralRefinement, ThreadsChangeNothing) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(20);
  EXPECT_EQ(spectral_refinement(m, noisy(s, 3), 1).partner, spectral_refinement(m, noisy(s, 3), 4).partner);
}

TEST(SpectralRefinement, ATinySurfaceStaysAsItIs) {
  const MatchingScene s(shapes::creature(1));
  const SurfaceMap map = noisy(s, 0);
  EXPECT_EQ(spectral_refinement(s.matching(20), map, 1).partner, map.partner);
}

}  // namespace
}  // namespace ga_symmetry
