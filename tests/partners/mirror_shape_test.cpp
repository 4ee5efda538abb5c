// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpted shape that is carried across a symmetry: laws on a bent creature, and on posed samples how far it is from
// what a sculptor with exact partners would have got.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mirror.h"
#include "ga_symmetry/symmetry.h"
#include "partners/known_creature.h"
#include "surface/locate.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t v) {
  return std::hypot(a[3 * v] - b[3 * v], a[3 * v + 1] - b[3 * v + 1], a[3 * v + 2] - b[3 * v + 2]);
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0;
  for (std::size_t v = 0; v < a.size() / 3; ++v) out = std::max(out, distance(a, b, v));
  return out;
}

double mean_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size() / 3; ++v) sum += distance(a, b, v);
  return sum / (static_cast<double>(a.size()) / 3);
}

double root_of_area(const TriangleMesh& m) {
  double area = 0;
  for (std::size_t f = 0; f < m.triangle.size(); f += 3) {
    double u[3], w[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = m.position[3 * m.triangle[f + 1] + k] - m.position[3 * m.triangle[f] + k];
      w[k] = m.position[3 * m.triangle[f + 2] + k] - m.position[3 * m.triangle[f] + k];
    }
    area += 0.5 * std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]);
  }
  return std::sqrt(area);
}

// Swells with soft edges around a few vertices of one side: how far each vertex is to move along its normal.
std::vector<double> swells(const TriangleMesh& m, const std::vector<int>& side, int wanted) {
  const double radius = 0.25 * root_of_area(m), height = 0.2 * radius;
  std::vector<double> out(side.size(), 0.0);
  const std::size_t step = side.size() / 23;
  for (std::size_t c = 0; c < side.size(); c += step) {
    if (side[c] != wanted) continue;
    for (std::size_t v = 0; v < side.size(); ++v) {
      if (side[v] != wanted) continue;
      const double t = std::hypot(m.position[3 * v] - m.position[3 * c], m.position[3 * v + 1] - m.position[3 * c + 1],
                                  m.position[3 * v + 2] - m.position[3 * c + 2]) /
                       radius;
      if (t < 1) out[v] = std::max(out[v], height * (1 - t * t) * (1 - t * t));
    }
  }
  return out;
}

TriangleMesh raised(TriangleMesh m, const std::vector<double>& height) {
  const auto normals = vertex_normals(m.position, m.triangle);
  for (std::size_t v = 0; v < height.size(); ++v) {
    const auto& n = normals[v];
    for (int k = 0; k < 3; ++k) m.position[3 * v + k] += height[v] * n[k] / std::hypot(n[0], n[1], n[2]);
  }
  return m;
}

// Per vertex what its true partner has.
std::vector<double> carried(const std::vector<double>& values, const std::vector<int>& partner) {
  std::vector<double> out(values.size(), 0.0);
  for (std::size_t v = 0; v < values.size(); ++v)
    if (partner[v] >= 0) out[v] = values[static_cast<std::size_t>(partner[v])];
  return out;
}

struct Sculpted {
  std::vector<double> height = swells(creature().mesh, creature().partners.side, 1);
  TriangleMesh after = raised(creature().mesh, height);
  std::vector<double> mirrored =
      transferred_shape(creature().mesh, after, creature().partners, Transfer::left_to_right);
  double most = *std::max_element(height.begin(), height.end());
};

const Sculpted& sculpted() {
  static const Sculpted shared;
  return shared;
}

