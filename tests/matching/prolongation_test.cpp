// SPDX-License-Identifier: GPL-3.0-or-later
// Where a shape stands symmetric, its mirror plane and the map complete each other.
#include "matching/prolongation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "shapes.h"
#include "surface/surface.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

// A sphere, mirrored in y; a share of its far end is mapped onto itself.
struct Scene {
  explicit Scene(const TriangleMesh& mesh) : s(make_surface(mesh)), truth(s.vertices()) {
    std::vector<Vector> from, to;
    for (int v = 0; v < s.vertices(); ++v) {
      const double* p = &mesh.position[3 * s.mesh_vertex[v]];
      truth[v] = s.surface_vertex[shapes::nearest_vertex(mesh, p[0], -p[1], p[2])];
      from.emplace_back(s.point(v)), to.emplace_back(s.point(truth[v]));
    }
    found.mirror = MirrorPlanes::between(from, to);
    found.partner = truth;
    for (int v = 0; v < s.vertices(); ++v)
      if (mesh.position[3 * s.mesh_vertex[v]] < -0.8) found.partner[v] = v, wrong.push_back(v);
    for (const int w : found.partner) found.point.push_back({{w, w, w}, {1, 0, 0}});
    found.pairs = {{wrong[0], found.partner[wrong[0]], 0}};
  }
  Surface s;
  std::vector<int> truth, wrong;
  SurfaceResult found;
};

TEST(MirrorExactly, CorrectsTheMapOfAShapeThatStandsSymmetric) {
  Scene scene(shapes::sphere(41, 48));
  ASSERT_GT(scene.wrong.size(), 20u);
  mirror_exactly(scene.found, scene.s, 1);
  EXPECT_EQ(scene.found.partner, scene.truth);
  EXPECT_EQ(scene.found.pairs[0].partner, scene.truth[scene.wrong[0]]);
  for (const SurfacePoint& p : scene.found.point) ASSERT_NEAR(p.weight[0] + p.weight[1] + p.weight[2], 1, 1e-9);
}

TEST(MirrorExactly, LeavesTheMapWhereTheShapeIsBentAndTheyDisagree) {
  TriangleMesh mesh = shapes::sphere(41, 48);
  const Scene scene(mesh);
  // One side is drawn out: more of the area has no mirror image than is overlooked.
  for (int v = 0; v < mesh.vertices(); ++v) {
    double* p = &mesh.position[3 * v];
    if (p[0] > 0.3 && p[1] > 0.1) p[1] += 1.5 * (p[0] - 0.3);
  }
  Scene bent(mesh);
  // The plane of the rest.
  std::vector<Vector> from, to;
  for (int v = 0; v < bent.s.vertices(); ++v)
    if (mesh.position[3 * bent.s.mesh_vertex[v]] < 0) {
      from.emplace_back(bent.s.point(v)), to.emplace_back(bent.s.point(scene.truth[v]));
    }
  bent.found.mirror = MirrorPlanes::between(from, to);
  bent.found.partner = scene.found.partner;
  bent.found.point = scene.found.point;
  mirror_exactly(bent.found, bent.s, 1);
  int kept = 0, off_axis = 0;
  for (const int v : scene.wrong) {
    const double y = std::abs(mesh.position[3 * bent.s.mesh_vertex[v] + 1]);
    if (y < 0.4) continue;  // nearer to the axis both mean the same
    ++off_axis;
    kept += bent.found.partner[v] == v;
  }
  EXPECT_GT(off_axis, 10);
  EXPECT_EQ(kept, off_axis);
}

}  // namespace
}  // namespace ga_symmetry
