// SPDX-License-Identifier: GPL-3.0-or-later
// What is searched for a mesh in whatever state, and the way back from it.
#include "surface/search_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <atomic>
#include <cmath>
#include <set>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "shapes.h"
#include "surface/mirror_plane.h"
#include "surface/refine.h"
#include "surface/simplify.h"
#include "surface/welded_mesh.h"
#include "surface/wrap.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

const shapes::Symmetric& large() {
  static const shapes::Symmetric shape = shapes::shuffled(shapes::creature(5), 3);  // 10242 vertices
  return shape;
}

Vector position(const Surface& s, const SurfacePoint& p) {
  Vector out = Vector::Zero();
  for (int k = 0; k < 3; ++k) out += p.weight[k] * Vector(s.point(p.vertex[k]));
  return out;
}

int border_edges(const Surface& s) {
  int out = 0;
  for (const int o : s.opposite) out += o < 0;
  return out;
}

TEST(Simplified, HasTheSizeAskedForAndTheShape) {
  const Surface surface = make_surface(large().mesh), small = simplified(surface, 1500);
  EXPECT_NEAR(small.vertices(), 1500, 2);
  EXPECT_TRUE(small.closed);
  EXPECT_NEAR(small.area, surface.area, 0.02 * surface.area);
  const std::atomic<bool> stop{true};
  Context context;
  context.cancel = &stop;
  EXPECT_THROW(simplified(surface, 1500, context), Cancelled);
}

TEST(SplitLongEdges, KeepsVerticesAreaAndClosedness) {
  const TriangleMesh mesh = shapes::icosphere(1);
  std::vector<double> position = mesh.position;
  std::vector<int> triangle = mesh.triangle;
  split_long_edges(position, triangle, 0.1);
  const Surface before = make_surface(mesh), after = surface_of(position, triangle);
  EXPECT_TRUE(std::equal(mesh.position.begin(), mesh.position.end(), position.begin()));
  EXPECT_TRUE(after.closed);
  double area = 0;  // of the mesh as it came
  for (std::size_t f = 0; f < mesh.triangle.size() / 3; ++f) {
    const auto at = [&](int k) {
      return Vector(&mesh.position[3 * static_cast<std::size_t>(mesh.triangle[3 * f + k])]);
    };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  EXPECT_NEAR(after.area, area, 1e-9 * area);
  for (int c = 0; c < 3 * after.triangles(); ++c)
    ASSERT_LE(after.edge_length(after.triangle[c], after.triangle[next_corner(c)]), 0.1);
}

TEST(Wrap, IsOneClosedSurfaceAroundPartsThatDoNotTouch) {
  TriangleMesh two = shapes::sphere();
  const int first = two.vertices();
  TriangleMesh other = shapes::sphere();
  double reach = 0;
  for (std::size_t i = 0; i < two.position.size(); i += 3) reach = std::max(reach, std::abs(two.position[i]));
  for (std::size_t i = 0; i < other.position.size(); i += 3) other.position[i] += 2.4 * reach;
  two.position.insert(two.position.end(), other.position.begin(), other.position.end());
  for (const int v : other.triangle) two.triangle.push_back(first + v);
  const Surface mesh = make_surface(two);
  const Wrap w = wrap(mesh.position, mesh.triangle, 0.02);
  EXPECT_EQ(w.bridged, 1);
  const Surface s = surface_of(w.mesh.position, w.mesh.triangle);
  EXPECT_TRUE(s.closed);
  EXPECT_TRUE(s.orientable);
  int parts = 0;
  std::vector<char> seen(s.vertices(), 0);
  for (int start = 0; start < s.vertices(); ++start) {
    if (seen[start]) continue;
    ++parts;
    std::vector<int> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int i = s.first_corner[v]; i < s.first_corner[v + 1]; ++i)
        for (const int u : {s.triangle[next_corner(s.corner_at[i])], s.triangle[previous_corner(s.corner_at[i])]})
          if (!seen[u]) seen[u] = 1, stack.push_back(u);
    }
  }
  EXPECT_EQ(parts, 1);
}

TEST(SearchSurface, ACleanMeshOfItsSizeIsSearchedItself) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 3);  // 2562 vertices
  const SearchSurface search(make_surface(shape.mesh), {});
  EXPECT_TRUE(search.direct());
  EXPECT_EQ(search.summary(), "");
}

TEST(SearchSurface, EveryVertexOfALargeMeshStandsNextToItself) {
  Options options;
  options.proxy = 1500;
  const SearchSurface search(make_surface(large().mesh), options);
  ASSERT_FALSE(search.direct());
  EXPECT_NEAR(search.searched().vertices(), 1500, 2);
  for (int v = 0; v < search.of_mesh().vertices(); ++v) {
    const SurfacePoint& p = search.place()[v];
    EXPECT_NEAR(p.weight[0] + p.weight[1] + p.weight[2], 1, 1e-12);
    for (const double w : p.weight) EXPECT_GE(w, 0);
    EXPECT_LT((Vector(search.of_mesh().point(v)) - position(search.searched(), p)).norm(),
              0.02 * search.of_mesh().unit());
  }
}

