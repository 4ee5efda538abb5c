// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/samples.h"
#include "shapes.h"

namespace ga_symmetry {
namespace {

// A bumpy body without any symmetry, so that no two distances tie.
TriangleMesh lopsided() {
  TriangleMesh mesh = shapes::body();
  Random random(5);
  for (std::size_t i = 0; i < mesh.position.size(); i += 3) {
    mesh.position[i] *= 1 + 0.1 * std::tanh(mesh.position[i]);
    for (int k = 0; k < 3; ++k) mesh.position[i + k] += 0.004 * (2 * draw_unit(random) - 1);
  }
  return mesh;
}

bool same(const Landmarks& a, const Landmarks& b) {
  return a.vertex == b.vertex && a.field.size() == b.field.size() &&
         std::memcmp(a.field.data(), b.field.data(), sizeof(float) * a.field.size()) == 0;
}

class Sampled : public ::testing::Test {
 protected:
  const Surface surface = make_surface(lopsided());
  const GeodesicSolver solver{surface};
};

TEST_F(Sampled, KeepTheFieldsOfTheirVertices) {
  const Landmarks samples = evenly_spaced_samples(surface, solver, 12, 1);
  const DistanceFields fields = solver.fields(samples.vertex, 1);
  EXPECT_EQ(0, std::memcmp(fields.data(), samples.field.data(), sizeof(float) * fields.size()));
}

TEST_F(Sampled, EvenlySpacedAreNested) {
  const Landmarks many = evenly_spaced_samples(surface, solver, 60, 1),
                  few = evenly_spaced_samples(surface, solver, 17, 1);
  EXPECT_TRUE(std::equal(few.vertex.begin(), few.vertex.end(), many.vertex.begin()));
}

TEST_F(Sampled, EvenlySpacedCoverAsFarAsTheyAreApart) {
  const Landmarks samples = evenly_spaced_samples(surface, solver, 60, 1);
  float previous = std::numeric_limits<float>::infinity();
  for (int k = 2; k <= 60; ++k) {
    const float cover = samples.field.topRows(k).colwise().minCoeff().maxCoeff();
    EXPECT_LE(cover, previous) << "a further sample never covers less";
    previous = cover;
    float apart = std::numeric_limits<float>::infinity();
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < i; ++j) apart = std::min(apart, samples.field(j, samples.vertex[i]));
    EXPECT_GE(apart, cover);
  }
}

TEST_F(Sampled, EvenlySpacedAreTheSameOnAnyNumberOfThreads) {
  const Landmarks one = evenly_spaced_samples(surface, solver, 80, 1);
  for (const int threads : {0, 2, 3, 4, 9}) EXPECT_TRUE(same(one, evenly_spaced_samples(surface, solver, 80, threads)));
}

TEST_F(Sampled, EvenlySpacedAreTheSameUnderAnotherNumbering) {
  std::vector<int> to;
  const Surface other = make_surface(shapes::shuffled(lopsided(), 23, &to));
  const Landmarks a = evenly_spaced_samples(surface, solver, 40, 1);
  const Landmarks b = evenly_spaced_samples(other, GeodesicSolver(other), 40, 1);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(to[a.vertex[i]], b.vertex[i]) << i;
}

TEST_F(Sampled, EvenlySpacedCanBeAllVertices) {
  const Surface small = make_surface(shapes::sphere(5, 8));
  Landmarks all = evenly_spaced_samples(small, GeodesicSolver(small), small.vertices(), 4);
  EXPECT_EQ(static_cast<int>(std::set<int>(all.vertex.begin(), all.vertex.end()).size()), small.vertices());
}

TEST_F(Sampled, FarthestPointsOfAPartAreItsOwnAndNested) {
  std::vector<int> upper;
  for (int v = 0; v < surface.vertices(); ++v)
    if (surface.point(v)[2] > 0) upper.push_back(v);
  const std::vector<int> many = farthest_points(surface, solver, upper, 40),
                         few = farthest_points(surface, solver, upper, 11);
  ASSERT_EQ(many.size(), 40u);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  const DistanceFields fields = solver.fields(many, 1);
  for (int k = 1; k < 40; ++k) {
    const auto nearest = [&](int v) { return fields.topRows(k).col(v).minCoeff(); };
    for (const int v : upper) ASSERT_LE(nearest(v), nearest(many[k]) * (1 + 1e-5f)) << k;
  }
  const std::vector<int> all = farthest_points(surface, solver, upper, 1000000);
  EXPECT_EQ(std::set<int>(all.begin(), all.end()), std::set<int>(upper.begin(), upper.end()));
  EXPECT_EQ(all.size(), upper.size());
  EXPECT_TRUE(farthest_points(surface, solver, {}, 5).empty());
}

TEST_F(Sampled, UniformAreAllDifferent) {
  Random random(1);
  const std::vector<int> all = uniform_sample_vertices(surface, surface.vertices(), random);
  EXPECT_EQ(static_cast<int>(std::set<int>(all.begin(), all.end()).size()), surface.vertices());
}

TEST_F(Sampled, UniformFollowTheSeed) {
  Random a(4), b(4), c(5);
  const std::vector<int> first = uniform_sample_vertices(surface, 30, a);
  EXPECT_EQ(first, uniform_sample_vertices(surface, 30, b));
  EXPECT_NE(first, uniform_sample_vertices(surface, 30, c));
}

TEST_F(Sampled, UniformFollowTheAreaNotTheVertices) {
  // Half of the vertices are large: they have half of the vertices, but more of the area.
  std::vector<double> sorted = surface.vertex_area;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  double share = 0;
  for (const double area : surface.vertex_area) share += area > median ? area / surface.area : 0;
  Random random(2);
  const int draws = 3000;
  int hits = 0;
  for (int i = 0; i < draws; ++i) hits += surface.vertex_area[uniform_sample_vertices(surface, 1, random)[0]] > median;
  const double deviation = std::sqrt(share * (1 - share) / draws);
  ASSERT_GT(share - 0.5, 8 * deviation) << "the test could not tell";
  EXPECT_NEAR(static_cast<double>(hits) / draws, share, 4 * deviation);
}

TEST_F(Sampled, DistancesBetweenThemAreSymmetric) {
  const Landmarks samples = evenly_spaced_samples(surface, solver, 50, 1);
  const Eigen::MatrixXf d = symmetric_distances(samples);
  ASSERT_EQ(d.rows(), 50);
  ASSERT_EQ(d.cols(), 50);
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 50; ++j) {
      EXPECT_EQ(d(i, j), d(j, i));
      EXPECT_NEAR(d(i, j), 0.5f * (samples.field(i, samples.vertex[j]) + samples.field(j, samples.vertex[i])), 1e-6);
      EXPECT_EQ(d(i, j) == 0, i == j);
    }
}

