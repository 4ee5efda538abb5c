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
  const SpectralRefinement spectral(s.surface, 1);
  for (const int edges : {1, 3}) {
    const SurfaceMap before = noisy(s, edges);
    const SurfaceMap after = spectral.refine(s.matching(20), before, edges == 1 ? kAllFunctions : kFewFunctions, 1);
    EXPECT_LT(s.error(after.partner), 0.3 * s.error(before.partner));
    for (int v = 0; v < s.surface.vertices(); ++v) {
      double sum = 0;
      for (const double w : after.point[v].weight) sum += w;
      ASSERT_NEAR(sum, 1, 1e-6);
      ASSERT_EQ(after.point[v].vertex[0], after.partner[v]);
    }
  }
}

TEST(SpectralRefinement, LeavesTheTruth) {
  const MatchingScene& s = creature_scene();
  const SpectralRefinement spectral(s.surface, 1);
  for (const int from : {kFewFunctions, kAllFunctions})
    EXPECT_LT(s.error(spectral.refine(s.matching(20), noisy(s, 0), from, 1).partner), 0.003);
}

TEST(SpectralRefinement, ThreadsChangeNothing) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(20);
  const SpectralRefinement one(s.surface, 1), four(s.surface, 4);
  EXPECT_EQ(one.refine(m, noisy(s, 3), kFewFunctions, 1).partner,
            four.refine(m, noisy(s, 3), kFewFunctions, 4).partner);
}

TEST(SpectralRefinement, ASmallSurfaceGoesByTheFunctionsThatItHas) {
  const MatchingScene s(shapes::creature(2));  // 162 vertices
  const SpectralRefinement spectral(s.surface, 1);
  EXPECT_NE(spectral.refine(s.matching(20), noisy(s, 2), kAllFunctions, 1).partner, noisy(s, 2).partner);
}

TEST(SpectralRefinement, ATinySurfaceStaysAsItIs) {
  const MatchingScene s(shapes::creature(1));
  const SurfaceMap map = noisy(s, 0);
  EXPECT_EQ(SpectralRefinement(s.surface, 1).refine(s.matching(20), map, kFewFunctions, 1).partner, map.partner);
}

}  // namespace
}  // namespace ga_symmetry
