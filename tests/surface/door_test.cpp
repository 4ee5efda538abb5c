// SPDX-License-Identifier: GPL-3.0-or-later
// The door: what a mesh must be, and what a bad one is told.
#include <gtest/gtest.h>
#include <vcg/complex/complex.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/mesh.h"
#include "shapes.h"
#include "surface/surface.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

struct BadMesh {
  std::string name, says;
  std::function<TriangleMesh()> make;
};

void PrintTo(const BadMesh& bad, std::ostream* out) { *out << bad.name; }

class RefusedMesh : public testing::TestWithParam<BadMesh> {};

TEST_P(RefusedMesh, InOneLineWithTheRemedy) {
  const TriangleMesh mesh = GetParam().make();
  for (bool largest : {false, true}) {
    try {
      make_surface(mesh, largest);
      ADD_FAILURE() << "was accepted";
    } catch (const InvalidMesh& error) {
      EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

TriangleMesh with_face(int a, int b, int c) {
  TriangleMesh mesh = shapes::sphere();
  mesh.triangle.insert(mesh.triangle.end(), {a, b, c});
  return mesh;
}

TriangleMesh with_coordinate(double x) {
  TriangleMesh mesh = shapes::sphere();
  mesh.position[7] = x;
  return mesh;
}

TriangleMesh point_cloud() {
  TriangleMesh mesh = shapes::sphere();
  mesh.triangle.clear();
  return mesh;
}

TriangleMesh flattened() {
  TriangleMesh mesh = shapes::sphere();
  for (std::size_t i = 0; i < mesh.position.size(); i += 3) mesh.position[i + 1] = mesh.position[i + 2] = 0;
  return mesh;
}

INSTANTIATE_TEST_SUITE_P(
    Door, RefusedMesh,
    testing::Values(BadMesh{"empty", "empty", [] { return TriangleMesh(); }},
                    BadMesh{"point_cloud", "point cloud", point_cloud},
                    BadMesh{"index_out_of_range", "refers to vertex 9999", [] { return with_face(0, 1, 9999); }},
                    BadMesh{"negative_index", "refers to vertex -1", [] { return with_face(0, 1, -1); }},
                    BadMesh{"everything_on_a_line", "without area", flattened},
                    BadMesh{"everything_at_a_point", "no extent", [] { return shapes::scaled(shapes::sphere(), 0); }},
                    BadMesh{"not_a_number", "not finite", [] { return with_coordinate(std::nan("")); }},
                    BadMesh{"infinite", "not finite",
                            [] { return with_coordinate(std::numeric_limits<double>::infinity()); }}),
    [](const auto& info) { return info.param.name; });

TEST(Door, KeepsTheLargestComponentWhenAsked) {
  const TriangleMesh small = shapes::sphere(), large = shapes::body();
  const Surface surface = make_surface(shapes::joined(small, large), true);
  EXPECT_EQ(surface.vertices(), large.vertices());
  EXPECT_EQ(surface.mesh_vertices, small.vertices() + large.vertices());
  for (int v = 0; v < surface.vertices(); ++v) ASSERT_EQ(surface.mesh_vertex[v], small.vertices() + v);
  ASSERT_EQ(surface.notes.size(), 1u);
  EXPECT_NE(surface.notes[0].find("largest of 2 parts: "), std::string::npos) << surface.notes[0];
}

TEST(Door, OrientsFacesAlike) {
  TriangleMesh mesh = shapes::sphere();
  for (std::size_t f = 0; f < mesh.triangle.size() / 3; f += 3)
    std::swap(mesh.triangle[3 * f], mesh.triangle[3 * f + 1]);
  const Surface surface = make_surface(mesh);
  EXPECT_TRUE(surface.orientable);
  EXPECT_TRUE(surface.closed);
  for (int c = 0; c < 3 * surface.triangles(); ++c) {
    const int o = surface.opposite[c];
    ASSERT_GE(o, 0);
    ASSERT_EQ(surface.opposite[o], c);
    ASSERT_EQ(surface.triangle[next_corner(c)], surface.triangle[previous_corner(o)]);
    ASSERT_EQ(surface.triangle[previous_corner(c)], surface.triangle[next_corner(o)]);
  }
}

TEST(Door, TellsAMoebiusStrip) {
  const Surface surface = make_surface(shapes::moebius_strip());
  EXPECT_FALSE(surface.orientable);
  EXPECT_FALSE(surface.closed);
  ASSERT_FALSE(surface.notes.empty());
  EXPECT_NE(surface.notes.back().find("one side"), std::string::npos) << surface.notes.back();
}

// Every face on vertices of its own, as a renderer gets it.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const int v : mesh.triangle) {
    out.triangle.push_back(out.vertices());
    for (int k = 0; k < 3; ++k) out.position.push_back(mesh.position[3 * static_cast<std::size_t>(v) + k]);
  }
  return out;
}

TEST(Door, WeldsASoupOfTriangles) {
  const TriangleMesh mesh = shapes::sphere(), soup = soup_of(mesh);
  const Surface whole = make_surface(mesh), welded = make_surface(soup);
  EXPECT_EQ(welded.vertices(), whole.vertices());
  EXPECT_TRUE(welded.closed);
  EXPECT_NEAR(welded.area, whole.area, 1e-12 * whole.area);
  for (int v = 0; v < soup.vertices(); ++v) {
    const int at = welded.surface_vertex[v];
    ASSERT_GE(at, 0);
    const int first = welded.mesh_vertex[at];
    for (int k = 0; k < 3; ++k) ASSERT_EQ(soup.position[3 * v + k], soup.position[3 * first + k]);
  }
}

// Whatever the order of a large file, what is near on the surface is near in memory.
TEST(Door, ForgetsTheOrderOfALargeMesh) {
  const TriangleMesh mesh = shapes::sphere(240, 240);
  std::vector<int> to;
  const Surface ordered = make_surface(mesh), s = make_surface(shapes::shuffled(mesh, 1, &to));
  EXPECT_EQ(s.position, ordered.position);
  EXPECT_EQ(s.triangle, ordered.triangle);
  double apart = 0;
  for (std::size_t c = 0; c < s.triangle.size(); c += 3) apart += std::abs(s.triangle[c] - s.triangle[c + 1]);
  EXPECT_LT(apart / s.triangles(), 0.02 * s.vertices());  // a third of them in a random order
  for (int v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(s.surface_vertex[to[v]], ordered.surface_vertex[v]);
}

// All of it but one part falls into one cell of the curve.
TEST(Door, WeldsALargeSoupBesideSomethingFar) {
  const TriangleMesh mesh = shapes::sphere(120, 120);
  TriangleMesh far = shapes::sphere();
  for (double& x : far.position) x += 1e5;
  const Surface s = make_surface(shapes::joined(soup_of(mesh), far));
  EXPECT_EQ(s.vertices(), mesh.vertices() + far.vertices());
  EXPECT_TRUE(s.closed);
}

TEST(Door, DropsRepeatedAndZeroAreaFaces) {
  const TriangleMesh sphere = shapes::sphere();
  TriangleMesh mesh = with_face(sphere.triangle[1], sphere.triangle[2], sphere.triangle[0]);
  mesh.triangle.insert(mesh.triangle.end(), {5, 5, 6});
  const Surface surface = make_surface(mesh);
  EXPECT_EQ(surface.triangles(), sphere.triangles());
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(surface.notes.size(), 2u);
}

// A fin on a closed surface: the surface stays closed where the fin stands, the fin is what ends there.
TEST(Door, CutsFinsOff) {
  TriangleMesh mesh = shapes::sphere();
  const int a = mesh.triangle[0], b = mesh.triangle[1], tip = mesh.vertices();
  for (int k = 0; k < 3; ++k)
    mesh.position.push_back(0.6 * (mesh.position[3 * static_cast<std::size_t>(a) + k] +
                                   mesh.position[3 * static_cast<std::size_t>(b) + k]));
  mesh.triangle.insert(mesh.triangle.end(), {a, b, tip});
  const Surface surface = make_surface(mesh);
  EXPECT_EQ(surface.branching, 1);
  EXPECT_TRUE(surface.orientable);
  const int fin = 3 * (surface.triangles() - 1);
  for (int c = 0; c < fin; ++c) {
    ASSERT_GE(surface.opposite[c], 0);
    ASSERT_LT(surface.opposite[c], fin);
    ASSERT_EQ(surface.opposite[surface.opposite[c]], c);
  }
  for (int c = fin; c < fin + 3; ++c) EXPECT_EQ(surface.opposite[c], -1);
}

// One of two halves has a vertex in the middle of each edge of the seam, the other has not.
TEST(Door, ClosesTJunctions) {
  TriangleMesh mesh = shapes::grid(3, 3);
  // The edge 0-1 of the border is split by a vertex that only a triangle beyond it uses.
  const int middle = mesh.vertices();
  for (int k = 0; k < 3; ++k) mesh.position.push_back(0.5 * (mesh.position[k] + mesh.position[3 + k]));
  const int below = mesh.vertices();
  mesh.position.insert(mesh.position.end(), {mesh.position[0], mesh.position[1] - 0.5, 0});
  mesh.triangle.insert(mesh.triangle.end(), {0, below, middle, middle, below, 1});
  const Surface surface = make_surface(mesh);
  int border = 0;
  for (const int o : surface.opposite) border += o < 0;
  EXPECT_EQ(border, 7 + 2) << "eight edges around the grid but the one that is joined, and two below";
  EXPECT_EQ(surface.notes.size(), 1u + (surface.flipped > 0));
}

// A square of two triangles, and a needle: the ends of the diagonal and its middle.
TriangleMesh square_with_a_needle(bool faces_twice) {
  TriangleMesh mesh = shapes::grid(2, 2);
  const Surface square = make_surface(mesh);
  std::vector<int> diagonal;
  for (int c = 0; c < 6; ++c)
    if (square.opposite[c] >= 0) diagonal = {square.triangle[next_corner(c)], square.triangle[previous_corner(c)]};
  const int middle = mesh.vertices();
  for (int k = 0; k < 3; ++k)
    mesh.position.push_back(0.5 * (mesh.position[3 * diagonal[0] + k] + mesh.position[3 * diagonal[1] + k]));
  const std::vector<int> once = mesh.triangle;
  if (faces_twice) mesh.triangle.insert(mesh.triangle.end(), once.begin(), once.end());
  mesh.triangle.insert(mesh.triangle.end(), {diagonal[0], diagonal[1], middle});
  return mesh;
}

TEST(Door, NeedlesLeaveNoGapAndNothingTwice) {
  const Surface square = make_surface(shapes::grid(2, 2));
  for (const bool twice : {false, true}) {
    // The needle fills the gap that a split of one side alone would leave.
    const Surface after = make_surface(square_with_a_needle(twice));
    EXPECT_NEAR(after.area, square.area, 1e-12) << twice;
    EXPECT_EQ(std::count(after.opposite.begin(), after.opposite.end(), -1), 4) << "the square's own sides";
    EXPECT_EQ(after.branching, 0);
  }
}

TEST(Door, ScaleMakesNoDifference) {
  const TriangleMesh mesh = shapes::body();
  const Surface one = make_surface(mesh);
  for (double factor : {1e-30, 1e-3, 1e30}) {
    const Surface other = make_surface(shapes::scaled(mesh, factor));
    ASSERT_EQ(other.triangle, one.triangle);
    EXPECT_NEAR(other.area / one.area, 1, 1e-12) << factor;
    // Each coordinate is rounded twice: by the factor, and by the division through the extent.
    for (std::size_t i = 0; i < one.position.size(); ++i) ASSERT_NEAR(other.position[i], one.position[i], 1e-15);
  }
}

TEST(Door, LeavesOutVerticesOfNoFace) {
  const TriangleMesh sphere = shapes::sphere();
  TriangleMesh mesh;
  mesh.position = {9, 9, 9};
  mesh.position.insert(mesh.position.end(), sphere.position.begin(), sphere.position.end());
  for (int v : sphere.triangle) mesh.triangle.push_back(v + 1);
  const Surface surface = make_surface(mesh);
  EXPECT_EQ(surface.vertices(), sphere.vertices());
  EXPECT_EQ(surface.mesh_vertex.front(), 1);
}

class DoorVertex;
class DoorFace;
struct DoorTypes : vcg::UsedTypes<vcg::Use<DoorVertex>::AsVertexType, vcg::Use<DoorFace>::AsFaceType> {};
class DoorVertex : public vcg::Vertex<DoorTypes, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
class DoorFace : public vcg::Face<DoorTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class DoorMesh : public vcg::tri::TriMesh<std::vector<DoorVertex>, std::vector<DoorFace>> {};
using DoorAllocator = vcg::tri::Allocator<DoorMesh>;

void to_vcglib(const TriangleMesh& mesh, DoorMesh& m) {
  DoorAllocator::AddVertices(m, mesh.vertices());
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int k = 0; k < 3; ++k) m.vert[v].P()[k] = static_cast<float>(mesh.position[3 * v + k]);
  for (std::size_t f = 0; f < mesh.triangle.size(); f += 3)
    DoorAllocator::AddFace(m, mesh.triangle[f], mesh.triangle[f + 1], mesh.triangle[f + 2]);
}

TEST(Door, TakesAVcglibMeshAsItIs) {
  const TriangleMesh mesh = shapes::sphere();
  DoorMesh m;
  to_vcglib(mesh, m);
  const TriangleMesh out = to_triangle_mesh(m);
  EXPECT_EQ(out.triangle, mesh.triangle);
  ASSERT_EQ(out.position.size(), mesh.position.size());
  for (std::size_t i = 0; i < out.position.size(); ++i)
    ASSERT_EQ(out.position[i], static_cast<float>(mesh.position[i]));
}

TEST(Door, DeletedVerticesKeepTheirSlots) {
  const TriangleMesh small = shapes::sphere(), large = shapes::body();
  DoorMesh m;
  to_vcglib(shapes::joined(small, large), m);
  for (std::size_t f = 0; f < m.face.size(); ++f)
    if (f < static_cast<std::size_t>(small.triangles())) DoorAllocator::DeleteFace(m, m.face[f]);
  for (int v = 0; v < small.vertices(); ++v) {
    m.vert[v].P()[0] = std::numeric_limits<float>::quiet_NaN();  // what a deleted vertex holds is nobody's business
    DoorAllocator::DeleteVertex(m, m.vert[v]);
  }
  const TriangleMesh mesh = to_triangle_mesh(m);
  EXPECT_EQ(mesh.vertices(), small.vertices() + large.vertices());
  EXPECT_EQ(mesh.triangles(), large.triangles());
  const Surface surface = make_surface(mesh);
  EXPECT_EQ(surface.vertices(), large.vertices());
  EXPECT_EQ(surface.mesh_vertex.front(), small.vertices());
}

}  // namespace
}  // namespace ga_symmetry
