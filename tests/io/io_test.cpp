// SPDX-License-Identifier: GPL-3.0-or-later
// Files: meshes in, results out, the contract of the CSV, all or nothing.
#include "ga_symmetry/io.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <vcg/complex/complex.h>
#include <wrap/io_trimesh/export_off.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"
#include "ga_symmetry/result.h"
#include "io/value_table.h"
#include "shapes.h"

namespace ga_symmetry {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "ga_symmetry_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
  void expect_refused(const std::string& name, const std::string& bytes, const std::string& says) const {
    write(name, bytes);
    try {
      read_mesh(path(name));
      ADD_FAILURE() << name << " was read: " << bytes.substr(0, 60);
    } catch (const FileError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(says), std::string::npos) << what;
      EXPECT_NE(what.find(path(name)), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
  fs::path folder_;
};

using ReadMesh = Files;
using WriteResult = Files;
using Evaluate = Files;

// A square of two triangles.
const std::vector<double> kSquare{0, 0, 0, 1.25, 0, 0, 1.25, 1, 0, 0, 1, -0.5};
const std::vector<int> kSquareTriangles{0, 1, 2, 0, 2, 3};

void expect_square(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.position, kSquare);
  EXPECT_EQ(mesh.triangle, kSquareTriangles);
}

TEST_F(ReadMesh, Off) {
  const std::string vertices = "0 0 0\n1.25 0 0\n1.25 1 0\n0 1 -.5\n";
  expect_square(read_mesh(write("a.off", "OFF\n4 2 0\n" + vertices + "3 0 1 2\n3 0 2 3\n")));
  expect_square(read_mesh(write("b.OFF",
                                "# made by hand\r\nOFF 4 2 0\r\n\n0 0 0 1.25 0 0\n1.25 1\n0\n# more\n0 +1 "
                                "-5e-1\n3 0 1\n2 9 9\n3 0 2 3")));
  expect_square(read_mesh(write("c.off",
                                "COFF\n4 2 0\n0 0 0 255 0 0 255\n1.25 0 0 1\n1.25 1 0\n0 1 -.5 0.1 0.2 0.3\n"
                                "3 0 1 2\n3 0 2 3\n")));
  expect_square(read_mesh(write("d.off",
                                "NOFF\n4 2 0\n0 0 0 0 0 1\n1.25 0 0 0 0 1\n1.25 1 0 0 0 1\n0 1 -.5 0 0 1\n"
                                "3 0 1 2\n3 0 2 3\n")));
}

TEST_F(ReadMesh, Obj) {
  const std::string vertices = "v 0 0 0\nv 1.25 0 0 1.0\nv 1.25 1 0 0.5 0.5 0.5\nv 0 1 -.5\n";
  expect_square(read_mesh(write("a.obj", vertices + "f 1 2 3\nf 1 3 4\n")));
  expect_square(read_mesh(write("b.obj", "mtllib none.mtl\no thing\n" + vertices +
                                             "vt 0 0\nvn 0 0 1\nusemtl red\ns off\nf 1/1/1 2/1/1 3/1/1 # first\n"
                                             "f 1//1 -2//1 -1//1")));
  expect_square(read_mesh(write("c.obj", vertices + "f 1 2 \\\r\n 3\\\n 4\n")));
}

TEST_F(ReadMesh, PlyText) {
  const std::string header =
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n";
  expect_square(
      read_mesh(write("a.ply", header + "0 0 0 1\n1.25 0 0 2\n1.25 1 0 3\n0 1 -.5 4\n3 0 1 2 0\n3 0 2 3 2 0.5 0.5\n")));
}

TEST_F(ReadMesh, PlyWithEdges) {
  const auto ply = [](const std::string& type, const std::string& edge) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 2\nproperty list uchar int vertex_indices\nelement edge 1\nproperty " +
           type + " vertex1\nproperty " + type + " vertex2\nproperty float length\nend_header\n" +
           "0 0 0\n1.25 0 0\n1.25 1 0\n0 1 -.5\n3 0 1 2\n3 0 2 3\n" + edge;
  };
  expect_square(read_mesh(write("a.ply", ply("int", "0 3 0.5\n"))));
  expect_square(read_mesh(write("a.ply", ply("short", "0 3 0.5\n"))));
  EXPECT_THROW(read_mesh(write("a.ply", ply("int", "0 3\n"))), FileError);
}

class FileVertex;
class FileFace;
struct FileTypes : vcg::UsedTypes<vcg::Use<FileVertex>::AsVertexType, vcg::Use<FileFace>::AsFaceType> {};
class FileVertex : public vcg::Vertex<FileTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::Qualityf,
                                      vcg::vertex::Color4b, vcg::vertex::BitFlags> {};
class FileFace
    : public vcg::Face<FileTypes, vcg::face::VertexRef, vcg::face::Normal3f, vcg::face::Color4b, vcg::face::BitFlags> {
};
class FileMesh : public vcg::tri::TriMesh<std::vector<FileVertex>, std::vector<FileFace>> {};

void to_vcglib(const TriangleMesh& mesh, FileMesh& m) {
  vcg::tri::Allocator<FileMesh>::AddVertices(m, mesh.vertices());
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    m.vert[i / 3].P()[i % 3] = static_cast<float>(mesh.position[i]);
  for (std::size_t f = 0; f < mesh.triangle.size(); f += 3)
    vcg::tri::Allocator<FileMesh>::AddFace(m, mesh.triangle[f], mesh.triangle[f + 1], mesh.triangle[f + 2]);
}

template <class Number>
void append(std::string& bytes, Number value, bool big_endian) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