TEST(SearchSurface, ACubeIsRefined) {
  TriangleMesh cube;
  for (int v = 0; v < 8; ++v)
    cube.position.insert(cube.position.end(), {1.0 * (v & 1), 1.0 * (v >> 1 & 1), 1.0 * (v >> 2)});
  cube.triangle = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  const SearchSurface search(make_surface(cube), {});
  EXPECT_GT(search.searched().vertices(), 1000);
  EXPECT_EQ(border_edges(search.searched()), 0);
  const Result r = find_symmetry(cube);
  const auto corner = [&](int v) { return Vector(&cube.position[3 * static_cast<std::size_t>(v)]); };
  // Any of its reflections: partners are exchanged, and edges stay edges.
  for (int v = 0; v < 8; ++v) {
    ASSERT_GE(r.partners.partner[v], 0);
    EXPECT_EQ(r.partners.partner[r.partners.partner[v]], v);
    for (int w = 0; w < v; ++w)
      EXPECT_NEAR((corner(v) - corner(w)).norm(),
                  (corner(r.partners.partner[v]) - corner(r.partners.partner[w])).norm(), 1e-9);
  }
}

TEST(MirrorPlanes, TheOneOfACreatureThatStandsStraight) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 3);
  const Surface s = make_surface(shapes::moved(shape.mesh, 1));
  std::vector<int> vertices;
  for (int v = 0; v < s.vertices(); v += 8) vertices.push_back(v);
  const std::vector<MirrorPlane> planes = MirrorPlanes(s, vertices).search(4, 1);
  const std::vector<MirrorPlane> by_four = MirrorPlanes(s, vertices).search(4, 4);
  ASSERT_FALSE(planes.empty());
  ASSERT_EQ(by_four.size(), planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_EQ(by_four[i].normal, planes[i].normal);
    EXPECT_EQ(by_four[i].offset, planes[i].offset);
    EXPECT_EQ(by_four[i].misfit, planes[i].misfit);
  }
  EXPECT_LT(planes[0].misfit, 0.01);
  double sum = 0;
  for (int v = 0; v < s.vertices(); ++v)
    sum += (planes[0].mirror(Vector(s.point(v))) - Vector(s.point(shape.partner[v]))).norm();
  EXPECT_LT(sum / s.vertices(), 0.01 * s.unit());
}

double mean_error(const TriangleMesh& mesh, const std::vector<int>& truth, const std::vector<int>& partner) {
  Truth lines;
  for (int v = 0; v < mesh.vertices(); ++v) lines.push_back({v, truth[v]});
  return evaluate_partners(mesh, lines, partner, 1).mean;
}

TEST(Prolongation, FindsTheSymmetryOfALargeMeshOnASmallOne) {
  Options options;
  options.proxy = 2000;
  options.references.axis = {large().axis[0], large().axis[1]};
  options.references.pairs = {large().pair};
  options.threads = 1;
  const Result result = find_symmetry(large().mesh, options);
  EXPECT_EQ(result.matched, large().mesh.vertices());
  EXPECT_LT(mean_error(large().mesh, large().partner, result.partners.partner), 0.03);
  const std::set<int> distinct(result.partners.partner.begin(), result.partners.partner.end());
  EXPECT_GT(static_cast<int>(distinct.size()), large().mesh.vertices() / 2) << "each has its own, not the small one's";
  EXPECT_EQ(result.seconds.at(1).stage, "search surface");
  options.threads = 4;
  EXPECT_EQ(find_symmetry(large().mesh, options).partners.partner, result.partners.partner);
}

// The same creature, whole and as people export it: the answers are as good, and vertices at one place have partners at
// one place.
TEST(Prolongation, DamageDoesNotMatter) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(4), 0.1), 3);
  const double whole = mean_error(shape.mesh, shape.partner, find_symmetry(shape.mesh).partners.partner);
  TriangleMesh soup;
  std::vector<int> origin;
  for (std::size_t c = 0; c < shape.mesh.triangle.size(); ++c) {
    const int v = shape.mesh.triangle[c];
    origin.push_back(v);
    soup.triangle.push_back(static_cast<int>(c));
    for (int k = 0; k < 3; ++k) soup.position.push_back(shape.mesh.position[3 * static_cast<std::size_t>(v) + k]);
  }
  for (std::size_t f = 0; f < soup.triangle.size() / 3; f += 5)
    std::swap(soup.triangle[3 * f], soup.triangle[3 * f + 1]);
  const Result result = find_symmetry(soup);
  EXPECT_EQ(result.matched, soup.vertices());
  std::vector<int> partner(shape.mesh.vertices(), -1);
  for (int v = 0; v < soup.vertices(); ++v) {
    const int back = origin[result.partners.partner[v]];
    if (partner[origin[v]] >= 0) {
      ASSERT_EQ(partner[origin[v]], back);
    }
    partner[origin[v]] = back;
  }
  EXPECT_LT(mean_error(shape.mesh, shape.partner, partner), whole + 0.003);
  EXPECT_NE(result.surface.find("welded"), std::string::npos) << result.surface;
}

