// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/geodesics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "ga_symmetry/errors.h"
#include "shapes.h"
#include "spheres.h"
#include "vcg_geodesic.h"

namespace ga_symmetry {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<float> field_of(const GeodesicSolver& solver, int n, int source) {
  std::vector<float> out(n);
  solver.field(source, out.data(), *solver.make_workspace());
  return out;
}

std::vector<int> spread_sources(int n, int count) {
  std::vector<int> out;
  for (int i = 0; i < count; ++i) out.push_back(static_cast<int>(static_cast<long>(n) * (2 * i + 1) / (2 * count)));
  return out;
}

// A flat square of side 1, then stretched in x; inner vertices moved at random within their cells.
TriangleMesh flat_patch(int side, double stretch, double jitter) {
  TriangleMesh mesh;
  Random random(7);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const bool inner = i > 0 && j > 0 && i + 1 < side && j + 1 < side;
      const auto moved = [&](int k) { return (k + (inner ? jitter * (2 * draw_unit(random) - 1) : 0)) / (side - 1); };
      const double x = moved(i), y = moved(j);
      mesh.position.insert(mesh.position.end(), {stretch * x, y, 0});
    }
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const int a = j * side + i, b = a + 1, c = b + side, d = a + side;
      if (draw_below(random, 2))
        mesh.triangle.insert(mesh.triangle.end(), {a, b, c, a, c, d});
      else
        mesh.triangle.insert(mesh.triangle.end(), {a, b, d, b, c, d});
    }
  return mesh;
}

double longest_edge(const Surface& s) {
  double longest = 0;
  for (int c = 0; c < 3 * s.triangles(); ++c)
    longest = std::max(longest, s.edge_length(s.triangle[next_corner(c)], s.triangle[previous_corner(c)]));
  return longest;
}

double largest_flat_error(const TriangleMesh& mesh) {
  const Surface s = make_surface(mesh);
  const GeodesicSolver solver(s);
  double largest = 0;
  for (const int source : spread_sources(s.vertices(), 8)) {
    const std::vector<float> d = field_of(solver, s.vertices(), source);
    for (int v = 0; v < s.vertices(); ++v) largest = std::max(largest, std::abs(d[v] - s.edge_length(source, v)));
  }
  return largest;
}

TEST(Geodesics, AreExactOnAFlatPatch) {
  // The door scales the patch to 1, so this is the allowance relative to its size: rounding, and the gain of an edge
  // that is not worth a second visit.
  constexpr double kExact = 1e-5;
  EXPECT_LT(largest_flat_error(flat_patch(40, 1, 0)), kExact);
  EXPECT_LT(largest_flat_error(flat_patch(40, 1, 0.24)), kExact);
  EXPECT_LT(largest_flat_error(flat_patch(80, 1, 0.24)), kExact);
  EXPECT_LT(largest_flat_error(flat_patch(40, 3, 0.24)), kExact);
  EXPECT_LT(largest_flat_error(flat_patch(40, 8, 0.24)), kExact);
}

struct SphereError {
  double ours = 0, vcglib = 0, asymmetry = 0;  // mean, mean, largest; radius 1
};

SphereError sphere_error(const TriangleMesh& mesh) {
  const Surface s = make_surface(mesh);
  const GeodesicSolver solver(s);
  baseline::VcgGeodesic vcg(s);
  const double scale = spheres::scale_of(mesh, s);
  const std::vector<int> sources = spread_sources(s.vertices(), 6);
  const DistanceFields ours = solver.fields(sources, 1);
  std::vector<float> theirs(s.vertices());
  SphereError error;
  for (int i = 0; i < static_cast<int>(sources.size()); ++i) {
    vcg.field(sources[i], theirs.data());
    for (int v = 0; v < s.vertices(); ++v) {
      const double truth =
          spheres::great_circle(&mesh.position[3 * s.mesh_vertex[sources[i]]], &mesh.position[3 * s.mesh_vertex[v]]);
      error.ours += std::abs(ours(i, v) / scale - truth);
      error.vcglib += std::abs(theirs[v] / scale - truth);
    }
    for (int j = 0; j < i; ++j)
      error.asymmetry = std::max(error.asymmetry, std::abs(ours(i, sources[j]) - ours(j, sources[i])) / scale);
  }
  const double count = static_cast<double>(sources.size()) * s.vertices();
  error.ours /= count, error.vcglib /= count;
  return error;
}

