// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/shortcuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "ga_symmetry/errors.h"
#include "search/joint.h"
#include "search/local_search.h"
#include "search/sites.h"
#include "shapes.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

// A unit sphere without what lies above `height`, renumbered.
TriangleMesh bowl(double height) {
  TriangleMesh mesh = shapes::icosphere(4), out;
  std::vector<int> index(mesh.vertices(), -1);
  for (int v = 0; v < mesh.vertices(); ++v) {
    if (mesh.position[3 * v + 2] > height) continue;
    index[v] = out.vertices();
    out.position.insert(out.position.end(), &mesh.position[3 * v], &mesh.position[3 * v] + 3);
  }
  for (std::size_t f = 0; f < mesh.triangle.size(); f += 3) {
    const int a = index[mesh.triangle[f]], b = index[mesh.triangle[f + 1]], c = index[mesh.triangle[f + 2]];
    if (a >= 0 && b >= 0 && c >= 0) out.triangle.insert(out.triangle.end(), {a, b, c});
  }
  return shapes::shuffled(out, 11);
}

double on_whole_sphere(const TriangleMesh& mesh, int a, int b) {
  const double *p = &mesh.position[3 * a], *q = &mesh.position[3 * b];
  return std::acos(std::clamp(p[0] * q[0] + p[1] * q[1] + p[2] * q[2], -1.0, 1.0));
}

TEST(Shortcuts, NoneWhereNothingIsMissing) {
  const Surface s = make_surface(shapes::icosphere(3));
  EXPECT_TRUE(Shortcuts(s, GeodesicSolver(s), 1).none());
  const Shortcuts none;
  EXPECT_TRUE(none.none());
  const std::vector<float> field(s.vertices(), 1.f);
  EXPECT_EQ(none.slack(field.data())(0), 0);
}

TEST(Shortcuts, NoneThroughAPinprick) {
  TriangleMesh mesh = shapes::icosphere(4);
  mesh.triangle.resize(mesh.triangle.size() - 3);
  const Surface s = make_surface(mesh);
  ASSERT_FALSE(s.closed);
  EXPECT_TRUE(Shortcuts(s, GeodesicSolver(s), 1).none());
}

TEST(Shortcuts, TheTrueDistanceIsWithinTheSlack) {
  const double height = 0.5;
  const TriangleMesh mesh = bowl(height);
  const Surface s = make_surface(mesh);
  const GeodesicSolver solver(s);
  const Shortcuts shortcuts(s, solver, 1);
  ASSERT_FALSE(shortcuts.none());
  EXPECT_LE(shortcuts.points(), 101);
  std::vector<float> field(s.vertices());
  const auto workspace = solver.make_workspace();
  // Surfaces are scaled.
  const int last = s.vertices() - 1;
  const double angle = on_whole_sphere(mesh, s.mesh_vertex[0], s.mesh_vertex[last]);
  const double radius = s.edge_length(0, last) / (2 * std::sin(angle / 2));
  int sure = 0, unsure = 0;
  for (int a = 0; a < s.vertices(); a += 61) {
    solver.field(a, field.data(), *workspace);
    const auto slack_at = shortcuts.slack(field.data());
    for (int v = 0; v < s.vertices(); ++v) {
      const double length = field[v] / radius, slack = slack_at(v) / radius,
                   truth = on_whole_sphere(mesh, s.mesh_vertex[a], s.mesh_vertex[v]);
      ASSERT_GE(slack, 0);
      EXPECT_LE(truth, length + 0.02);
      EXPECT_GE(truth, length - 2 * slack - 0.16) << a << " " << v;  // the points are so far apart
      // Both are nearer to each other than to the rim: nothing is in doubt.
      const auto to_rim = [&](int w) { return std::acos(mesh.position[3 * s.mesh_vertex[w] + 2]) - std::acos(height); };
      if (length < to_rim(a) + to_rim(v) - 0.1) {
        EXPECT_EQ(slack, 0);
      }
      ++(slack > 0 ? unsure : sure);
      // Around the hole, where the sphere would have been shorter, there is doubt.
      if (length > truth + 0.3) {
        EXPECT_GT(slack, 0.07);
      }
    }
  }
  EXPECT_GT(sure, 1000);
  EXPECT_GT(unsure, 1000);
}