// Properties of every type between those that count, lists of every type of count, in both orders of bytes.
TEST_F(ReadMesh, PlyOfEveryType) {
  const std::string header =
      "element vertex 4\nproperty char a\nproperty double x\nproperty list ushort short b\nproperty float y\n"
      "property short z\nproperty uint c\nelement other 1\nproperty list int double d\nelement face 2\n"
      "property list char float e\nproperty list uint ushort vertex_index\nproperty ushort f\nend_header\n";
  TriangleMesh expected;
  expected.position = {0.1, 0.2f, 0, 1e300, 2.5, -3, 1, 1e-45f, 4, 5, 6, 7};
  expected.triangle = {0, 1, 2, 0, 2, 3, 3, 2, 1};
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\r\n" + header;
    for (int v = 0; v < 4; ++v) {
      append(bytes, std::int8_t{-1}, big);
      append(bytes, expected.position[3 * v], big);
      append(bytes, static_cast<std::uint16_t>(v), big);
      for (int i = 0; i < v; ++i) append(bytes, std::int16_t{-2}, big);
      append(bytes, static_cast<float>(expected.position[3 * v + 1]), big);
      append(bytes, static_cast<std::int16_t>(expected.position[3 * v + 2]), big);
      append(bytes, std::uint32_t{7}, big);
    }
    append(bytes, std::int32_t{2}, big);
    for (int i = 0; i < 2; ++i) append(bytes, 0.5, big);
    for (const std::vector<std::uint16_t>& face : {std::vector<std::uint16_t>{0, 1, 2, 3}, {3, 2, 1}}) {
      append(bytes, std::int8_t{0}, big);
      append(bytes, static_cast<std::uint32_t>(face.size()), big);
      for (const std::uint16_t v : face) append(bytes, v, big);
      append(bytes, std::uint16_t{9}, big);
    }
    const TriangleMesh mesh = read_mesh(write("a.ply", bytes));
    EXPECT_EQ(mesh.position, expected.position) << big;
    EXPECT_EQ(mesh.triangle, expected.triangle) << big;
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(read_mesh(write("cut.ply", bytes.substr(0, size))), FileError) << size;
  }
  const TriangleMesh mesh =
      read_mesh(write("a.ply", "ply\nformat ascii 1.0\n" + header +
                                   "-1 0.1 0 0.2 0 7\n-1 1e300 1 -2 2.5 -3 7\n-1 1 0 1e-45 4 7\n-1\n5 0 6 7 "
                                   "7 2 .5 .5\n0 4 0 1 2 3 9\n0 3 3 2 1 9"));
  EXPECT_EQ(mesh.position, expected.position);
  EXPECT_EQ(mesh.triangle, expected.triangle);
}

// The count of a list was once an amount of bits to shift by, also where it was a double.
TEST_F(ReadMesh, PlyListsAreCountedInIntegers) {
  const auto ply = [](const std::string& list, const std::string& count) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
           "list " +
           list + " int extra\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + count +
           "\n1 0 0 0\n1 1 0 0\n3 0 1 2\n";
  };
  EXPECT_EQ(read_mesh(write("a.ply", ply("uchar", "0"))).triangles(), 1);
  for (const char* type : {"float", "double"}) expect_refused("a.ply", ply(type, "0"), "line 7: a list");
  expect_refused("a.ply", ply("uchar", "256"), "line 11: \"256\" is not an integer");
  expect_refused("a.ply", ply("uchar", "1.0"), "line 11: \"1.0\" is not an integer");
  expect_refused("a.ply", ply("int", "-1"), "line 11: the list \"extra\" has a negative");
  expect_refused("a.ply", ply("uint", "4294967295"), "ends early");
}

TEST_F(ReadMesh, NumbersOutOfRangeAreZeroOrInfinite) {
  const std::string one = "0 0 0\n1 0 0\n", face = "3 0 1 2\n";
  const TriangleMesh off = read_mesh(write("a.off", "OFF\n3 1 0\n" + one + "1e-400 -1e999 4e-320\n" + face));
  EXPECT_EQ(off.position[6], 0);
  EXPECT_EQ(off.position[7], -INFINITY);
  EXPECT_EQ(off.position[8], 4e-320);
  const TriangleMesh ply = read_mesh(
      write("a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty double z\nelement "
            "face 1\nproperty list uchar int vertex_index\nend_header\n" +
                one + "1e-60 1e60 1e60\n" + face));
  EXPECT_EQ(ply.position[6], 0);
  EXPECT_EQ(ply.position[7], INFINITY);
  EXPECT_EQ(ply.position[8], 1e60);
}

TEST_F(ReadMesh, TriangleStrips) {
  const std::string header =
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 2\n"
      "property list int int vertex_indices\nend_header\n";
  const std::vector<std::vector<std::int32_t>> strips{{0, 1, 2, 3, 4, -1, 2, 1, -1, -1, 4, 3, 2, 1}, {1, 2, 3}};
  std::string text = "ply\nformat ascii 1.0\n" + header, bytes = "ply\nformat binary_big_endian 1.0\n" + header;
  for (int i = 0; i < 15; ++i) append(bytes, static_cast<float>(i), true), text += std::to_string(i) + "\n";
  for (const auto& strip : strips) {
    append(bytes, static_cast<std::int32_t>(strip.size()), true), text += std::to_string(strip.size());
    for (const std::int32_t v : strip) append(bytes, v, true), text += ' ' + std::to_string(v);
    text += '\n';
  }
  // Every other triangle of a strip is turned; vertices between two -1 that are less than three make none.
  const std::vector<int> expected{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 2, 2, 3, 1, 1, 2, 3};
  EXPECT_EQ(read_mesh(write("a.ply", text)).triangle, expected);
  EXPECT_EQ(read_mesh(write("b.ply", bytes)).triangle, expected);
  std::string bad = text;
  expect_refused("a.ply", bad.replace(bad.find(" 3 4 -1"), 7, " 3 5 -1"), "refers to vertex 5 of 5");
  bad = text;
  expect_refused("a.ply", bad.replace(bad.find(" 3 4 -1"), 7, " 3 4 -2"), "refers to vertex -2 of 5");
}