// Triangles that stand on edges of the body, and scraps around it: neither is a hole of what they stand on.
TEST(SearchSurface, FinsAreLeftAside) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(4), 0.1), 3);
  TriangleMesh mesh = shape.mesh;
  const Surface body = make_surface(shape.mesh);
  for (int f = 0; f < shape.mesh.triangles(); f += 80) {
    const int* v = &shape.mesh.triangle[3 * static_cast<std::size_t>(f)];
    const Vector a(body.point(v[0])), b(body.point(v[1])), c(body.point(v[2]));
    const Vector tip = (a + b) / 2 + 3 * (b - a).norm() * (b - a).cross(c - a).normalized();
    mesh.triangle.insert(mesh.triangle.end(), {v[0], v[1], mesh.vertices()});
    mesh.position.insert(mesh.position.end(), tip.data(), tip.data() + 3);
  }
  const SearchSurface search(make_surface(mesh), {});
  EXPECT_TRUE(search.searched().closed);
  EXPECT_NE(search.summary().find("scraps aside"), std::string::npos) << search.summary();
  const Result result = find_symmetry(mesh);
  EXPECT_EQ(result.matched, mesh.vertices());
  const double whole = mean_error(shape.mesh, shape.partner, find_symmetry(shape.mesh).partners.partner);
  std::vector<int> partner(result.partners.partner.begin(), result.partners.partner.begin() + shape.mesh.vertices());
  for (int& p : partner) p = std::min(p, shape.mesh.vertices() - 1);  // a few may be tips
  EXPECT_LT(mean_error(shape.mesh, shape.partner, partner), whole + 0.01);
}

TEST(SearchSurface, AnEdgeAsShortAsRoundingIsMadeAPoint) {
  TriangleMesh mesh = shapes::creature(4).mesh;
  const Surface whole = make_surface(mesh);
  const int c = 0, o = whole.opposite[c], a = mesh.triangle[1], b = mesh.triangle[2], d = mesh.vertices();
  ASSERT_GE(o, 0);
  for (int k = 0; k < 3; ++k) {
    const double p = mesh.position[3 * static_cast<std::size_t>(a) + k];
    mesh.position.push_back(p + 1e-7 * (mesh.position[3 * static_cast<std::size_t>(b) + k] - p));
  }
  for (const int corner : {c, o}) {  // the corner at b becomes d; what is cut off is added
    const int f = corner - corner % 3, tip = mesh.triangle[corner];
    const bool forward = mesh.triangle[next_corner(corner)] == a;
    for (int k = 0; k < 3; ++k)
      if (mesh.triangle[f + k] == b) mesh.triangle[f + k] = d;
    mesh.triangle.insert(mesh.triangle.end(), {tip, forward ? d : b, forward ? b : d});
  }
  ASSERT_TRUE(make_surface(mesh).closed);
  const SearchSurface search(make_surface(mesh), Options());
  EXPECT_EQ(search.summary().find("wrapped"), std::string::npos) << search.summary();
  EXPECT_EQ(search.searched().vertices(), whole.vertices());
  EXPECT_NEAR(search.searched().area, whole.area, 1e-9);
}

// Two bodies that only a thin strip of its own holds together, along edges of three faces: without it there would be
// two parts, between which there is no distance.
TEST(SearchSurface, AScrapThatHoldsTheWholeTogetherStays) {
  TriangleMesh mesh = shapes::icosphere(3);
  const int n = mesh.vertices(), faces = mesh.triangles();
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < 3; ++k) mesh.position.push_back(mesh.position[3 * v + k] + (k == 0 ? 3 : 0));
  for (int c = 0; c < 3 * faces; ++c) mesh.triangle.push_back(mesh.triangle[c] + n);
  mesh.triangle.insert(mesh.triangle.end(), {mesh.triangle[0], mesh.triangle[1], mesh.triangle[0] + n});
  const SearchSurface search(make_surface(mesh), {});
  EXPECT_EQ(search.parts(), 1);
  EXPECT_EQ(search.summary().find("aside"), std::string::npos) << search.summary();
  int parts = 0;
  face_parts(search.searched().triangle, search.searched().vertices(), parts);
  EXPECT_EQ(parts, 1);
}

TEST(SearchSurface, SizesOutOfRangeAreRefused) {
  Options options;
  options.proxy = 10;
  EXPECT_THROW(find_symmetry(large().mesh, options), InvalidOption);
}

}  // namespace
}  // namespace ga_symmetry