TEST(Shortcuts, NotFromOneHoleToAnother) {
  // Open at both ends: straight from one end to the other would be no way over what is missing.
  TriangleMesh mesh = shapes::globe(35, 48, [](double&, double&, double& z) { z *= 2; });
  TriangleMesh open;
  open.position = mesh.position;
  for (std::size_t f = 0; f < mesh.triangle.size(); f += 3) {
    bool kept = true;
    for (int k = 0; k < 3; ++k) kept &= std::abs(mesh.position[3 * mesh.triangle[f + k] + 2]) < 1.8;
    if (kept) open.triangle.insert(open.triangle.end(), &mesh.triangle[f], &mesh.triangle[f] + 3);
  }
  const Surface s = make_surface(open);
  const GeodesicSolver solver(s);
  const Shortcuts shortcuts(s, solver, 1);
  ASSERT_FALSE(shortcuts.none());
  int top = 0, bottom = 0;
  for (int v = 0; v < s.vertices(); ++v) {
    if (s.point(v)[2] > s.point(top)[2]) top = v;
    if (s.point(v)[2] < s.point(bottom)[2]) bottom = v;
  }
  const DistanceFields field = solver.fields({top}, 1);
  // Across each of the two ends at most.
  EXPECT_GT(field(0, bottom) - 2 * shortcuts.slack(field.row(0).data())(bottom),
            0.9 * (s.point(top)[2] - s.point(bottom)[2]));
}

TEST(Shortcuts, Cancel) {
  const Surface s = make_surface(bowl(0.5));
  const std::atomic<bool> cancel{true};
  EXPECT_THROW(Shortcuts(s, GeodesicSolver(s), 2, {nullptr, &cancel}), Cancelled);
}

TEST(Shortcuts, SitesKnowTheirSlack) {
  const Surface s = make_surface(bowl(0.5));
  const GeodesicSolver solver(s);
  const Sites plain = make_sites(s, solver, {20, 60, 6}, 1),
              loose = make_sites(s, solver, {20, 60, 6}, 1, Shortcuts(s, solver, 1));
  EXPECT_EQ(plain.slack.size(), 0);
  ASSERT_EQ(loose.slack.rows(), 60);
  EXPECT_EQ(loose.slack, loose.slack.transpose());
  EXPECT_GE(loose.slack.minCoeff(), 0);
  EXPECT_GT(loose.slack.maxCoeff(), 0.05);
  EXPECT_TRUE(plain.distance.isApprox(loose.distance + loose.slack, 1e-5f));
  EXPECT_EQ(coarsened(loose, 10, 20).slack, loose.slack.topLeftCorner(20, 20));
}

TEST(Shortcuts, DistancesCostOnlyWhatIsBeyondTheirSlack) {
  const Surface s = make_surface(bowl(0.5));
  const GeodesicSolver solver(s);
  Sites sites = make_sites(s, solver, {20, 60, 6}, 1, Shortcuts(s, solver, 1));
  JointOptions only;
  only.orientation_weight = only.continuity_weight = only.descriptor_weight = only.bijectivity_weight = 0;
  Random random(3);
  SampleMap map(20);
  for (int& site : map) site = static_cast<int>(draw_below(random, 60));
  const auto cost = [&](const SampleMap& m) {
    return JointProblem(sites, s, SymmetryKind::reflection, {}, only).cost().cost(m);
  };
  const double known = cost(map);
  // Coordinate descent lowers that same cost, gene by gene.
  const JointProblem problem(sites, s, SymmetryKind::reflection, {}, only);
  SampleMap better = map;
  coordinate_descent(problem.cost(), better, kEverywhere);
  EXPECT_LT(cost(better), known);
  SampleMap again = better;
  for (int round = 0; round < 20 && coordinate_descent(problem.cost(), again, kEverywhere); ++round)
    EXPECT_LE(cost(again), cost(better) + 1e-6);
  sites.slack *= 2;
  EXPECT_LT(cost(map), known);
  sites.slack.setConstant(10);
  EXPECT_EQ(cost(map), 0);
}

}  // namespace
}  // namespace ga_symmetry
