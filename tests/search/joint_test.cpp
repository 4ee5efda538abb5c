// SPDX-License-Identifier: GPL-3.0-or-later
// The joint search put together.
#include "search/joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scene.h"

namespace ga_symmetry {
namespace {

JointProblem problem(const JointOptions& options, const SurfaceReferences& references = {}) {
  const SearchScene& s = search_scene();
  return JointProblem(s.sites, s.surface, SymmetryKind::reflection,
                      make_anchors(references, SymmetryKind::reflection, s.solver, 1), options);
}

TEST(JointProblem, EvaluationImprovesTheMapAndScoresIt) {
  const JointProblem p = problem({});
  SampleMap map = search_scene().random_map(1);
  const double before = p.cost().score(map);
  const double score = p.evaluate(map, 0);
  EXPECT_LT(score, before);
  EXPECT_EQ(score, p.cost().score(map));
  SampleMap identity = search_scene().identity();
  EXPECT_TRUE(std::isinf(problem(without_orientation()).evaluate(identity, 0))) << "the identity is no symmetry";
}

TEST(JointProblem, ReferencesAreTheSamplesOfRegionCrossover) {
  EXPECT_TRUE(problem({}).anchors().empty());
  EXPECT_EQ(problem({}, search_scene().references()).anchors().size(), 4u);
}

TEST(SearchJoint, BestCostNeverRisesAndTheSeedDecides) {
  JointOptions o;
  o.max_generations = 8;
  const JointProblem p = problem(o, search_scene().references());
  Random first(3), second(3);
  const JointResult a = search_joint(p, first, 1), b = search_joint(p, second, 4);
  EXPECT_EQ(a.maps, b.maps);
  for (std::size_t g = 1; g < a.log.size(); ++g) EXPECT_LE(a.log[g].best, a.log[g - 1].best);
  for (std::size_t i = 1; i < a.scores.size(); ++i) EXPECT_LE(a.scores[i - 1], a.scores[i]);
}

TEST(SearchJoint, AFurtherSeedMayBeTheAnswer) {
  JointOptions o;
  o.max_generations = 0;
  const JointProblem p = problem(o);
  const SampleMap truth = search_scene().truth();
  Random random(3), same(3);
  const JointResult without = search_joint(p, random, 1), with = search_joint(p, same, 1, {}, {truth});
  SampleMap improved = truth;
  EXPECT_LE(with.scores[0], 1.05 * p.evaluate(improved, 0)) << "it starts at the samples nearest to the seed's sites";
  EXPECT_LE(with.scores[0], 1.05 * without.scores[0]) << "more seeds compete for the same places";
  EXPECT_LT(map_distance(search_scene().sites, with.maps[0], truth), 0.1);
}

TEST(SearchJoint, EndsOnceItIsEnough) {
  const JointProblem p = problem({});
  int asked = 0;
  const auto search = [&](int enough_at) {
    Random random(3);
    asked = 0;
    return search_joint(p, random, 2, {}, {}, [&](const std::vector<SampleMap>& best) {
      EXPECT_FALSE(best.empty());
      EXPECT_LE(best.size(), 3u);
      for (std::size_t i = 1; i < best.size(); ++i) {
        EXPECT_LE(p.cost().score(best[i - 1]), p.cost().score(best[i]));
        EXPECT_GT(map_distance(search_scene().sites, best[i - 1], best[i]), 0.1);
      }
      return ++asked == enough_at;
    });
  };
  const JointResult ended = search(2);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(ended.stop, StopReason::success_threshold);
  EXPECT_EQ(ended.log.back().generation, 10);
  const JointResult whole = search(0);
  EXPECT_GE(asked, 3);
  EXPECT_NE(whole.stop, StopReason::success_threshold);
  Random random(3);
  EXPECT_EQ(whole.maps, search_joint(p, random, 2).maps) << "to ask changes nothing";
}

}  // namespace
}  // namespace ga_symmetry