// A front that takes its radius for its distance is wrong in the first order; ours must beat that by far.
TEST(Geodesics, BeatVcglibOnSpheres) {
  for (const TriangleMesh& mesh : {spheres::icosphere(16), spheres::icosphere(35), spheres::icosphere(35, 0.008),
                                   spheres::uv_sphere(60, 60), spheres::uv_sphere(25, 120)}) {
    const SphereError error = sphere_error(mesh);
    EXPECT_LT(error.ours, 0.2 * error.vcglib) << mesh.vertices() << " vertices";
    EXPECT_LT(error.asymmetry, 2e-3) << mesh.vertices() << " vertices";
  }
}

TEST(Geodesics, ErrorFallsWithTheSquareOfTheEdge) {
  const double coarse = sphere_error(spheres::icosphere(12)).ours, fine = sphere_error(spheres::icosphere(36)).ours;
  EXPECT_LT(fine, coarse / 6);  // a third of the edge: 9 in the limit, 3 in the first order
}

// A bumpy body without any symmetry.
TriangleMesh lopsided() {
  TriangleMesh mesh = shapes::body();
  Random random(3);
  for (std::size_t i = 0; i < mesh.position.size(); i += 3) {
    mesh.position[i] *= 1 + 0.1 * std::tanh(mesh.position[i]);
    for (int k = 0; k < 3; ++k) mesh.position[i + k] += 0.004 * (2 * draw_unit(random) - 1);
  }
  return mesh;
}

TEST(Geodesics, ScaleChangesNothing) {
  const Surface s = make_surface(lopsided()), t = make_surface(shapes::scaled(lopsided(), 1e-12));
  const std::vector<float> a = field_of(GeodesicSolver(s), s.vertices(), 5);
  const std::vector<float> b = field_of(GeodesicSolver(t), t.vertices(), 5);
  for (int v = 0; v < s.vertices(); ++v) ASSERT_NEAR(a[v], b[v], 1e-6);
}

TEST(Geodesics, RenumberingPermutesTheField) {
  std::vector<int> to;
  const Surface s = make_surface(lopsided()), t = make_surface(shapes::shuffled(lopsided(), 11, &to));
  const GeodesicSolver a(s), b(t);
  for (const int source : spread_sources(s.vertices(), 5)) {
    const std::vector<float> d = field_of(a, s.vertices(), source), e = field_of(b, t.vertices(), to[source]);
    for (int v = 0; v < s.vertices(); ++v) ASSERT_NEAR(d[v], e[to[v]], 1e-6) << source << " to " << v;
  }
}

TEST(Geodesics, ThreadsChangeNothing) {
  const Surface s = make_surface(lopsided());
  const GeodesicSolver solver(s);
  const std::vector<int> sources = spread_sources(s.vertices(), 9);
  const DistanceFields one = solver.fields(sources, 1), four = solver.fields(sources, 4);
  EXPECT_EQ(0, std::memcmp(one.data(), four.data(), sizeof(float) * one.size()));
}

TEST(Geodesics, ObeyTheTriangleInequality) {
  const Surface s = make_surface(lopsided());
  const GeodesicSolver solver(s);
  const std::vector<int> sources = spread_sources(s.vertices(), 20);
  const DistanceFields d = solver.fields(sources, 1);
  const double slack = 0.5 * longest_edge(s);  // of a numerical distance
  for (int i = 0; i < d.rows(); ++i) {
    EXPECT_EQ(d(i, sources[i]), 0);
    for (int j = 0; j < d.rows(); ++j)
      for (int v = 0; v < s.vertices(); ++v) ASSERT_LE(d(i, v), d(i, sources[j]) + d(j, v) + slack);
  }
}

