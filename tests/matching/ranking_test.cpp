// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/ranking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "matching/scene.h"

namespace ga_symmetry {
namespace {

struct Scene {
  MatchingScene of;
  Sites sites = make_sites(of.surface, of.solver, {100, 300, 8}, 1);
  Landmarks no_references;

  explicit Scene(shapes::Symmetric shape) : of(std::move(shape)) {
    no_references.field.resize(0, of.surface.vertices());
  }
  Matching matching(bool reflection) const {
    SampleMap itself(sites.samples);
    for (int i = 0; i < sites.samples; ++i) itself[i] = i;
    return {of.surface, of.fields, of.shortcuts, of.curvature, images_of(itself, sites, no_references), 0, reflection};
  }
  // The site nearest to where each sample goes.
  template <class To>
  SampleMap map_by(const To& to) const {
    SampleMap map;
    for (int i = 0; i < sites.samples; ++i) map.push_back(sites.nearest[to(sites.vertex[i])]);
    return map;
  }
};

const Scene& creature() {
  static const Scene made(shapes::shuffled(shapes::bent(shapes::creature(3), 0.1), 7));
  return made;
}

SampleMap truth() {
  return creature().map_by([](int v) { return creature().of.shape.partner[v]; });
}
SampleMap identity() {
  return creature().map_by([](int v) { return v; });
}
// Right everywhere but at one arm, which stays in place: a half swap.
SampleMap half_swap() {
  const MatchingScene& s = creature().of;
  const DistanceFields arms = s.solver.fields({s.shape.pair[0], s.shape.pair[1]}, 1);
  const float near = static_cast<float>(0.6 * s.surface.unit());
  return creature().map_by([&](int v) { return std::min(arms(0, v), arms(1, v)) < near ? v : s.shape.partner[v]; });
}

double score(const SampleMap& map) {
  const Scene& s = creature();
  return disagreement(s.matching(true), s.sites, images_of(map, s.sites, s.no_references));
}

TEST(Disagreement, IsLeastForTheTruth) {
  EXPECT_LT(score(truth()), 0.5 * score(half_swap()));
  EXPECT_GT(score(truth()), 0);
}

TEST(Disagreement, TheIdentityIsNoSymmetry) {
  EXPECT_TRUE(std::isinf(score(identity()))) << "all agrees, and nothing is moved";
  SampleMap nearly = identity();
  nearly[3] = truth()[3];
  EXPECT_GT(score(nearly), score(truth()));
}

// The map of vertices by the truth, and what a reflection that is none gives.
TEST(WronglyTurned, ReflectionsTurnFacesOver) {
  const Scene& s = creature();
  const std::vector<int>& truth = s.of.shape.partner;
  std::vector<int> itself(truth.size()), one_place(truth.size(), 5);
  for (std::size_t v = 0; v < itself.size(); ++v) itself[v] = static_cast<int>(v);
  const auto turned = [&](bool reflection, const std::vector<int>& partner) {
    return wrongly_turned(s.matching(reflection), {partner, std::vector<float>(partner.size(), 0.001f)});
  };
  EXPECT_EQ(turned(true, truth), 0);
  EXPECT_EQ(turned(false, truth), 1);
  EXPECT_EQ(turned(true, itself), 1);
  EXPECT_EQ(turned(true, one_place), 0) << "what has no area has no side";
  // One side by the truth, the other stays: half of the area.
  const DistanceFields sides = s.of.solver.fields({s.of.shape.pair[0], s.of.shape.pair[1]}, 1);
  Probes half{truth, std::vector<float>(truth.size(), 0.001f)};
  for (std::size_t v = 0; v < truth.size(); ++v)
    if (sides(0, v) < sides(1, v)) half.partner[v] = static_cast<int>(v);
  EXPECT_NEAR(wrongly_turned(s.matching(true), half), 0.5, 0.1);
  for (std::size_t v = 0; v < truth.size(); ++v)
    if (half.partner[v] == static_cast<int>(v)) half.error[v] = 0.02f;
  EXPECT_EQ(wrongly_turned(s.matching(true), half), 0) << "what has no counterpart has no side";
}

TEST(SameSymmetry, ForgivesNoiseAndTellsMapsApart) {
  const Scene& s = creature();
  const Matching m = s.matching(true);
  const auto images = [&](const SampleMap& map) { return images_of(map, s.sites, s.no_references); };
  SampleMap noisy = truth();
  for (std::size_t i = 0; i < noisy.size(); i += 2) noisy[i] = s.sites.nearest_sample[noisy[i]];
  EXPECT_TRUE(same_symmetry(m, s.sites, images(truth()), images(noisy)));
  EXPECT_FALSE(same_symmetry(m, s.sites, images(truth()), images(half_swap())));
  EXPECT_FALSE(same_symmetry(m, s.sites, images(truth()), images(identity())));
}

TEST(RankMaps, TheTruthIsFirstAndEachSymmetryStandsOnce) {
  const Scene& s = creature();
  const std::vector<SampleMap> maps{half_swap(), truth(), half_swap(), truth()};
  for (const Refine refine : {Refine::contenders, Refine::all}) {
    const auto ranking = rank_maps(s.matching(true), s.sites, maps, s.no_references, refine, 1);
    ASSERT_FALSE(ranking.empty());
    EXPECT_LE(ranking.size(), 2u);
    double error = 0;
    for (int i = 0; i < s.sites.samples; ++i)
      error +=
          ranking[0].images.field(i, s.of.shape.partner[s.sites.vertex[i]]) / s.of.surface.unit() / s.sites.samples;
    EXPECT_LT(error, 0.05);
    EXPECT_EQ(ranking[0].order, 2);
    for (std::size_t i = 1; i < ranking.size(); ++i) EXPECT_LE(ranking[i - 1].score, ranking[i].score);
    EXPECT_EQ(ranking[0].images.field, s.of.solver.fields(ranking[0].images.vertex, 1)) << "fields of the images";
  }
  EXPECT_TRUE(rank_maps(s.matching(true), s.sites, {}, s.no_references, Refine::contenders, 1).empty());
}

// The references keep every vertex where it is: a map that agrees with them comes first, however bad.
TEST(RankMaps, ReferencesAreKept) {
  const Scene& s = creature();
  Matching m = s.matching(true);
  const std::vector<int> pair{s.of.shape.pair[0], s.of.shape.pair[1]};
  const Landmarks kept{pair, s.of.solver.fields(pair, 1)};
  m.landmarks = images_of(
      [&] {
        SampleMap itself(s.sites.samples);
        for (int i = 0; i < s.sites.samples; ++i) itself[i] = i;
        return itself;
      }(),
      s.sites, kept);
  m.fixed = 2;
  const auto ranking = rank_maps(m, s.sites, {truth(), half_swap()}, kept, Refine::all, 1);
  ASSERT_EQ(ranking.size(), 1u) << "the truth moves the pair";
  EXPECT_TRUE(std::isfinite(ranking[0].score));
  double stays = 0;
  for (const int v : pair) {
    const int at = s.sites.nearest_sample[s.sites.nearest[v]];
    stays += ranking[0].images.field(at, s.sites.vertex[at]) / s.of.surface.unit();
  }
  EXPECT_LT(stays, 0.3);
}

TEST(RankMaps, ThreadsChangeNothing) {
  const Scene& s = creature();
  const std::vector<SampleMap> maps{half_swap(), truth(), identity()};
  const auto one = rank_maps(s.matching(true), s.sites, maps, s.no_references, Refine::all, 1);
  const auto four = rank_maps(s.matching(true), s.sites, maps, s.no_references, Refine::all, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, four[i].score);
    EXPECT_EQ(one[i].images.vertex, four[i].images.vertex);
  }
}

constexpr int kAround = 48, kAlong = 16;
const Scene& torus() {
  static const Scene made([] {
    shapes::Symmetric shape{};
    shape.mesh = shapes::torus(kAround, kAlong);
    return shape;
  }());
  return made;
}
// Where a vertex of the torus comes to, turned about its axis.
int turned_vertex(int v, int steps) { return (v / kAlong + steps) % kAround * kAlong + v % kAlong; }

// A torus turned about its axis by a third, a quarter, and an angle that never comes back.
TEST(RankMaps, RotationsKnowTheirOrder) {
  const Scene& s = torus();
  const auto turned = [&](int steps) { return s.map_by([&](int v) { return turned_vertex(v, steps); }); };
  const auto order = [&](int steps) {
    const auto ranking = rank_maps(s.matching(false), s.sites, {turned(steps)}, s.no_references, Refine::contenders, 1);
    return ranking.empty() ? -1 : ranking[0].order;
  };
  EXPECT_EQ(order(kAround / 2), 2);
  EXPECT_EQ(order(kAround / 3), 3);
  EXPECT_EQ(order(kAround / 4), 4);
}

// A third of a turn and its inverse are one symmetry, whichever comes first, and turn the same way.
TEST(RankMaps, ARotationAndItsInverseStandOnceAndTheIdentityNever) {
  const Scene& s = torus();
  const auto turned = [&](int steps) { return s.map_by([&](int v) { return turned_vertex(v, steps); }); };
  const SampleMap there = turned(kAround / 3), back = turned(2 * kAround / 3), stays = turned(0);
  std::vector<Images> found;
  for (const std::vector<SampleMap>& maps : {std::vector{there, back, stays}, std::vector{back, stays, there}}) {
    const auto ranking = rank_maps(s.matching(false), s.sites, maps, s.no_references, Refine::all, 1);
    ASSERT_EQ(ranking.size(), 1u);
    EXPECT_EQ(ranking[0].order, 3);
    found.push_back(ranking[0].images);
  }
  EXPECT_TRUE(same_symmetry(s.matching(false), s.sites, found[0], found[1]));
  EXPECT_TRUE(rank_maps(s.matching(false), s.sites, {stays}, s.no_references, Refine::all, 1).empty());
}

// Whichever way a pair of references goes, so does the rotation.
TEST(RankMaps, ReferencesSayWhichWayARotationTurns) {
  constexpr int kReference = 5;
  const Scene& s = torus();
  for (const int steps : {kAround / 3, 2 * kAround / 3}) {
    const auto to = [&](int v) { return turned_vertex(v, steps); };
    const auto at = [&](int v) { return Landmarks{{v}, s.of.solver.fields({v}, 1)}; };
    Matching m = s.matching(false);
    SampleMap itself(s.sites.samples);
    for (int i = 0; i < s.sites.samples; ++i) itself[i] = i;
    m.landmarks = images_of(itself, s.sites, at(kReference));
    m.fixed = 1;
    const auto ranking = rank_maps(m, s.sites, {s.map_by(to)}, at(to(kReference)), Refine::all, 1);
    ASSERT_EQ(ranking.size(), 1u);
    double off = 0;
    for (int i = 0; i < s.sites.samples; ++i)
      off += ranking[0].images.field(i, to(s.sites.vertex[i])) / s.of.surface.unit() / s.sites.samples;
    EXPECT_LT(off, 0.1) << steps;
  }
}

// A torus has mirror planes without end: that through the references is meant, and not one near it.
TEST(RankMaps, TheNearestToTheReferencesIsFirstWhereAllFit) {
  const Scene& s = torus();
  const auto mirrored = [](int v, int plane) { return (plane + kAround - v / kAlong) % kAround * kAlong + v % kAlong; };
  const auto map = [&](int plane) { return s.map_by([&](int v) { return mirrored(v, plane); }); };
  constexpr int kPlane = 8;
  const std::vector<int> from{2 * kAlong, 12 * kAlong + 3};
  const std::vector<int> to{mirrored(from[0], kPlane), mirrored(from[1], kPlane)};
  Matching m = s.matching(true);
  SampleMap itself(s.sites.samples);
  for (int i = 0; i < s.sites.samples; ++i) itself[i] = i;
  m.landmarks = images_of(itself, s.sites, {from, s.of.solver.fields(from, 1)});
  m.fixed = 2;
  const Landmarks kept{to, s.of.solver.fields(to, 1)};
  const auto candidates = candidates_of(m, s.sites, {map(kPlane), map(kPlane + 1)}, kept, 1);
  EXPECT_LT(2 * candidates[0].off_references, candidates[1].off_references);
  for (const std::vector<SampleMap>& maps :
       {std::vector{map(kPlane), map(kPlane + 1)}, std::vector{map(kPlane - 1), map(kPlane + 1), map(kPlane)}}) {
    const auto ranking = rank_maps(m, s.sites, maps, kept, Refine::contenders, 1);
    ASSERT_FALSE(ranking.empty());
    double off = 0;
    for (int i = 0; i < s.sites.samples; ++i)
      off += ranking[0].images.field(i, mirrored(s.sites.vertex[i], kPlane)) / s.of.surface.unit() / s.sites.samples;
    EXPECT_LT(off, 0.05);
  }
}

TEST(Confidence, GrowsWithTheLeadOfTheBest) {
  const auto confidence = [](const std::vector<double>& scores) {
    std::vector<Candidate> ranking;
    for (const double score : scores) ranking.push_back({{}, 2, score});
    return confidence_of(ranking);
  };
  EXPECT_GT(confidence({0.02}), 0.99) << "nothing else, and it fits";
  EXPECT_LT(confidence({0.4}), 0.2) << "nothing else, but this is no symmetry either";
  EXPECT_GT(confidence({0.02, 0.1}), 0.99);
  EXPECT_NEAR(confidence({0.02, 0.02}), 0.5, 0.1) << "no telling which";
  EXPECT_EQ(confidence({0.02, 0.02}), confidence({0.05, 0.05}));
  EXPECT_EQ(confidence({0, 0}), confidence({0.02, 0.02})) << "two perfect ones";
  EXPECT_EQ(confidence({0.02, INFINITY}), confidence({0.02}));
  EXPECT_EQ(confidence({INFINITY, INFINITY}), 0);
  EXPECT_EQ(confidence({}), 0);
  double before = 0;
  for (const double next : {0.02, 0.03, 0.05, 0.1}) {
    EXPECT_GT(confidence({0.02, next}), before);
    before = confidence({0.02, next});
  }
}

}  // namespace
}  // namespace ga_symmetry
