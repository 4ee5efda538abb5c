// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/registration.h"

#include <gtest/gtest.h>

#include <atomic>

#include "ga_symmetry/errors.h"
#include "matching/scene.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

SurfaceMap at_vertices(const std::vector<int>& partner) {
  SurfaceMap out{partner, {}};
  for (const int v : partner) out.point.push_back({{v, v, v}, {1, 0, 0}});
  return out;
}

// Every vertex some edges off the truth, neighbours in much the same direction: a part that has slipped, which no
// average puts right.
SurfaceMap slipped(const MatchingScene& s, int edges) {
  std::vector<int> partner = s.shape.partner;
  for (int& at : partner)
    for (int step = 0; step < edges; ++step) {
      int highest = at;
      for_each_neighbor(s.surface, at,
                        [&](int w) { highest = s.surface.point(w)[2] > s.surface.point(highest)[2] ? w : highest; });
      at = highest;
    }
  return at_vertices(partner);
}

TEST(RegisterDiscs, PutsBackWhatHasSlipped) {
  const MatchingScene& s = creature_scene();
  for (const int edges : {1, 2}) {
    const SurfaceMap before = slipped(s, edges), after = register_discs(s.matching(100), before, 1);
    EXPECT_LT(s.error(after.partner), 0.3 * s.error(before.partner)) << edges;
    for (int v = 0; v < s.surface.vertices(); ++v) {
      double sum = 0;
      for (const double w : after.point[v].weight) sum += w;
      ASSERT_NEAR(sum, 1, 1e-6);
      ASSERT_GE(after.partner[v], 0);
    }
  }
}

TEST(RegisterDiscs, LeavesTheTruth) {
  const MatchingScene& s = creature_scene();
  EXPECT_EQ(register_discs(s.matching(100), at_vertices(s.shape.partner), 1).partner, s.shape.partner);
}

TEST(RegisterDiscs, KnowsARotationFromAReflection) {
  const MatchingScene& s = creature_scene();
  std::vector<int> itself(s.surface.vertices());
  for (int v = 0; v < s.surface.vertices(); ++v) itself[v] = v;
  Matching m = s.matching(100);
  m.reflection = false;
  EXPECT_EQ(register_discs(m, at_vertices(itself), 1).partner, itself);
}

TEST(RegisterDiscs, LeavesWhatNoDiscHasEnoughVerticesFor) {
  const MatchingScene s(shapes::creature(0));
  const SurfaceMap map = at_vertices(s.shape.partner);
  EXPECT_EQ(register_discs(s.matching(4), map, 1).partner, map.partner);
}

TEST(RegisterDiscs, ThreadsChangeNothing) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(60);
  const SurfaceMap one = register_discs(m, slipped(s, 2), 1), four = register_discs(m, slipped(s, 2), 4);
  EXPECT_EQ(one.partner, four.partner);
  for (int v = 0; v < s.surface.vertices(); ++v) ASSERT_EQ(one.point[v].weight, four.point[v].weight);
}

TEST(RegisterDiscs, CanBeCancelled) {
  const MatchingScene& s = creature_scene();
  const std::atomic<bool> cancel{true};
  EXPECT_THROW(register_discs(s.matching(20), slipped(s, 1), 2, {nullptr, &cancel, nullptr}), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