TEST_F(ReadMesh, OffAsTheyAreFound) {
  const std::string rows = "0 0 0\n1.25 0 0\n1.25 1 0\n0 1 -.5\n", faces = "3 0 1 2\n3 0 2 3\n";
  expect_square(read_mesh(write("a.off", "OFF4 2 0\n" + rows + faces)));
  expect_square(read_mesh(write("a.off", "OFF # by hand\n4 2 # no edges\n" + rows + "  \n\t\n" + faces)));
  expect_square(
      read_mesh(write("a.off", "OFF 4 2 0\n0 0 0 # first\n1.25 0 0\n1.25 1 0\n0 1 -.5\n3 0 1 2 # first\n3 0 2 3#")));
  expect_square(read_mesh(write("a.off", "OFF\r\n4 2 0\r\n" + rows + "3 0 1 2 255 0 0\r\n3 0 2 3 0.5 0.5 0.5 1\r\n")));
  expect_square(read_mesh(write("a.off",
                                "STCNOFF\n4 2 0\n0 0 0 0 0 1 9 9 9 .5 .5\n1.25 0 0 0 0 1 .5 .5\n1.25 1 0 0 0 1 9 9 9 9 "
                                ".5 .5\n0 1 -.5 0 0 1 9 .5 .5\n" +
                                    faces)));
  // Empty faces, points and edges are skipped.
  expect_square(read_mesh(write("a.off", "OFF\n4 5 0\n" + rows + "0\n1 2\n3 0 1 2\n2 0 1\n3 0 2 3\n")));
  expect_square(
      read_mesh(write("a.obj", "v 0 0 0\nv 1.25 0 0\nv 1.25 1 0\nv 0 1 -.5\nf 1\nf 1 2 3\nf 2 3\nf\nf 1 3 4\n")));
  for (const char* word : {"4OFF", "nOFF", "4nOFF"})
    expect_refused("a.off", std::string(word) + "\n4 2 0\n" + rows + faces, "save it with three coordinates");
}

// The diagonals of quads are those that MeshLab chooses.
TEST_F(ReadMesh, OffQuadsAsVcglib) {
  std::string text = "OFF\n60 42 0\n";
  Random random(3);
  for (int i = 0; i < 60; ++i)
    text += std::to_string(i / 10 + draw_unit(random)) + " " + std::to_string(i % 10 + draw_unit(random)) + " " +
            std::to_string(draw_unit(random)) + "\n";
  for (int i = 0; i < 42; ++i) {
    const int v = i % 9 + 10 * (i / 9);
    if (i == 41)  // on the diagonals of another
      text += "4 0 10 11 1\n";
    else
      text += "4 " + std::to_string(v) + " " + std::to_string(v + 10) + " " + std::to_string(v + 11) + " " +
              std::to_string(v + 1) + "\n";
  }
  const TriangleMesh mesh = read_mesh(write("a.off", text));
  FileMesh m;
  int mask = 0;
  ASSERT_EQ(vcg::tri::io::ImporterOFF<FileMesh>::Open(m, path("a.off").c_str(), mask), 0);
  EXPECT_EQ(mesh.triangle, to_triangle_mesh(m).triangle);
  const auto starts_anew = [&](int f) { return mesh.triangle[6 * f] != f % 9 + 10 * (f / 9); };
  int turned = 0;
  for (int f = 0; f < 41; ++f) turned += starts_anew(f);
  EXPECT_GT(turned, 5) << "no choice was made";
}

TEST_F(ReadMesh, PolygonsBecomeTriangles) {
  // A regular polygon of 200 corners, with a little height so that no two corners are alike.
  constexpr int kCorners = 200;
  std::string vertices, corners, obj;
  for (int i = 0; i < kCorners; ++i) {
    const std::string v = std::to_string(std::cos(2 * M_PI * i / kCorners)) + " " +
                          std::to_string(std::sin(2 * M_PI * i / kCorners)) + " " + std::to_string(i) + "\n";
    vertices += v;
    obj += "v " + v;
    corners += " " + std::to_string(i);
  }
  obj += "f";
  for (int i = 1; i <= kCorners; ++i) obj += " " + std::to_string(i);
  const std::string n = std::to_string(kCorners);
  write("a.off", "OFF\n" + n + " 1 0\n" + vertices + n + corners + "\n");
  write("a.ply", "ply\nformat ascii 1.0\nelement vertex " + n +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                     "property list uchar int vertex_index\nend_header\n" +
                     vertices + n + corners + "\n");
  write("a.obj", obj);
  for (const char* name : {"a.off", "a.ply", "a.obj"}) {
    const TriangleMesh mesh = read_mesh(path(name));
    ASSERT_EQ(mesh.vertices(), kCorners) << name;
    ASSERT_EQ(mesh.triangles(), kCorners - 2) << name;
    for (int i = 0; i < kCorners - 2; ++i)
      for (int k = 0; k < 3; ++k) ASSERT_EQ(mesh.triangle[3 * i + k], k == 0 ? 0 : i + k) << name;
  }
}

TEST_F(ReadMesh, WhatMeshLabWrites) {
  using namespace vcg::tri::io;
  const TriangleMesh mesh = shapes::shuffled(shapes::body(), 5);
  FileMesh m;
  to_vcglib(mesh, m);
  m.vert[3].SetS();
  constexpr int kAll = Mask::IOM_VERTCOLOR | Mask::IOM_VERTQUALITY | Mask::IOM_VERTNORMAL | Mask::IOM_VERTFLAGS |
                       Mask::IOM_FACECOLOR | Mask::IOM_FACEFLAGS;
  ExporterPLY<FileMesh>::Save(m, path("text.ply").c_str(), kAll, false);
  ExporterPLY<FileMesh>::Save(m, path("binary.ply").c_str(), kAll, true);
  ExporterPLY<FileMesh>::Save(m, path("camera.ply").c_str(), Mask::IOM_CAMERA, true);
  ExporterOFF<FileMesh>::Save(m, path("plain.off").c_str(), 0);
  for (const char* name : {"text.ply", "binary.ply", "camera.ply", "plain.off"}) {
    const TriangleMesh found = read_mesh(path(name));
    EXPECT_EQ(found.triangle, mesh.triangle) << name;
    ASSERT_EQ(found.position.size(), mesh.position.size()) << name;
    for (std::size_t i = 0; i < mesh.position.size(); ++i)
      ASSERT_NEAR(found.position[i], mesh.position[i], 1e-6 * std::max(1.0, std::abs(mesh.position[i]))) << name;
  }
}

