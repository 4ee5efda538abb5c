// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever mesh a user opens: it ends in a result, a result with a warning, or one line with the remedy.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/symmetry.h"
#include "shapes.h"
#include "surface/surface.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

constexpr double kPi = 3.14159265358979323846;

TriangleMesh creature() { return shapes::bent(shapes::creature(3), 0.1).mesh; }

void add_face(TriangleMesh& mesh, int a, int b, int c) { mesh.triangle.insert(mesh.triangle.end(), {a, b, c}); }

TriangleMesh without_faces(TriangleMesh mesh, const std::function<bool(int)>& gone) {
  std::vector<int> kept;
  for (int f = 0; f < mesh.triangles(); ++f)
    if (!gone(f)) kept.insert(kept.end(), &mesh.triangle[3 * f], &mesh.triangle[3 * f] + 3);
  mesh.triangle = kept;
  return mesh;
}

// columns * rows vertices at place(u, v), u and v in [0,1); each direction closed or open. A closed one may come back
// with the other direction mirrored.
using Place = std::function<std::array<double, 3>(double, double)>;
TriangleMesh sheet(int columns, int rows, bool closed_u, bool closed_v, bool mirrored, const Place& place) {
  TriangleMesh mesh;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto p = place(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
      mesh.position.insert(mesh.position.end(), p.begin(), p.end());
    }
  const auto at = [&](int i, int j) {
    j %= rows;
    if (i < columns) return i * rows + j;
    return mirrored ? (closed_v ? (rows - j) % rows : rows - 1 - j) : j;
  };
  for (int i = 0; i + (closed_u ? 0 : 1) < columns; ++i)
    for (int j = 0; j + (closed_v ? 0 : 1) < rows; ++j) {
      add_face(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add_face(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

// The "figure-8" immersion: it crosses itself.
TriangleMesh klein_bottle() {
  return sheet(40, 20, true, true, true, [](double u, double v) {
    const double a = 2 * kPi * u, b = 2 * kPi * v;
    const double r = 2 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
    return std::array<double, 3>{r * std::cos(a), r * std::sin(a),
                                 std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b)};
  });
}

// A closed tube along an eight that crosses itself in the middle.
TriangleMesh crossing_tube() {
  return sheet(60, 10, true, true, false, [](double u, double v) {
    const double a = 2 * kPi * u, b = 2 * kPi * v;
    const double x = std::cos(a), y = std::sin(2 * a), dx = -std::sin(a), dy = 2 * std::cos(2 * a);
    const double n = std::hypot(dx, dy), r = 0.2 * std::cos(b);
    return std::array<double, 3>{x - r * dy / n, y + r * dx / n, 0.2 * std::sin(b)};
  });
}

TriangleMesh open_cylinder() {
  return sheet(40, 20, true, false, false, [](double u, double v) {
    return std::array<double, 3>{std::cos(2 * kPi * u), std::sin(2 * kPi * u), 4 * v};
  });
}

// A cone over a rough rim around vertex 0, closed by a second tip.
TriangleMesh fan(int faces) {
  TriangleMesh mesh;
  mesh.position = {0, 0, 1, 0, 0, -0.5};
  for (int i = 0; i < faces; ++i) {
    const double u = 2 * kPi * i / faces, r = 1 + 0.3 * std::cos(2 * u) + 0.2 * std::cos(3 * u);
    mesh.position.insert(mesh.position.end(), {r * std::cos(u), r * std::sin(u), 0});
    add_face(mesh, 0, 2 + i, 2 + (i + 1) % faces);
    add_face(mesh, 1, 2 + (i + 1) % faces, 2 + i);
  }
  return mesh;
}

// A hand and the hip grown together: a tube between two faces, which makes a handle.
TriangleMesh with_handle(const TriangleMesh& mesh, int f, int g) {
  std::array<int, 3> a, b;
  for (int k = 0; k < 3; ++k) a[k] = mesh.triangle[3 * f + k], b[k] = mesh.triangle[3 * g + 2 - k];
  TriangleMesh out = without_faces(mesh, [&](int face) { return face == f || face == g; });
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    add_face(out, a[k], a[next], b[k]);
    add_face(out, b[k], a[next], b[next]);
  }
  return out;
}

int face_at(const TriangleMesh& mesh, double x, double y, double z) {
  const int v = shapes::nearest_vertex(mesh, x, y, z);
  return static_cast<int>(std::find(mesh.triangle.begin(), mesh.triangle.end(), v) - mesh.triangle.begin()) / 3;
}

TriangleMesh fused_limbs() {
  const TriangleMesh mesh = creature();
  return with_handle(mesh, face_at(mesh, 2, 0.4, 1), face_at(mesh, 0.9, 0, -0.2));
}

TriangleMesh fused_at_a_vertex() {  // a non-manifold vertex
  TriangleMesh mesh = creature();
  const int hand = shapes::nearest_vertex(mesh, 2, 0.4, 1), hip = shapes::nearest_vertex(mesh, 0.9, 0, -0.2);
  std::replace(mesh.triangle.begin(), mesh.triangle.end(), hand, hip);
  return mesh;
}

TriangleMesh two_at_a_vertex() {
  TriangleMesh mesh = shapes::joined(shapes::sphere(), shapes::body());
  std::replace(mesh.triangle.begin(), mesh.triangle.end(), 0, shapes::sphere().vertices());
  return mesh;
}

TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c) {
    const double* p = &mesh.position[3 * mesh.triangle[c]];
    out.position.insert(out.position.end(), p, p + 3);
    out.triangle.push_back(static_cast<int>(c));
  }
  return out;
}

