#include "geodesics/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "ga_symmetry/errors.h"
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

bool same(const Samples& a, const Samples& b) {
  return a.vertex == b.vertex && a.distance.size() == b.distance.size() &&
         std::memcmp(a.distance.data(), b.distance.data(), sizeof(float) * a.distance.size()) == 0;
}

class Sampled : public ::testing::Test {
 protected:
  const Surface surface = make_surface(lopsided());
  const GeodesicSolver solver{surface};
};

TEST_F(Sampled, KeepTheFieldsOfTheirVertices) {
  const Samples samples = evenly_spaced_samples(surface, solver, 12, 1);
  const DistanceFields fields = solver.fields(samples.vertex, 1);
  EXPECT_EQ(0, std::memcmp(fields.data(), samples.distance.data(), sizeof(float) * fields.size()));
}

TEST_F(Sampled, EvenlySpacedAreNested) {
  const Samples many = evenly_spaced_samples(surface, solver, 60, 1),
                few = evenly_spaced_samples(surface, solver, 17, 1);
  EXPECT_TRUE(std::equal(few.vertex.begin(), few.vertex.end(), many.vertex.begin()));
}

TEST_F(Sampled, EvenlySpacedCoverAsFarAsTheyAreApart) {
  const Samples samples = evenly_spaced_samples(surface, solver, 60, 1);
  float previous = std::numeric_limits<float>::infinity();
  for (int k = 2; k <= 60; ++k) {
    const float cover = samples.distance.topRows(k).colwise().minCoeff().maxCoeff();
    EXPECT_LE(cover, previous) << "a further sample never covers less";
    previous = cover;
    float apart = std::numeric_limits<float>::infinity();
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < i; ++j) apart = std::min(apart, samples.distance(j, samples.vertex[i]));
    EXPECT_GE(apart, cover);
  }
}

TEST_F(Sampled, EvenlySpacedAreTheSameOnAnyNumberOfThreads) {
  const Samples one = evenly_spaced_samples(surface, solver, 80, 1);
  for (const int threads : {0, 2, 3, 4, 9}) EXPECT_TRUE(same(one, evenly_spaced_samples(surface, solver, 80, threads)));
}

TEST_F(Sampled, EvenlySpacedAreTheSameUnderAnotherNumbering) {
  std::vector<int> to;
  const Surface other = make_surface(shapes::shuffled(lopsided(), 23, &to));
  const Samples a = evenly_spaced_samples(surface, solver, 40, 1);
  const Samples b = evenly_spaced_samples(other, GeodesicSolver(other), 40, 1);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(to[a.vertex[i]], b.vertex[i]) << i;
}

TEST_F(Sampled, EvenlySpacedCanBeAllVertices) {
  const Surface small = make_surface(shapes::sphere(5, 8));
  Samples all = evenly_spaced_samples(small, GeodesicSolver(small), small.vertices(), 4);
  EXPECT_EQ(static_cast<int>(std::set<int>(all.vertex.begin(), all.vertex.end()).size()), small.vertices());
}

TEST_F(Sampled, UniformAreAllDifferent) {
  Random random(1);
  const std::vector<int> all = uniform_sample_vertices(surface, surface.vertices(), random);
  EXPECT_EQ(static_cast<int>(std::set<int>(all.begin(), all.end()).size()), surface.vertices());
}

TEST_F(Sampled, UniformFollowTheSeed) {
  Random a(4), b(4), c(5);
  const Samples first = uniform_samples(surface, solver, 30, a, 1);
  EXPECT_TRUE(same(first, uniform_samples(surface, solver, 30, b, 4)));
  EXPECT_NE(first.vertex, uniform_samples(surface, solver, 30, c, 1).vertex);
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
  const Samples samples = evenly_spaced_samples(surface, solver, 50, 1);
  const Eigen::MatrixXf d = symmetric_distances(samples);
  ASSERT_EQ(d.rows(), 50);
  ASSERT_EQ(d.cols(), 50);
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 50; ++j) {
      EXPECT_EQ(d(i, j), d(j, i));
      EXPECT_NEAR(d(i, j), 0.5f * (samples.distance(i, samples.vertex[j]) + samples.distance(j, samples.vertex[i])),
                  1e-6);
      EXPECT_EQ(d(i, j) == 0, i == j);
    }
}

TEST_F(Sampled, PatchesBelongToTheNearestSample) {
  const Samples samples = evenly_spaced_samples(surface, solver, 25, 1);
  const std::vector<int> patch = sample_patches(samples);
  ASSERT_EQ(static_cast<int>(patch.size()), surface.vertices());
  for (int i = 0; i < 25; ++i) EXPECT_EQ(patch[samples.vertex[i]], i);
  for (int v = 0; v < surface.vertices(); ++v)
    for (int i = 0; i < 25; ++i) {
      ASSERT_LE(samples.distance(patch[v], v), samples.distance(i, v));
      if (i < patch[v]) {
        ASSERT_LT(samples.distance(patch[v], v), samples.distance(i, v));
      }
    }
}

TEST_F(Sampled, RefuseACountOutOfRange) {
  Random random(1);
  for (const int bad : {-1, 0, surface.vertices() + 1}) {
    EXPECT_THROW(evenly_spaced_samples(surface, solver, bad, 1), InvalidOption);
    EXPECT_THROW(uniform_sample_vertices(surface, bad, random), InvalidOption);
    EXPECT_THROW(uniform_samples(surface, solver, bad, random, 1), InvalidOption);
  }
}

TEST_F(Sampled, StopWhenAskedTo) {
  const std::atomic<bool> cancel{true};
  Context context;
  context.cancel = &cancel;
  Random random(1);
  EXPECT_THROW(evenly_spaced_samples(surface, solver, 10, 1, context), Cancelled);
  EXPECT_THROW(uniform_samples(surface, solver, 10, random, 2, context), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