TEST_F(ReadMesh, StlCornersAreMerged) {
  using Exporter = vcg::tri::io::ExporterSTL<FileMesh>;
  const TriangleMesh mesh = shapes::body();
  FileMesh m;
  to_vcglib(mesh, m);
  Exporter::Save(m, path("text.stl").c_str(), false);
  Exporter::Save(m, path("binary.stl").c_str(), true);
  std::string padded = read(path("binary.stl"));
  padded.replace(0, 80, std::string(80, ' '));  // a header without a zero
  write("padded.stl", padded + "more");
  for (const char* name : {"text.stl", "binary.stl", "padded.stl"}) {
    const TriangleMesh found = read_mesh(path(name));
    EXPECT_EQ(found.vertices(), mesh.vertices()) << name;
    ASSERT_EQ(found.triangle.size(), mesh.triangle.size()) << name;
    for (std::size_t c = 0; c < mesh.triangle.size(); ++c)
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(found.position[3 * found.triangle[c] + k], mesh.position[3 * mesh.triangle[c] + k], 1e-5) << name;
  }
}

TEST_F(ReadMesh, RefusesWhatIsNoMesh) {
  EXPECT_THROW(read_mesh(path("missing.off")), FileError);
  fs::create_directory(path("folder.ply"));
  EXPECT_THROW(read_mesh(path("folder.ply")), FileError);
  EXPECT_THROW(read_mesh(""), FileError);
  expect_refused("mesh.xyz", "0 0 0\n", "must end in");
  for (const char* name : {"a.off", "a.ply", "a.obj", "a.stl"}) {
    expect_refused(name, "", "empty");
    expect_refused(name, std::string(500, '\0'), "");
    expect_refused(name, "this is not a mesh at all\n", "");
    std::string noise;
    Random random(1);
    for (int i = 0; i < 5000; ++i) noise += static_cast<char>(draw_below(random, 256));
    expect_refused(name, noise, "");
  }
}

TEST_F(ReadMesh, RefusesBadOff) {
  expect_refused("a.off", "OFF\n4000000000 1 0\n", "not an integer");
  expect_refused("a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n", "more than the file can hold");
  expect_refused("a.off", "OFF\n-4 2 0\n0 0 0\n", "negative");
  expect_refused("a.off", "OFF\n4\n2\n", "are missing");
  expect_refused("a.off", "4OFF\n4 2 0\n", "not supported");
  expect_refused("a.off", "OFF BINARY\n4 2 0\n", "save it as text");
  expect_refused("a.off", "OFFSHORE\n4 2 0\n", "word OFF");
  const std::string vertices = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  expect_refused("a.off", vertices, "face 0 of 2");
  expect_refused("a.off", vertices + "3 0 1 2\n", "face 1 of 2");
  expect_refused("a.off", vertices + "3 0 1 2\n3 0 1", "line 8");
  expect_refused("a.off", vertices + "3 0 1 2\n3 0 1 4\n", "line 8: a face refers to vertex 4 of 4");
  expect_refused("a.off", vertices + "3 0 1 2\n3 0 1 -1\n", "vertex -1");
  expect_refused("a.off", vertices + "3 0 1 2\n-1 0 1\n", "line 8: a face of -1 vertices");
  expect_refused("a.off", vertices + "2 0 4\n3 0 1 2\n", "line 7: a face refers to vertex 4 of 4");
  expect_refused("a.off", vertices + "3 0 1 2\n2000000000 0 1\n", "line 8");
  expect_refused("a.off", "OFF\n4 2 0\n0 0 0\n1 x 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
                 "line 4: \"x\" is not a number");
}

TEST_F(ReadMesh, RefusesBadObj) {
  expect_refused("a.obj", "v 0 0\nf 1 1 1\n", "three coordinates");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", "line 4: \"4\"");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n", "\"0\"");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -4 1 2\n", "\"-4\"");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 5\n", "line 4: \"5\"");
  expect_refused("a.obj", "v 0 0 1,5\n", "not a coordinate");
}

TEST_F(ReadMesh, RefusesBadPly) {
  const auto ply = [](const std::string& format, const std::string& vertices, const std::string& list) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list " + list +
           "\nend_header\n";
  };
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n";
  const std::string text = ply("ascii", "3", "uchar int vertex_indices") + points;
  EXPECT_EQ(read_mesh(write("good.ply", text + "3 0 1 2\n")).triangles(), 1);
  expect_refused("a.ply", text, "ends early");
  expect_refused("a.ply", text + "3 0 1", "ends early");
  expect_refused("a.ply", text + "3 0 1 3\n", "refers to vertex 3 of 3");
  expect_refused("a.ply", text + "4 0 1 2 7\n", "refers to vertex 7 of 3");
  EXPECT_EQ(read_mesh(write("a.ply", text + "2 0 1\n")).triangles(), 0);
  expect_refused("a.ply", text + "3 0 1 x\n", "line 13: \"x\"");
  expect_refused("a.ply", ply("ascii", "2000000000", "uchar int vertex_indices") + points,
                 "more than the file can hold");
  expect_refused("a.ply", ply("ascii", "-3", "uchar int vertex_indices") + points, "\"-3\"");
  expect_refused("a.ply", ply("ascii", "", "uchar int vertex_indices") + points, "not understood");
  expect_refused("a.ply", ply("morse", "3", "uchar int vertex_indices") + points, "\"morse\"");
  expect_refused("a.ply", ply("ascii", "3", "uchar quad vertex_indices") + points, "\"quad\"");
  expect_refused("a.ply", ply("ascii", "3", "uchar float vertex_indices") + points + "3 0 1 2\n", "of integers");
  expect_refused("a.ply", ply("ascii", "3", "uchar int corners") + points + "3 0 1 2\n", "vertex_indices");
  expect_refused("a.ply", ply("binary_little_endian", "3", "uchar int vertex_indices") + "123456789",
                 "more than the file can hold");
  expect_refused(
      "a.ply", ply("binary_little_endian", "3", "int int vertex_indices") + std::string(36, '\0') + "\xff\xff\xff\x7f",
      "ends early");
  expect_refused("a.ply", text.substr(0, 40), "within its header");
  expect_refused("a.ply", "ply\nformat ascii 1.0\ncomment " + std::string(5000, 'x') + "\nend_header\n", "no element");
  expect_refused("a.ply",
                 "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 0 0\n",
                 "before its vertices");
}