TriangleMesh with_unused(TriangleMesh mesh, double x) {
  for (int i = 0; i < 100; ++i) mesh.position.insert(mesh.position.end(), {x, 1.0 * i, 0});
  return mesh;
}

TriangleMesh needles(double thinness) {  // a sphere whose triangles are all long and thin
  TriangleMesh mesh = shapes::globe(3, 200, [](double& x, double& y, double& z) {
    const double r = 1 + 0.3 * x * y + 0.2 * z * z * x;
    x *= r, y *= r, z *= r;
  });
  for (std::size_t i = 2; i < mesh.position.size(); i += 3) mesh.position[i] *= thinness;
  return mesh;
}

TriangleMesh spiked(double length) {
  TriangleMesh mesh = creature();
  for (int k = 0; k < 3; ++k) mesh.position[3 * 100 + k] *= length;
  return mesh;
}

TriangleMesh moved_by(TriangleMesh mesh, double offset) {
  for (double& x : mesh.position) x += offset;
  return mesh;
}

TriangleMesh rough() {  // nothing about it is symmetric
  return shapes::globe(25, 40, [](double& x, double& y, double& z) {
    const double r = 1 + 0.3 * std::sin(3 * x + 1) * std::cos(2 * y + 2) + 0.3 * std::sin(4 * z + 2 * x) +
                     0.2 * std::cos(5 * y - 3 * z * x);
    x *= r, y *= r, z *= r;
  });
}

TriangleMesh crumbs(int count) {
  TriangleMesh mesh = creature();
  for (int i = 0; i < count; ++i) {
    const int n = mesh.vertices();
    const double x = 5 + 0.1 * i;
    mesh.position.insert(mesh.position.end(), {x, 0, 0, x + 0.05, 0, 0, x, 0.05, 0});
    add_face(mesh, n, n + 1, n + 2);
  }
  return mesh;
}

TriangleMesh with_coordinate(int at, double x) {
  TriangleMesh mesh = creature();
  mesh.position[at] = x;
  return mesh;
}

TriangleMesh turned_faces(TriangleMesh mesh) {
  Random random(3);
  for (std::size_t i = 0; i < mesh.triangle.size(); i += 3)
    if (draw_below(random, 2)) std::swap(mesh.triangle[i], mesh.triangle[i + 1]);
  return mesh;
}

constexpr const char* kResult = "";  // what is said: nothing

enum class Lacks { nothing, rotation, both };  // which kind of symmetry the shape does not have

struct Opened {
  std::string name;
  std::function<TriangleMesh()> make;
  std::string refused;      // what the refusal says, or kResult
  std::string warned = "";  // what a warning or the line of what was done says, if there is to be one
  bool largest = false;     // the option largest_component
  Lacks lacks = Lacks::nothing;
};
void PrintTo(const Opened& o, std::ostream* out) { *out << o.name; }

void expect_one_line(const std::string& text) {
  EXPECT_FALSE(text.empty());
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

void expect_point(const SurfacePoint& p, int vertices) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    ASSERT_GE(p.vertex[k], 0);
    ASSERT_LT(p.vertex[k], vertices);
    ASSERT_GE(p.weight[k], -1e-9);
    sum += p.weight[k];
  }
  ASSERT_NEAR(sum, 1, 1e-6);
}