TEST_F(Sampled, PatchesBelongToTheNearestSample) {
  const Landmarks samples = evenly_spaced_samples(surface, solver, 25, 1);
  const std::vector<int> patch = nearest_source(samples.field);
  ASSERT_EQ(static_cast<int>(patch.size()), surface.vertices());
  for (int i = 0; i < 25; ++i) EXPECT_EQ(patch[samples.vertex[i]], i);
  for (int v = 0; v < surface.vertices(); ++v)
    for (int i = 0; i < 25; ++i) {
      ASSERT_LE(samples.field(patch[v], v), samples.field(i, v));
      if (i < patch[v]) {
        ASSERT_LT(samples.field(patch[v], v), samples.field(i, v));
      }
    }
}

TEST_F(Sampled, RefuseACountOutOfRange) {
  Random random(1);
  for (const int bad : {-1, 0, surface.vertices() + 1}) {
    EXPECT_THROW(evenly_spaced_samples(surface, solver, bad, 1), InvalidOption);
    EXPECT_THROW(uniform_sample_vertices(surface, bad, random), InvalidOption);
  }
}

TEST_F(Sampled, StopWhenAskedTo) {
  const std::atomic<bool> cancel{true};
  Context context;
  context.cancel = &cancel;
  EXPECT_THROW(evenly_spaced_samples(surface, solver, 10, 1, context), Cancelled);
  EXPECT_THROW(farthest_points(surface, solver, {1, 2, 3}, 3, context), Cancelled);
}

TEST(SpacedSamples, VerticesSplitAlongSeamsAreOfOnePatch) {
  const TriangleMesh mesh = lopsided();
  TriangleMesh split;
  std::vector<int> place;
  for (const int v : mesh.triangle) {
    split.triangle.push_back(static_cast<int>(place.size()));
    place.push_back(v);
    for (int k = 0; k < 3; ++k) split.position.push_back(mesh.position[3 * static_cast<std::size_t>(v) + k]);
  }
  const SpacedSamples samples = spaced_samples(split, 12);
  std::vector<int> patch(mesh.vertices(), -1);
  for (std::size_t c = 0; c < place.size(); ++c) {
    ASSERT_GE(samples.patch[c], 0);
    if (patch[place[c]] < 0) patch[place[c]] = samples.patch[c];
    ASSERT_EQ(samples.patch[c], patch[place[c]]);
  }
}

}  // namespace
}  // namespace ga_symmetry