// @param worthwhile  what a second visit must gain, the size of the mesh being 1
void expect_bounds(const TriangleMesh& mesh, double worthwhile) {
  const Surface s = make_surface(mesh);
  const GeodesicSolver solver(s);
  const double slack = 0.5 * longest_edge(s);
  for (const int source : spread_sources(s.vertices(), 10)) {
    const std::vector<float> d = field_of(solver, s.vertices(), source);
    for (int v = 0; v < s.vertices(); ++v) ASSERT_GE(d[v], s.edge_length(source, v) - slack);
    for (int c = 0; c < 3 * s.triangles(); ++c) {
      const int a = s.triangle[c], b = s.triangle[next_corner(c)];
      ASSERT_LE(d[a], d[b] + s.edge_length(a, b) * (1 + 1e-3) + worthwhile);
    }
  }
}

TEST(Geodesics, AreNeverShorterThanStraightNorLongerThanEdges) { expect_bounds(lopsided(), 1e-6); }

// A front over faces as flat as these would visit vertices again and again, for gains that floats round.
TEST(Geodesics, AreSoOnSlivers) {
  for (const double stretch : {100.0, 1e4, 1e6}) expect_bounds(flat_patch(40, stretch, 0.24), 2e-3);
}

TEST(Geodesics, GoAroundACorner) {
  // Three quarters of a square: from one arm to the other the way leads through the inner corner.
  const int side = 41;
  const TriangleMesh square = flat_patch(side, 1, 0.2);
  TriangleMesh mesh;
  mesh.position = square.position;
  for (std::size_t i = 0; i < square.triangle.size(); i += 6) {
    const int cell = static_cast<int>(i / 6), x = cell % (side - 1), y = cell / (side - 1);
    if (x < side / 2 || y < side / 2)
      mesh.triangle.insert(mesh.triangle.end(), &square.triangle[i], &square.triangle[i] + 6);
  }
  // Cells above the corner's row are cut along it: straighten what was moved.
  for (int k = 0; k < side; ++k) {
    double* row = &mesh.position[3 * (side / 2 * side + k)];
    double* column = &mesh.position[3 * (k * side + side / 2)];
    row[1] = column[0] = 0.5;
  }
  const Surface s = make_surface(mesh);
  const GeodesicSolver solver(s);
  const auto at = [&](double x, double y) { return shapes::nearest_vertex({s.position, {}}, x, y, 0); };
  const int corner = at(0.5, 0.5), right = at(0.95, 0.3), top = at(0.3, 0.95);
  const double truth = s.edge_length(right, corner) + s.edge_length(corner, top);
  EXPECT_NEAR(field_of(solver, s.vertices(), right)[top], truth, 0.25 * longest_edge(s));
}

TEST(Geodesics, CrossAPinchedVertex) {
  // Two flat patches that share one corner and nothing else.
  const int side = 20;
  const TriangleMesh patch = flat_patch(side, 1, 0.2);
  TriangleMesh mesh = patch;
  const int shared = side * side - 1;
  std::vector<int> index(side * side, shared);
  for (int v = 1; v < side * side; ++v) {
    index[v] = mesh.vertices();
    for (int k = 0; k < 3; ++k) mesh.position.push_back(patch.position[3 * v + k] + (k < 2 ? 1 : 0));
  }
  for (const int v : patch.triangle) mesh.triangle.push_back(index[v]);
  const Surface s = make_surface(mesh);
  const std::vector<float> d = field_of(GeodesicSolver(s), s.vertices(), side / 2);
  for (int v = side * side; v < s.vertices(); ++v)
    ASSERT_NEAR(d[v], s.edge_length(side / 2, shared) + s.edge_length(shared, v), 0.5 * longest_edge(s));
}

