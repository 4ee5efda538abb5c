// SPDX-License-Identifier: GPL-3.0-or-later
// References: reading them from text, and telling their roles from a selection.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <string>

#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "shapes.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

TEST(ParseReferences, AllForms) {
  const auto expect = [](const std::string& text, const std::vector<int>& axis, const Pairs& pairs) {
    const References r = parse_references(text);
    EXPECT_EQ(r.axis, axis) << text;
    EXPECT_EQ(r.pairs, pairs) << text;
  };
  expect("", {}, {});
  expect("  ", {}, {});
  expect("5", {5}, {});
  expect("3,8", {3, 8}, {});
  expect("3,8,12,57", {3, 8}, {{12, 57}});
  expect("3,8,12,57,90,4", {3, 8}, {{12, 57}, {90, 4}});
  expect("12:57", {}, {{12, 57}});
  expect("3,12:57", {3}, {{12, 57}});
  expect("3,8,12:57,90:4", {3, 8}, {{12, 57}, {90, 4}});
  expect("12:57,3,8,90:4,0", {3, 8, 0}, {{12, 57}, {90, 4}});
  expect(" 3 , 8,\t12 : 57 ", {3, 8}, {{12, 57}});
  expect("1:2,2:3,3:1", {}, {{1, 2}, {2, 3}, {3, 1}});  // a rotation
  expect("3 8 12 57", {3, 8}, {{12, 57}});
  expect("3 8\t12  57\n", {3, 8}, {{12, 57}});
  expect("3, 8 ,12 57", {3, 8}, {{12, 57}});
  expect("3 8 12:57\r\n90 :4", {3, 8}, {{12, 57}, {90, 4}});
  expect("2147483647", {2147483647}, {});
}