// What a Result promises of any mesh.
void expect_sound(const TriangleMesh& mesh, const Result& r) {
  const int n = mesh.vertices();
  std::vector<bool> used(n, false);
  for (const int v : mesh.triangle) used[v] = true;
  ASSERT_EQ(r.partners.partner.size(), static_cast<std::size_t>(n));
  ASSERT_EQ(r.partners.fitness.size(), static_cast<std::size_t>(n));
  ASSERT_EQ(r.partners.side.size(), static_cast<std::size_t>(n));
  ASSERT_EQ(r.partner_point.size(), static_cast<std::size_t>(n));
  int matched = 0;
  for (int v = 0; v < n; ++v) {
    ASSERT_TRUE(r.partners.partner[v] >= -1 && r.partners.partner[v] < n) << v;
    ASSERT_TRUE(r.partners.fitness[v] >= 0 && std::isfinite(r.partners.fitness[v]))
        << v << ": " << r.partners.fitness[v];
    ASSERT_LE(std::abs(r.partners.side[v]), 1) << v;
    if (r.partners.partner[v] < 0) continue;
    ++matched;
    ASSERT_TRUE(used[v] && used[r.partners.partner[v]]) << v;
    expect_point(r.partner_point[v], n);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_EQ(r.matched, matched);
  EXPECT_GT(r.matched, 0);
  EXPECT_TRUE(std::isfinite(r.mean_fitness));
  EXPECT_TRUE(r.confidence >= 0 && r.confidence <= 1) << r.confidence;
  for (const auto& line : r.axis)
    for (const SurfacePoint& p : line) expect_point(p, n);
  for (const SymmetricPair& p : r.pairs) ASSERT_TRUE(p.vertex >= 0 && p.vertex < n && p.partner >= 0 && p.partner < n);
  for (const std::string& warning : r.warnings) expect_one_line(warning);
}

// Four vertices far from each other in space, of the largest component.
References some_references(const TriangleMesh& mesh) {
  const Surface surface = make_surface(mesh, true);
  std::vector<int> chosen{0};
  while (chosen.size() < 4) {
    int farthest = 0;
    double most = -1;
    for (int v = 0; v < surface.vertices(); ++v) {
      double nearest = INFINITY;
      for (const int c : chosen) nearest = std::min(nearest, surface.edge_length(v, c));
      if (nearest > most) most = nearest, farthest = v;
    }
    chosen.push_back(farthest);
  }
  for (int& v : chosen) v = surface.mesh_vertex[v];
  return {{chosen[0], chosen[1]}, {{chosen[2], chosen[3]}}};
}

class AnyMesh : public testing::TestWithParam<Opened> {
 protected:
  AnyMesh() : mesh_(GetParam().make()) {
    if (mesh_.vertices() > 0)
      if (std::all_of(mesh_.triangle.begin(), mesh_.triangle.end(), [&](int v) { return v < mesh_.vertices(); }))
        mesh_ = shapes::renumbered(mesh_, shapes::random_permutation(mesh_.vertices(), 5));
  }

  // Smaller than the defaults: what is tested is that it ends, and how.
  Options options() const {
    Options o;
    o.largest_component = GetParam().largest;
    o.joint.samples = 40, o.joint.sites = 100, o.joint.population = 12, o.joint.max_generations = 3;
    o.pairs.samples = 100, o.pairs.max_generations = 20;
    o.proxy = 1000;
    return o;
  }
  // "No symmetry found" is an answer only where the shape has none of that kind.
  void expect_outcome(const Options& options) const {
    try {
      const Result result = find_symmetry(mesh_, options);
      ASSERT_EQ(GetParam().refused, kResult) << "was accepted";
      expect_sound(mesh_, result);
      if (!GetParam().warned.empty()) {
        EXPECT_TRUE(result.surface.find(GetParam().warned) != std::string::npos ||
                    std::any_of(result.warnings.begin(), result.warnings.end(),
                                [&](const std::string& warning) {
                                  return warning.find(GetParam().warned) != std::string::npos;
                                }))
            << "nothing says: " << GetParam().warned << "; what was done: " << result.surface;
      }
    } catch (const InvalidMesh& error) {
      if (std::string(error.what()).find("no symmetry found: give") == 0) {
        EXPECT_TRUE(GetParam().lacks == Lacks::both ||
                    (GetParam().lacks == Lacks::rotation && options.symmetry == SymmetryKind::rotation))
            << error.what();
        return;
      }
      ASSERT_NE(GetParam().refused, kResult) << error.what();
      expect_one_line(error.what());
      EXPECT_NE(std::string(error.what()).find(GetParam().refused), std::string::npos) << error.what();
    }
  }

  TriangleMesh mesh_;
};

TEST_P(AnyMesh, EndsWellWithoutReferences) { expect_outcome(options()); }

TEST_P(AnyMesh, EndsWellAsARotation) {
  Options o = options();
  o.symmetry = SymmetryKind::rotation;
  expect_outcome(o);
}

TEST_P(AnyMesh, EndsWellWithReferences) {
  Options o = options();
  o.references = {{0, 1}, {{2, 3}}};
  if (GetParam().refused == kResult) {
    if (mesh_.vertices() < 4) {  // so that one of the references is none of its vertices
      EXPECT_THROW(find_symmetry(mesh_, o), InvalidOption);
      return;
    }
    o.references = some_references(mesh_);
  }
  expect_outcome(o);
}

TEST_P(AnyMesh, EndsWellPairByPair) {
  Options o = options();
  o.method = Method::pairs;
  o.references = {{0, 1}, {{2, 3}}};
  if (GetParam().refused == kResult) {
    if (mesh_.vertices() < 4) {  // so that one of the references is none of its vertices
      EXPECT_THROW(find_symmetry(mesh_, o), InvalidOption);
      return;
    }
    o.references = some_references(mesh_);
  }
  expect_outcome(o);
}

const double kNan = std::nan(""), kInf = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Robustness, AnyMesh,
    testing::Values(
        // Refused.
        Opened{"empty", [] { return TriangleMesh(); }, "empty"},
        Opened{"point_cloud", [] { return without_faces(creature(), [](int) { return true; }); }, "point cloud"},
        Opened{"crushed_to_a_plane_seen_from_the_side",
               [] {
                 TriangleMesh mesh = shapes::scaled(shapes::grid(10, 10), 1);
                 for (std::size_t i = 1; i < mesh.position.size(); i += 3) mesh.position[i] = 0;
                 return mesh;
               },
               "without area"},
        Opened{"not_a_number", [] { return with_coordinate(7, kNan); }, "not finite"},
        Opened{"infinite", [] { return with_coordinate(7, -kInf); }, "not finite"},
        Opened{"unused_vertex_not_a_number", [] { return with_unused(creature(), kNan); }, "not finite"},
        Opened{"too_large_to_measure",
               [] {
                 TriangleMesh mesh = shapes::scaled(creature(), 1e300);
                 mesh.position[0] = 1.7e308, mesh.position[3] = -1.7e308;
                 return mesh;
               },
               "extent"},
        Opened{"far_beyond_its_precision", [] { return moved_by(creature(), 1e17); }, "check the scale"},
        Opened{"index_too_large",
               [] {
                 TriangleMesh mesh = creature();
                 mesh.triangle[3] = std::numeric_limits<int>::max();
                 return mesh;
               },
               "repair the mesh file"},
        // Worked on, and what was done is said.
        Opened{"one_triangle",
               [] {
                 return TriangleMesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
               },
               kResult},
        Opened{"tetrahedron",
               [] {
                 return TriangleMesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3}};
               },
               kResult},
        Opened{"triangle_soup", [] { return soup(creature()); }, kResult, "welded"},
        Opened{"largest_of_a_soup", [] { return soup(creature()); }, kResult, "welded", true},
        Opened{"zero_area_face",
               [] {
                 TriangleMesh mesh = creature();
                 add_face(mesh, 5, 5, 6);
                 return mesh;
               },
               kResult, "dropped 1 face without area"},
        Opened{"fin_on_an_edge",
               [] {
                 TriangleMesh mesh = creature();
                 mesh.position.insert(mesh.position.end(), {9, 9, 9});
                 add_face(mesh, mesh.triangle[0], mesh.triangle[1], mesh.vertices() - 1);
                 return mesh;
               },
               kResult, "cut 1 edge"},
        Opened{"every_face_twice",
               [] {
                 TriangleMesh mesh = creature();
                 const std::vector<int> once = mesh.triangle;
                 mesh.triangle.insert(mesh.triangle.end(), once.begin(), once.end());
                 return mesh;
               },
               kResult, "that are there twice"},
        Opened{"many_components", [] { return crumbs(1000); }, kResult},
        Opened{"fan_beyond_measure", [] { return fan(20001); }, kResult},
        Opened{"largest_of_many_components", [] { return crumbs(1000); }, kResult, "largest of 1001", true},
        Opened{"unused_vertices", [] { return with_unused(creature(), 1); }, kResult, "left out 100 vertices"},
        Opened{"moebius_strip", [] { return shapes::moebius_strip(); }, kResult, "one side"},
        // It has a half turn; but so few samples do not tell it from the identity, as there is no orientation.
        Opened{"klein_bottle", klein_bottle, kResult, "one side", false, Lacks::both},
        // Worked on.
        Opened{"twenty_vertices", [] { return shapes::globe(3, 6, [](double&, double&, double&) {}); }, kResult},
        Opened{"inconsistent_orientation", [] { return turned_faces(creature()); }, kResult},
        Opened{"slit",
               [] {
                 TriangleMesh mesh = creature();  // vertices of some faces doubled, so that they come apart
                 for (int f = 0; f < 40; ++f) {
                   const double* p = &mesh.position[3 * mesh.triangle[3 * f]];
                   const double copy[3] = {p[0], p[1], p[2]};
                   mesh.position.insert(mesh.position.end(), copy, copy + 3);
                   mesh.triangle[3 * f] = mesh.vertices() - 1;
                 }
                 return mesh;
               },
               kResult},
        Opened{"many_holes", [] { return without_faces(shapes::creature(4).mesh, [](int f) { return f % 7 == 3; }); },
               kResult, "", false, Lacks::rotation},
        Opened{"flat_with_border", [] { return shapes::grid(30, 20); }, kResult},
        Opened{"strip_of_single_faces", [] { return shapes::grid(2, 60); }, kResult},
        Opened{"non_manifold_vertex", two_at_a_vertex, kResult},
        Opened{"fused_at_a_vertex", fused_at_a_vertex, kResult}, Opened{"fused_limbs", fused_limbs, kResult},
        Opened{"self_intersection", crossing_tube, kResult}, Opened{"needles", [] { return needles(1); }, kResult},
        Opened{"thin_needles", [] { return needles(1e-4); }, kResult},
        Opened{"stretched_a_million_times",
               [] {
                 TriangleMesh mesh = creature();
                 for (std::size_t i = 0; i < mesh.position.size(); i += 3) mesh.position[i] *= 1e6;
                 return mesh;
               },
               kResult},
        // All but a needle.
        Opened{"spike", [] { return spiked(1e3); }, kResult, "", false, Lacks::both},
        Opened{"long_spike", [] { return spiked(1e6); }, kResult, "", false, Lacks::both},
        Opened{"tiny", [] { return shapes::scaled(creature(), 1e-30); }, kResult},
        Opened{"huge", [] { return shapes::scaled(creature(), 1e30); }, kResult},
        Opened{"smallest", [] { return shapes::scaled(creature(), 1e-290); }, kResult},
        Opened{"largest", [] { return shapes::scaled(creature(), 1e300); }, kResult},
        Opened{"far_away", [] { return moved_by(creature(), 1e6); }, kResult}, Opened{"asymmetric", rough, kResult},
        Opened{"sphere", [] { return shapes::icosphere(3); }, kResult},
        Opened{"torus", [] { return shapes::torus(40, 20); }, kResult},
        Opened{"genus_two",
               [] {
                 const TriangleMesh mesh = shapes::torus(40, 20);
                 return with_handle(mesh, face_at(mesh, 1, 0, 0.4), face_at(mesh, -1, 0, 0.4));
               },
               kResult},
        Opened{"cylinder", open_cylinder, kResult},
        Opened{"long_tube",
               [] {
                 return sheet(8, 200, true, false, false, [](double u, double v) {
                   return std::array<double, 3>{0.001 * std::cos(2 * kPi * u), 0.001 * std::sin(2 * kPi * u), v};
                 });
               },
               kResult},
        Opened{"fan", [] { return fan(500); }, kResult}, Opened{"huge_fan", [] { return fan(20000); }, kResult}),
    [](const auto& info) { return info.param.name; });

TEST(Robustness, ReferencesOnAVertexOfNoFaceAreRefused) {
  Options o;
  const TriangleMesh mesh = with_unused(creature(), 1);
  o.references = {{0, mesh.vertices() - 1}, {{1, 2}}};
  EXPECT_THROW(find_symmetry(mesh, o), InvalidOption);
}

}  // namespace
}  // namespace ga_symmetry