TEST_F(ReadMesh, RefusesBadStl) {
  FileMesh m;
  to_vcglib(shapes::sphere(), m);
  vcg::tri::io::ExporterSTL<FileMesh>::Save(m, path("text.stl").c_str(), false);
  vcg::tri::io::ExporterSTL<FileMesh>::Save(m, path("binary.stl").c_str(), true);
  const std::string text = read(path("text.stl")), binary = read(path("binary.stl"));
  expect_refused("a.stl", text.substr(0, text.size() / 2), "");
  expect_refused("a.stl", binary.substr(0, binary.size() / 2), "promises");
  expect_refused("a.stl", "solid nothing", "within a solid");
  expect_refused("a.stl", "solid nothing\nendsolid nothing\n", "no triangles");
  std::string bad = binary;
  for (std::size_t i = 0; i < 4; ++i) bad[84 + 12 + i] = static_cast<char>(0xff);
  expect_refused("a.stl", bad, "not finite");
}

// Everything a result can hold, of numbers that need all their digits.
Result made_up(const TriangleMesh& mesh) {
  Result r;
  Random random(1);
  for (int v = 0; v < mesh.vertices(); ++v) {
    r.partners.partner.push_back(v % 7 ? mesh.vertices() - 1 - v : -1);
    r.partners.fitness.push_back(v % 5 ? draw_unit(random) / 3 : 0);
    r.partners.side.push_back(v % 3 - 1);
    r.partner_point.push_back({{v, 0, 1}, {0.25, 0.25, 0.5}});
  }
  r.partners.fitness[1] = 1e-17;
  r.order = 2;
  r.pairs = {{1, 2, 0.1}, {3, 4, 1.0 / 3}};
  r.axis = {{{{0, 1, 2}, {1, 0, 0}}, {{0, 1, 2}, {0.5, 0.5, 0}}}};
  r.symmetries = {{SymmetryKind::reflection, 2, 1, 0.125}, {SymmetryKind::rotation, 3, 2, 0.25}};
  r.confidence = 0.75;
  r.axis_references = {5, 6};
  r.pair_references = {{{7, 8}}};
  r.mean_fitness = 0.1;
  r.matched = 42;
  r.log = {{1, 0.5, 0.75, 1}, {2, 0.25, 0.5, 0.5}};
  r.stop = StopReason::converged;
  r.seconds = {{"search", 1.5}};
  r.warnings = {"a \"warning\", with a comma"};
  r.seed = 18446744073709551615u;
  return r;
}