TEST(Geodesics, WorkOnAOneSidedSurface) {
  const Surface s = make_surface(shapes::moebius_strip());
  ASSERT_FALSE(s.orientable);
  const std::vector<float> d = field_of(GeodesicSolver(s), s.vertices(), 0);
  EXPECT_LT(*std::max_element(d.begin(), d.end()), kInfinity);
}

TEST(Geodesics, StopAtTheLimit) {
  const Surface s = make_surface(lopsided());
  const GeodesicSolver solver(s);
  const auto workspace = solver.make_workspace();
  std::vector<float> part(s.vertices(), kInfinity);
  std::vector<int> reached;
  const double edge = longest_edge(s);
  std::size_t before = 0;
  for (const float limit : {0.0f, 0.05f, 0.2f, 0.4f, 10.0f}) {
    const int source = 40 + static_cast<int>(100 * limit);
    const std::vector<float> whole = field_of(solver, s.vertices(), source);
    solver.field_within(source, limit, part.data(), reached, *workspace);
    std::vector<char> listed(s.vertices(), 0);
    for (const int v : reached) {
      EXPECT_FALSE(listed[v]) << "listed twice";
      listed[v] = 1;
      EXPECT_LE(part[v], limit);
    }
    for (int v = 0; v < s.vertices(); ++v) {
      ASSERT_EQ(part[v] < kInfinity, listed[v] != 0);
      if (whole[v] <= limit - edge || limit > 5) {
        ASSERT_NEAR(part[v], whole[v], 1e-6);
      }
      if (listed[v]) {
        ASSERT_GE(part[v], whole[v] - 1e-3 * edge);
      }
    }
    EXPECT_GT(reached.size(), before);
    before = reached.size();
  }
  EXPECT_EQ(before, static_cast<std::size_t>(s.vertices()));
  // A workspace is as good as new after a limited field.
  std::vector<float> again(s.vertices());
  solver.field(40, again.data(), *workspace);
  EXPECT_EQ(again, field_of(solver, s.vertices(), 40));
}

TEST(Geodesics, FindTheNearestSource) {
  const Surface s = make_surface(lopsided());
  const GeodesicSolver solver(s);
  std::vector<int> sources = spread_sources(s.vertices(), 12);
  sources.push_back(sources[3]);
  const DistanceFields fields = solver.fields(sources, 1);
  std::vector<float> distance(s.vertices());
  std::vector<int> label(s.vertices());
  solver.nearest(sources, distance.data(), label.data(), *solver.make_workspace());
  const double slack = 0.5 * longest_edge(s);
  for (int v = 0; v < s.vertices(); ++v) {
    const float truth = fields.col(v).minCoeff();
    ASSERT_NEAR(distance[v], truth, slack);
    ASSERT_LE(fields(label[v], v), truth + slack);
    ASSERT_LT(label[v], 12) << "a repeated source has the label of the first";
  }
  for (int i = 0; i < 12; ++i) EXPECT_EQ(label[sources[i]], i);
}

TEST(Geodesics, RefuseASourceThatIsNoVertex) {
  const Surface s = make_surface(shapes::sphere());
  const GeodesicSolver solver(s);
  const auto workspace = solver.make_workspace();
  std::vector<float> d(s.vertices(), kInfinity);
  std::vector<int> list;
  for (const int bad : {-1, s.vertices()}) {
    EXPECT_THROW(solver.field(bad, d.data(), *workspace), InvalidOption);
    EXPECT_THROW(solver.field_within(bad, 1, d.data(), list, *workspace), InvalidOption);
    EXPECT_THROW(solver.nearest({0, bad}, d.data(), nullptr, *workspace), InvalidOption);
    EXPECT_THROW(solver.fields({0, bad}, 1), InvalidOption);
  }
  EXPECT_THROW(solver.nearest({}, d.data(), nullptr, *workspace), InvalidOption);
}

TEST(Geodesics, StopWhenAskedTo) {
  const Surface s = make_surface(shapes::sphere());
  const std::atomic<bool> cancel{true};
  Context context;
  context.cancel = &cancel;
  EXPECT_THROW(GeodesicSolver(s).fields({0, 1}, 1, context), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