TEST(MirrorShape, WhatIsRaisedOnOneSideIsRaisedOnTheOther) {
  std::vector<double> both = carried(sculpted().height, creature().partners.partner);
  for (std::size_t v = 0; v < both.size(); ++v) both[v] += sculpted().height[v];
  const TriangleMesh wanted = raised(creature().mesh, both);
  double off = 0, size = 0;
  for (std::size_t v = 0; v < both.size(); ++v) {
    if (creature().partners.side[v] >= 0) {
      EXPECT_EQ(distance(sculpted().mirrored, sculpted().after.position, v), 0) << "the sculpted side stays";
      continue;
    }
    off += distance(sculpted().mirrored, wanted.position, v), size += both[v];
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(off / size, 0.05);
}

TEST(MirrorShape, NothingSculptedNothingMoved) {
  for (const Transfer transfer : {Transfer::left_to_right, Transfer::swap, Transfer::average})
    EXPECT_EQ(transferred_shape(creature().mesh, creature().mesh, creature().partners, transfer),
              creature().mesh.position);
}

TEST(MirrorShape, SwappedTwiceIsAsBefore) {
  TriangleMesh once = sculpted().after;
  once.position = transferred_shape(creature().mesh, sculpted().after, creature().partners, Transfer::swap);
  EXPECT_GT(farthest(once.position, sculpted().after.position), 0.9 * sculpted().most);
  const auto twice = transferred_shape(creature().mesh, once, creature().partners, Transfer::swap);
  // The bent creature's two sides are not quite alike.
  EXPECT_LT(mean_distance(twice, sculpted().after.position),
            0.02 * mean_distance(sculpted().after.position, creature().mesh.position));
}

TEST(MirrorShape, TheMeanIsHalfOfASideAndNotChangedByAnotherMean) {
  TriangleMesh even = sculpted().after;
  even.position = transferred_shape(creature().mesh, sculpted().after, creature().partners, Transfer::average);
  std::vector<double> half = carried(sculpted().height, creature().partners.partner);
  for (std::size_t v = 0; v < half.size(); ++v) half[v] = 0.5 * (half[v] + sculpted().height[v]);
  EXPECT_LT(farthest(even.position, raised(creature().mesh, half).position), 0.05 * sculpted().most);
  const auto again = transferred_shape(creature().mesh, even, creature().partners, Transfer::average);
  EXPECT_LT(farthest(again, even.position), 0.05 * sculpted().most);
}

TEST(MirrorShape, MovedTurnedAndScaledTheSame) {
  const auto there = transferred_shape(shapes::moved(creature().mesh, 1e-3), shapes::moved(sculpted().after, 1e-3),
                                       creature().partners, Transfer::left_to_right);
  TriangleMesh expected = creature().mesh;
  expected.position = sculpted().mirrored;
  EXPECT_LT(farthest(there, shapes::moved(expected, 1e-3).position), 1e-3 * 1e-6);
}

TEST(MirrorShape, TheSameWithAnyNumberOfThreads) {
  for (const int threads : {1, 4})
    EXPECT_EQ(
        transferred_shape(creature().mesh, sculpted().after, creature().partners, Transfer::left_to_right, threads),
        sculpted().mirrored);
}

TEST(MirrorShape, WithoutAPartnerNothingIsReceived) {
  Partners some = creature().partners;
  std::size_t v = 0;
  while (some.side[v] != -1 || carried(sculpted().height, some.partner)[v] == 0) ++v;
  some.partner[v] = -1;
  const auto out = transferred_shape(creature().mesh, sculpted().after, some, Transfer::left_to_right);
  EXPECT_EQ(distance(out, sculpted().after.position, v), 0);
}

TEST(MirrorShape, RefusesOtherMeshesAndWhatIsNotANumber) {
  const auto refused = [](const TriangleMesh& after) {
    try {
      transferred_shape(creature().mesh, after, creature().partners, Transfer::average);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TriangleMesh after = creature().mesh;
  after.position.resize(after.position.size() - 3);
  EXPECT_NE(refused(after).find("both must have the same"), std::string::npos) << refused(after);
  after = creature().mesh;
  after.position[7] = NAN;
  EXPECT_NE(refused(after).find("vertex 2"), std::string::npos) << refused(after);
  const std::atomic<bool> asked = true;
  Context stop;
  stop.cancel = &asked;
  EXPECT_THROW(transferred_shape(creature().mesh, creature().mesh, creature().partners, Transfer::swap, 1, stop),
               Cancelled);
}

// Over the size of what is to be carried: how far the mirrored shape is from where the truth carries it, mean over the
// vertices of the other side.
double deviation_on(const std::string& sample, bool references) {
  const std::string path = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/" + sample;
  const TriangleMesh mesh = read_mesh(path + ".off");
  std::vector<int> truth(mesh.vertices(), -1);
  for (const auto& [v, w] : read_truth(path + ".truth")) truth[v] = w;
  Options o;
  if (references) o.references = read_references(path + ".refs");
  const Partners found = find_symmetry(mesh, o).partners;
  const std::vector<double> height = swells(mesh, found.side, 1), wanted = carried(height, truth);
  const auto mirrored = transferred_shape(mesh, raised(mesh, height), found, Transfer::left_to_right);
  const TriangleMesh exact = raised(mesh, wanted);
  double off = 0, size = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (found.side[v] >= 0 || truth[v] < 0) continue;
    off += distance(mirrored, exact.position, v), size += wanted[v];
  }
  return off / size;
}

class SculptedSamples : public testing::TestWithParam<bool> {};

TEST_P(SculptedSamples, AreMirroredWithATenthOfError) {
  const char* const samples[] = {"animal_walk", "animal_graze", "person_wave", "person_run"};
  double mean = 0;
  for (const char* sample : samples) {
    const double deviation = deviation_on(sample, GetParam());
    std::printf("%s: mean deviation %.3f of what is carried\n", sample, deviation);
    EXPECT_LT(deviation, 0.15) << sample;
    mean += deviation / static_cast<double>(std::size(samples));
  }
  EXPECT_LT(mean, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Posed, SculptedSamples, testing::Bool(),
                         [](const auto& info) { return std::string(info.param ? "with" : "without") + "_references"; });

}  // namespace
}  // namespace ga_symmetry