TEST_F(WriteResult, CsvContract) {
  const TriangleMesh mesh = shapes::sphere();
  const Result result = made_up(mesh);
  write_result(path("a.csv"), mesh, result);
  std::ifstream in(path("a.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(in, line));
  EXPECT_EQ(line, "vertex,partner,fitness,side");
  for (int v = 0; v < mesh.vertices(); ++v) {
    ASSERT_TRUE(std::getline(in, line));
    int vertex, partner, side;
    double fitness;
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%d,%lf,%d", &vertex, &partner, &fitness, &side), 4) << line;
    EXPECT_EQ(vertex, v);
    EXPECT_EQ(partner, result.partners.partner[v]);
    EXPECT_EQ(fitness, result.partners.fitness[v]) << "not the same double: " << line;
    EXPECT_EQ(side, result.partners.side[v]);
  }
  EXPECT_FALSE(std::getline(in, line)) << "one row too many";
  const Partners back = read_partners(path("a.csv"), mesh);
  EXPECT_EQ(back.partner, result.partners.partner);
  EXPECT_EQ(back.fitness, result.partners.fitness);
  EXPECT_EQ(back.side, result.partners.side);
}

TEST_F(WriteResult, JsonIsReadBackOntoItsMeshOnly) {
  TriangleMesh mesh = shapes::sphere();
  const Result result = made_up(mesh);
  write_result(path("a.json"), mesh, result);
  const Partners back = read_partners(path("a.json"), mesh);
  EXPECT_EQ(back.partner, result.partners.partner);
  EXPECT_EQ(back.fitness, result.partners.fitness);
  EXPECT_EQ(back.side, result.partners.side);
  const auto refusal = [&](const std::string& file, const TriangleMesh& other) {
    try {
      read_partners(path(file), other);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const char* partner : {"-2", "0.5", "1e99", "4294967296", "18446744073709551615", "true"}) {
    std::string changed = read(path("a.json"));
    const std::size_t first = changed.find("\"partner\":[") + 11;
    changed.replace(first, changed.find(',', first) - first, partner);
    const std::string why = refusal(fs::path(write("c.json", changed)).filename(), mesh);
    EXPECT_NE(why.find("its partner of vertex 0 is out of range"), std::string::npos) << partner << ": " << why;
  }
  const std::string larger = refusal("a.json", shapes::sphere(12, 16));
  EXPECT_NE(larger.find("178 vertices"), std::string::npos) << larger;
  mesh.position[4] += 0.01;
  EXPECT_NE(refusal("a.json", mesh).find("checksum"), std::string::npos);
  const std::string whole = read(path("a.json"));
  for (const std::string& text : {std::string("{}"), std::string("[1]"), std::string("{"), whole.substr(0, 300)})
    EXPECT_NE(refusal(fs::path(write("b.json", text)).filename(), mesh), "accepted") << text;
}

TEST_F(WriteResult, JsonHoldsEverythingButSeconds) {
  const TriangleMesh mesh = shapes::sphere();
  Result result = made_up(mesh);
  write_result(path("a.json"), mesh, result);
  const auto json = nlohmann::json::parse(read(path("a.json")));
  EXPECT_EQ(json["format"], "ga_symmetry result");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["mesh"]["vertices"], mesh.vertices());
  EXPECT_EQ(json["mesh"]["triangles"], mesh.triangles());
  EXPECT_EQ(json["kind"], to_string(result.kind));
  EXPECT_EQ(json["stop"], to_string(result.stop));
  EXPECT_EQ(json["seed"], result.seed);
  EXPECT_EQ(json["matched"], 42);
  EXPECT_EQ(json["confidence"], 0.75);
  EXPECT_EQ(json["partner"].get<std::vector<int>>(), result.partners.partner);
  EXPECT_EQ(json["fitness"].get<std::vector<double>>(), result.partners.fitness);
  EXPECT_EQ(json["side"].get<std::vector<int>>(), result.partners.side);
  EXPECT_EQ(json["partner_point"][3], nlohmann::json({3, 0, 1, 0.25, 0.25, 0.5}));
  EXPECT_EQ(json["pairs"][1]["fitness"], 1.0 / 3);
  EXPECT_EQ(json["axis"][0][1], nlohmann::json({0, 1, 2, 0.5, 0.5, 0.0}));
  EXPECT_EQ(json["symmetries"][1]["order"], 3);
  EXPECT_EQ(json["log"][1]["diversity"], 0.5);
  EXPECT_EQ(json["axis_references"], nlohmann::json({5, 6}));
  EXPECT_EQ(json["pair_references"][0], nlohmann::json({7, 8}));
  EXPECT_EQ(json["warnings"][0], result.warnings[0]);
  result.seconds[0].seconds = 99;
  write_result(path("b.json"), mesh, result);
  EXPECT_EQ(read(path("a.json")), read(path("b.json"))) << "equal runs must give equal bytes";
}

TEST_F(WriteResult, ChecksumTellsMeshesApart) {
  const TriangleMesh mesh = shapes::sphere();
  TriangleMesh single = mesh;  // as a program that holds floats would have it
  for (double& x : single.position) x = static_cast<float>(x);
  EXPECT_EQ(mesh_checksum(mesh), mesh_checksum(single));
  TriangleMesh moved = mesh, turned = mesh;
  moved.position[5] += 1e-3;
  std::rotate(turned.triangle.begin(), turned.triangle.begin() + 1, turned.triangle.begin() + 3);
  EXPECT_NE(mesh_checksum(mesh), mesh_checksum(moved));
  EXPECT_NE(mesh_checksum(mesh), mesh_checksum(turned));
  EXPECT_NE(mesh_checksum(mesh), mesh_checksum(shapes::shuffled(mesh, 1)));
  // FNV-1a 64 of sixteen zero bytes, from its definition.
  std::uint64_t hash = 14695981039346656037u;
  for (int i = 0; i < 16; ++i) hash *= 1099511628211u;
  EXPECT_EQ(mesh_checksum({}), hash);
}

TEST_F(WriteResult, PlyIsReadByVcglib) {
  const TriangleMesh mesh = shapes::body();
  const Result result = made_up(mesh);
  write_result(path("a.ply"), mesh, result);
  const TriangleMesh again = read_mesh(path("a.ply"));
  EXPECT_EQ(again.position, mesh.position);
  EXPECT_EQ(again.triangle, mesh.triangle);

  FileMesh m;
  int mask = 0;
  ASSERT_EQ(vcg::tri::io::ImporterPLY<FileMesh>::Open(m, path("a.ply").c_str(), mask), 0);
  EXPECT_TRUE(mask & vcg::tri::io::Mask::IOM_VERTQUALITY);
  EXPECT_TRUE(mask & vcg::tri::io::Mask::IOM_VERTCOLOR);
  for (int v = 0; v < mesh.vertices(); ++v) {
    ASSERT_EQ(m.vert[v].cQ(), static_cast<float>(result.partners.fitness[v]));
    const vcg::Color4b color = m.vert[v].cC();
    const Color same = fitness_color(result.partners.fitness[v]);
    EXPECT_EQ(color, vcg::Color4b(same[0], same[1], same[2], 255)) << v;
  }
  const std::string text = read(path("a.ply"));
  const std::size_t end = text.find("end_header\n") + std::strlen("end_header\n");
  const std::string header = text.substr(0, end);
  const std::size_t at = header.find("property double quality\n");
  ASSERT_NE(at, header.npos) << header;
  ASSERT_EQ(
      header.substr(at + std::strlen("property double quality\n"), 90)
          .rfind("property float symmetry_partner\nproperty float symmetry_fitness\nproperty float symmetry_si", 0),
      0u)
      << header;
  constexpr std::size_t kRow = 3 * 8 + 4 + 8 + 3 * 4;
  for (int v = 0; v < mesh.vertices(); ++v) {
    float attributes[3];
    std::memcpy(attributes, text.data() + end + kRow * (v + 1) - sizeof attributes, sizeof attributes);
    ASSERT_EQ(attributes[0], result.partners.partner[v]);
    ASSERT_EQ(attributes[1], static_cast<float>(result.partners.fitness[v]));
    ASSERT_EQ(attributes[2], result.partners.side[v]);
  }
}

TEST_F(WriteResult, PerfectFitnessIsBlue) {
  const TriangleMesh mesh = shapes::sphere();
  Result result = made_up(mesh);
  std::fill(result.partners.fitness.begin(), result.partners.fitness.end(), 0.0);
  write_result(path("a.ply"), mesh, result);
  FileMesh m;
  int mask = 0;
  ASSERT_EQ(vcg::tri::io::ImporterPLY<FileMesh>::Open(m, path("a.ply").c_str(), mask), 0);
  for (const FileVertex& v : m.vert) ASSERT_EQ(v.cC(), vcg::Color4b(vcg::Color4b::Blue));
  std::fill(result.partners.partner.begin(), result.partners.partner.end(), -1);
  EXPECT_NO_THROW(write_result(path("a.ply"), mesh, result));
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(WriteResult, SameBytesInEveryLocale) {
  const TriangleMesh mesh = shapes::body();
  const Result result = made_up(mesh);
  const std::vector<std::string> endings{".csv", ".json", ".ply"};
  for (const std::string& ending : endings) write_result(path("a" + ending), mesh, result);
  const std::locale old = std::locale::global(std::locale(std::locale(), new CommaPoint));
  // NOLINTBEGIN(concurrency-mt-unsafe): no other thread runs
  const std::string old_c = setlocale(LC_ALL, nullptr);
  setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  for (const std::string& ending : endings) write_result(path("b" + ending), mesh, result);
  setlocale(LC_ALL, old_c.c_str());
  // NOLINTEND(concurrency-mt-unsafe)
  std::locale::global(old);
  for (const std::string& ending : endings) EXPECT_EQ(read(path("a" + ending)), read(path("b" + ending))) << ending;
}

TEST_F(WriteResult, RefusesBadPathsBeforeTheWork) {
  for (const char* name : {"", "a", "a.txt", "csv", "a.csv.gz", ".csv"}) {
    EXPECT_THROW(check_result_path(*name ? path(name) : ""), InvalidOption) << name;
    EXPECT_THROW(write_result(*name ? path(name) : "", shapes::sphere(), made_up(shapes::sphere())), InvalidOption)
        << name;
  }
  EXPECT_THROW(check_result_path(path("missing/a.csv")), FileError);
  fs::create_directory(path("folder.csv"));
  EXPECT_THROW(check_result_path(path("folder.csv")), FileError);
  write("file", "");
  EXPECT_THROW(check_result_path(path("file/a.csv")), FileError);
  EXPECT_THROW(check_result_path(path(std::string(300, 'x') + ".csv")), FileError);
  EXPECT_NO_THROW(check_result_path(path("a.CSV")));
  EXPECT_EQ(names(), (std::vector<std::string>{"file", "folder.csv"})) << "a check must leave nothing behind";
}

TEST_F(WriteResult, RefusesTheResultOfAnotherMesh) {
  const TriangleMesh mesh = shapes::sphere();
  EXPECT_THROW(write_result(path("a.csv"), shapes::body(), made_up(mesh)), InvalidOption);
  EXPECT_TRUE(names().empty());
}

TEST_F(WriteResult, ReplacesAndFollowsLinks) {
  const TriangleMesh mesh = shapes::sphere();
  write("a.csv", "old");
  fs::create_symlink("a.csv", path("link.csv"));
  write_result(path("link.csv"), mesh, made_up(mesh));
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_EQ(read_partners(path("a.csv"), mesh).partner.size(), static_cast<std::size_t>(mesh.vertices()));
  EXPECT_EQ(names(), (std::vector<std::string>{"a.csv", "link.csv"}));
}

TEST_F(WriteResult, AllOfSeveralOrNone) {
  const TriangleMesh mesh = shapes::sphere();
  write("a.csv", "old");
  EXPECT_THROW(write_results({path("a.csv"), path("b.json"), path("missing/c.ply")}, mesh, made_up(mesh)), FileError);
  EXPECT_EQ(read(path("a.csv")), "old");
  EXPECT_EQ(names(), (std::vector<std::string>{"a.csv"}));
  write_results({path("a.csv"), path("b.json"), path("c.ply")}, mesh, made_up(mesh));
  EXPECT_EQ(names(), (std::vector<std::string>{"a.csv", "b.json", "c.ply"}));
}

// Root may write everywhere; as long as this lives, one is not root.
class NotRoot {
 public:
  NotRoot() : was_root_(geteuid() == 0) {
    constexpr uid_t kNobody = 65534;
    if (was_root_) {
      EXPECT_EQ(seteuid(kNobody), 0);
    }
  }
  NotRoot(const NotRoot&) = delete;
  ~NotRoot() {
    if (was_root_) {
      EXPECT_EQ(seteuid(0), 0);
    }
  }

 private:
  bool was_root_;
};

TEST_F(WriteResult, ReadOnlyFolder) {
  write("a.csv", "old");
  fs::permissions(folder_, fs::perms{0555});
  {
    const NotRoot user;
    for (const char* name : {"a.csv", "b.json"}) {
      EXPECT_THROW(check_result_path(path(name)), FileError);
      EXPECT_THROW(write_result(path(name), shapes::sphere(), made_up(shapes::sphere())), FileError);
    }
  }
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_EQ(read(path("a.csv")), "old");
  EXPECT_EQ(names(), (std::vector<std::string>{"a.csv"}));
}

// A small file system of its own, where the test may mount one.
class SmallDisk : public Files {
 protected:
  void SetUp() override {
    Files::SetUp();
    mounted_ = geteuid() == 0 && mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted_) GTEST_SKIP() << "only root can mount a small file system";
  }
  void TearDown() override {
    if (mounted_) umount(folder_.c_str());
    Files::TearDown();
  }
  bool mounted_ = false;
};

TEST_F(SmallDisk, FullDiskLeavesTheOldFile) {
  const TriangleMesh mesh = shapes::globe(50, 60, [](double&, double&, double&) {});  // more than 64 kB in each format
  for (const char* name : {"a.csv", "a.json", "a.ply"}) {
    write(name, "old");
    EXPECT_NO_THROW(check_result_path(path(name)));
    EXPECT_THROW(write_result(path(name), mesh, made_up(mesh)), FileError) << name;
    EXPECT_EQ(read(path(name)), "old");
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"a.csv", "a.json", "a.ply"}));
}