TEST(ParseReferences, RefusesEverythingElse) {
  for (const char* text :
       {",",         "1,",    ",1",   "1,,2",    "a",       "1,2,x,4", "-1",    "1.5",     ", 2",        "1 2 ,",
        "1 , , 2",   "1 2 3", "1 : ", "1 -2",    "1:",      ":1",      "1:2:3", "1;2",     "2147483648", "1,2,3",
        "1,2,3,4,5", "0x10",  "1,1",  "1,2,3,3", "1,2,1,3", "3,3:4",   "4:4",   "1:2,1:3", "1:3,2:3"})
    EXPECT_THROW(parse_references(text), InvalidOption) << text;
  try {
    parse_references("1 2\n3 x\n");
    ADD_FAILURE();
  } catch (const InvalidOption& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

// A body's references and their roles, by construction.
struct Posed {
  TriangleMesh mesh = shapes::body();
  int head = shapes::nearest_vertex(mesh, 0, 0, 2), foot = shapes::nearest_vertex(mesh, 0, -0.5, -3);
  int left = shapes::nearest_vertex(mesh, 2, 0, 0.6), right = shapes::nearest_vertex(mesh, -2, 0, 0.6);
};

TEST(ReferencesFromSelection, AnyOrderOfTheFourAndOfTheVertices) {
  Posed posed;
  std::vector<int> to;
  const TriangleMesh mesh = shapes::shuffled(posed.mesh, 3, &to);
  std::array<int, 4> selected{to[posed.head], to[posed.foot], to[posed.left], to[posed.right]};
  std::sort(selected.begin(), selected.end());
  do {
    const References r = references_from_selection(mesh, selected, {});
    std::vector<int> axis = r.axis;
    ASSERT_EQ(axis.size(), 2u);
    ASSERT_EQ(r.pairs.size(), 1u);
    EXPECT_EQ(axis,
              (std::vector<int>{std::min(to[posed.head], to[posed.foot]), std::max(to[posed.head], to[posed.foot])}));
    EXPECT_EQ(r.pairs[0], (std::array<int, 2>{std::min(to[posed.left], to[posed.right]),
                                              std::max(to[posed.left], to[posed.right])}));
  } while (std::next_permutation(selected.begin(), selected.end()));
}

TEST(ReferencesFromSelection, RefusesAmbiguousSelections) {
  // Four vertices of a square on a sphere: every one of the two diagonals may be the axis.
  const TriangleMesh sphere = shapes::sphere(23, 24);
  const int equator = 11 * 24;
  try {
    references_from_selection(sphere, {equator, equator + 6, equator + 12, equator + 18}, {});
    ADD_FAILURE();
  } catch (const InvalidOption& error) {
    EXPECT_NE(std::string(error.what()).find("can be read"), std::string::npos) << error.what();
  }
}

// Two axis vertices side by side: as a pair they would be exchanged at hardly any cost. The symmetry that is found
// tells.
TEST(ReferencesFromSelection, TheSymmetryThatIsFoundDecides) {
  const shapes::Symmetric shape = shapes::bent(shapes::creature(4), 0.3);
  const std::array<int, 4> selected{460, 1777, 740, 1231};
  ASSERT_EQ(shape.partner[selected[0]], selected[0]);
  ASSERT_EQ(shape.partner[selected[1]], selected[1]);
  ASSERT_EQ(shape.partner[selected[2]], selected[3]);
  const References read = references_from_selection(shape.mesh, selected, {});
  EXPECT_EQ(read.axis, (std::vector<int>{selected[0], selected[1]}));
  EXPECT_EQ(read.pairs, (std::vector<std::array<int, 2>>{{selected[2], selected[3]}}));
}

TEST(ReferencesFromSelection, RefusesRepeatedAndForeignVertices) {
  Posed posed;
  const int n = posed.mesh.vertices();
  Options options;
  options.largest_component = true;
  EXPECT_THROW(references_from_selection(posed.mesh, {posed.head, posed.foot, posed.left, posed.left}, options),
               InvalidOption);
  EXPECT_THROW(references_from_selection(posed.mesh, {posed.head, posed.foot, posed.left, n}, options), InvalidOption);
  EXPECT_THROW(references_from_selection(posed.mesh, {posed.head, posed.foot, posed.left, -1}, options), InvalidOption);
  EXPECT_THROW(references_from_selection({}, {0, 1, 2, 3}, options), InvalidOption);
  TriangleMesh mesh = shapes::joined(posed.mesh, shapes::sphere());
  EXPECT_THROW(references_from_selection(mesh, {posed.head, posed.foot, posed.left, n + 3}, options), InvalidOption);
  EXPECT_NO_THROW(references_from_selection(mesh, {posed.head, posed.foot, posed.left, posed.right}, options));
  mesh.position.insert(mesh.position.end(), {0, 0, 0});
  EXPECT_THROW(references_from_selection(mesh, {posed.head, posed.foot, posed.left, mesh.vertices() - 1}, options),
               InvalidOption);
  mesh.triangle.clear();
  EXPECT_THROW(references_from_selection(mesh, {0, 1, 2, 3}, options), InvalidMesh);
}

// Of a large mesh the surface that the search would use is measured, not all its vertices.
TEST(ReferencesFromSelection, MeasuresTheSurfaceThatIsSearched) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(5), 3);
  const std::array<int, 4> selected{shape.pair[0], shape.axis[1], shape.pair[1], shape.axis[0]};
  std::vector<std::string> stages;
  Context context;
  context.progress = [&](double, const char* stage) { stages.push_back(stage); };
  Options options;
  options.proxy = 1000;
  options.threads = 1;
  const References read = references_from_selection(shape.mesh, selected, options, context);
  EXPECT_EQ(read.axis,
            (std::vector<int>{std::min(shape.axis[0], shape.axis[1]), std::max(shape.axis[0], shape.axis[1])}));
  EXPECT_GT(std::count(stages.begin(), stages.end(), "simplifying"), 0);
  options.threads = 4;
  EXPECT_EQ(references_from_selection(shape.mesh, selected, options).pairs, read.pairs);
}

TEST(ReferencesFromSelection, Cancels) {
  const Posed posed;
  const std::atomic<bool> stop{true};
  EXPECT_THROW(
      references_from_selection(posed.mesh, {posed.head, posed.foot, posed.left, posed.right}, {}, {nullptr, &stop}),
      Cancelled);
}

TEST(ReferencesFromSelection, TellsTheRolesOnPosedAnimalsAndPeople) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(GA_SYMMETRY_SHARED) / "dev_meshes";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "there are no measured meshes beside the repository";
  int meshes = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".off") continue;
    ++meshes;
    fs::path path = entry.path();
    const References known = read_references(path.replace_extension(".refs").string());
    const std::array<int, 4> refs{known.axis[0], known.axis[1], known.pairs[0][0], known.pairs[0][1]};
    const References r =
        references_from_selection(read_mesh(entry.path().string()), {refs[3], refs[0], refs[2], refs[1]}, {});
    EXPECT_EQ(r.axis, (std::vector<int>{std::min(refs[0], refs[1]), std::max(refs[0], refs[1])})) << path;
  }
  EXPECT_GT(meshes, 0);
}

}  // namespace
}  // namespace ga_symmetry