TEST_F(SmallDisk, TheLastByteDoesNotFit) {
  const TriangleMesh mesh = shapes::sphere();
  for (const char* name : {"a.csv", "a.json", "a.ply"}) {
    write_result(path(name), mesh, made_up(mesh));
    const std::uintmax_t size = fs::file_size(path(name));
    write(name, "old");
    struct statvfs disk {};
    ASSERT_EQ(statvfs(folder_.c_str(), &disk), 0);
    const std::uintmax_t needed = (size + disk.f_bsize - 1) / disk.f_bsize;
    ASSERT_GE(disk.f_bfree, needed);
    write("filler", std::string((disk.f_bfree - needed + 1) * disk.f_bsize, 'x'));  // one block too few is left
    EXPECT_THROW(write_result(path(name), mesh, made_up(mesh)), FileError) << name;
    EXPECT_EQ(read(path(name)), "old");
    fs::remove(path("filler"));
    EXPECT_NO_THROW(write_result(path(name), mesh, made_up(mesh))) << name;
    fs::remove(path(name));
  }
}

TEST_F(SmallDisk, ReadOnlyDisk) {
  write("a.csv", "old");
  ASSERT_EQ(mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
  EXPECT_THROW(check_result_path(path("a.csv")), FileError);
  EXPECT_THROW(write_result(path("a.csv"), shapes::sphere(), made_up(shapes::sphere())), FileError);
  EXPECT_EQ(read(path("a.csv")), "old");
}

TEST_F(Evaluate, TruthItselfIsPerfect) {
  const TriangleMesh mesh = shapes::sphere(15, 16);
  Truth truth;
  std::vector<int> partner;
  // The mirror image through the plane of the first meridian: segment j becomes -j.
  for (int v = 0; v < mesh.vertices(); ++v) {
    const int j = v % 16, ring = v / 16;
    partner.push_back(v < 15 * 16 ? ring * 16 + (16 - j) % 16 : v);
    truth.push_back({v, partner.back()});
  }
  const Evaluation all = evaluate_partners(mesh, truth, partner);
  EXPECT_EQ(all.mean, 0);
  EXPECT_EQ(all.corr, 1);
  EXPECT_EQ(all.coverage, 1);
  EXPECT_EQ(all.involution, 1);
  EXPECT_EQ(all.lines, truth.size());

  const Evaluation none = evaluate_partners(mesh, truth, std::vector<int>(partner.size(), -1));
  EXPECT_EQ(none.mean, 1);
  EXPECT_EQ(none.corr, 0);
  EXPECT_EQ(none.coverage, 0);
  EXPECT_EQ(none.involution, 0);

  // Everyone's partner is the north pole: errors are polar angles over sqrt(4 pi), on average about pi/2.
  const std::vector<int> pole(partner.size(), 15 * 16);
  const Evaluation one = evaluate_partners(mesh, truth, pole);
  EXPECT_NEAR(one.mean, M_PI / 2 / std::sqrt(4 * M_PI), 0.02);
  const Evaluation threads = evaluate_partners(mesh, truth, pole, 3);
  EXPECT_EQ(one.mean, threads.mean);
  EXPECT_THROW(evaluate_partners(mesh, {}, partner), InvalidOption);
  EXPECT_THROW(evaluate_partners(mesh, {{0, 9999}}, partner), InvalidOption);
  EXPECT_THROW(evaluate_partners(mesh, truth, {0, 1}), InvalidOption);
  partner[3] = mesh.vertices();
  EXPECT_THROW(evaluate_partners(mesh, truth, partner), InvalidOption);
}

TEST_F(Evaluate, ReadsTruthAndPartners) {
  EXPECT_EQ(read_truth(write("t", "0 2\r\n\n1\t1\n2 0")), (Truth{{0, 2}, {1, 1}, {2, 0}}));
  for (const char* bad : {"0\n", "0 1 2\n", "a b\n", "0 1.5\n"}) EXPECT_THROW(read_truth(write("t", bad)), FileError);
  EXPECT_THROW(read_truth(path("missing")), FileError);
}

TEST_F(Evaluate, ReadsPartnersAndTables) {
  const auto points = [](int n) { return TriangleMesh{std::vector<double>(3 * n), {}}; };
  const Partners some = read_partners(write("p", "vertex,partner,fitness\n0,2,.5\n2,0,.5\n1,-1,0\n"), points(3));
  EXPECT_EQ(some.partner, (std::vector<int>{2, -1, 0}));
  EXPECT_EQ(some.fitness, (std::vector<double>{.5, 0, .5}));
  EXPECT_TRUE(some.side.empty());
  EXPECT_EQ(read_partners(write("p", "fitness, partner, name, vertex\r\n0,1,a,0\r\n0,0,b,1\r\n"), points(2)).partner,
            (std::vector<int>{1, 0}));
  for (const char* bad :
       {"vertex,other\n0,1\n1,0\n", "vertex,partner\n0,1\n", "vertex,partner\n0,1\n0,1\n", "vertex,partner\n0,1\n1,2\n",
        "vertex,partner\n0,1\n1\n", "vertex,partner\n0,1\n1,x\n", "vertex,partner\n0,1\n1,0.5\n",
        "vertex,partner,side\n0,1,0\n1,0,2\n", "vertex,partner,fitness\n0,1,0\n1,0,-1\n",
        "vertex,partner,fitness\n0,1,0\n1,0,nan\n", "partner\n1\n0\n", ""})
    EXPECT_THROW(read_partners(write("p", bad), points(2)), FileError) << bad;

  const ValueTable table = read_value_table(write("t", "w,vertex,u\n1,1,-2e3\n0.25,0,4\n"), 2);
  EXPECT_EQ(table.names, (std::vector<std::string>{"w", "u"}));
  EXPECT_EQ(table.columns, (std::vector<std::vector<double>>{{.25, 1}, {4, -2000}}));
  EXPECT_THROW(read_value_table(write("t", "vertex,w\n0,1\n1,x\n"), 2), FileError);
  EXPECT_THROW(read_value_table(write("t", "vertex,w\n0,1\n2,1\n"), 2), FileError);
}

TEST_F(Evaluate, TruthOfMeasuredMeshes) {
  const fs::path mesh = fs::path(GA_SYMMETRY_SHARED) / "dev_meshes" / "wolf1.off";
  if (!fs::exists(mesh)) GTEST_SKIP() << "there are no measured meshes beside the repository";
  const TriangleMesh wolf = read_mesh(mesh.string());
  fs::path truth_path = mesh;
  const Truth truth = read_truth(truth_path.replace_extension(".truth").string());
  std::vector<int> partner(static_cast<std::size_t>(wolf.vertices()), -1);
  for (const auto& [v, w] : truth) partner[v] = w;
  Truth some;
  for (std::size_t i = 0; i < truth.size(); i += 40) some.push_back(truth[i]);
  const Evaluation e = evaluate_partners(wolf, some, partner);
  EXPECT_LT(e.mean, 0.01);
  EXPECT_GT(e.corr, 0.99);
}

}  // namespace
}  // namespace ga_symmetry
