// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "damage_kit.h"
#include "surface/search_surface.h"
#include "surface/welded_mesh.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

int border_edges(const Surface& s) { return static_cast<int>(std::count(s.opposite.begin(), s.opposite.end(), -1)); }

// The faces of a torus between two planes across its tube are taken away, on one side: two rims, a gap of so many
// faces.
Surface torus_with_a_gap(int columns) {
  constexpr int kAround = 60, kAlong = 24;
  TriangleMesh m = shapes::torus(kAround, kAlong);
  std::vector<int> kept;
  for (std::size_t f = 0; f < m.triangle.size(); f += 3) {
    const bool gone = std::all_of(&m.triangle[f], &m.triangle[f] + 3, [&](int v) { return v / kAlong <= columns; });
    if (!gone) kept.insert(kept.end(), &m.triangle[f], &m.triangle[f] + 3);
  }
  m.triangle = kept;
  return make_surface(m);
}

TEST(Sew, AGapBetweenTwoRimsIsClosed) {
  const Surface open = torus_with_a_gap(1);
  ASSERT_EQ(border_edges(open), 48);
  Surface sewn;
  EXPECT_EQ(sew(open, 0.2 * open.unit(), sewn, {}), 48);
  EXPECT_EQ(border_edges(sewn), 0);
  EXPECT_TRUE(sewn.closed);
  EXPECT_TRUE(sewn.orientable);
  EXPECT_EQ(sewn.position, open.position);
}

TEST(Sew, PartsThatLieWrongSideUpAreTurned) {
  constexpr int kAround = 60, kAlong = 24;
  TriangleMesh m = shapes::torus(kAround, kAlong);
  std::vector<int> kept;
  for (std::size_t f = 0; f < m.triangle.size(); f += 3) {
    const auto among = [&](int first, int last) {
      return std::all_of(&m.triangle[f], &m.triangle[f] + 3,
                         [&](int v) { return v / kAlong >= first && v / kAlong <= last; });
    };
    if (among(0, 1) || among(30, 31)) continue;
    kept.insert(kept.end(), &m.triangle[f], &m.triangle[f] + 3);
    if (among(1, 30)) std::swap(kept[kept.size() - 1], kept[kept.size() - 2]);
  }
  m.triangle = kept;
  const Surface halves = make_surface(m);
  Surface sewn;
  EXPECT_EQ(sew(halves, 0.2 * halves.unit(), sewn, {}), 96);
  EXPECT_TRUE(sewn.closed);
  EXPECT_TRUE(sewn.orientable);
}

TEST(Sew, TubesThatTouchAreNotJoined) {
  // Two cut tubes side by side: what is above the cut belongs to what is below it.
  constexpr int kAround = 24, kRings = 20, kCut = 10;
  constexpr double kPi = 3.14159265358979323846, kHeight = 0.26;
  TriangleMesh m;
  for (const double x : {-1.002, 1.002}) {
    const int first = m.vertices();
    for (int ring = 0; ring < kRings; ++ring)
      for (int i = 0; i < kAround; ++i) {
        const double t = 2 * kPi * i / kAround;
        m.position.insert(m.position.end(), {x + std::cos(t), std::sin(t), kHeight * ring});
      }
    for (int ring = 0; ring + 1 < kRings; ++ring)
      for (int i = 0; ring != kCut && i < kAround; ++i) {
        const int a = first + ring * kAround + i, b = first + ring * kAround + (i + 1) % kAround;
        m.triangle.insert(m.triangle.end(), {a, b, b + kAround, a, b + kAround, a + kAround});
      }
  }
  const Surface cut = make_surface(m);
  Surface sewn;
  EXPECT_EQ(sew(cut, 0.05 * cut.unit(), sewn, {}), 4 * kAround);
  int parts = 0;
  face_parts(sewn.triangle, sewn.vertices(), parts);
  EXPECT_EQ(parts, 2);
}

TEST(Sew, AHoleOfAFaceIsLeftAlone) {
  // A torus with a gap, and two edges beside the gap a face is missing, too.
  constexpr int kAround = 60, kAlong = 24;
  TriangleMesh m = shapes::torus(kAround, kAlong);
  std::vector<int> kept;
  bool hole = false;
  for (std::size_t f = 0; f < m.triangle.size(); f += 3) {
    const auto among = [&](int first, int last) {
      return std::all_of(&m.triangle[f], &m.triangle[f] + 3,
                         [&](int v) { return v / kAlong >= first && v / kAlong <= last; });
    };
    const bool here = !hole && among(3, 4);
    hole |= here;
    if (!among(0, 1) && !here) kept.insert(kept.end(), &m.triangle[f], &m.triangle[f] + 3);
  }
  m.triangle = kept;
  const Surface open = make_surface(m);
  ASSERT_EQ(border_edges(open), 2 * kAlong + 3);
  Surface sewn;
  EXPECT_EQ(sew(open, 0.4 * open.unit(), sewn, {}), 2 * kAlong);
  EXPECT_EQ(border_edges(sewn), 3);
}

TEST(Sew, NotWhereItIsTooWide) {
  const Surface open = torus_with_a_gap(9);
  Surface sewn;
  EXPECT_EQ(sew(open, 0.05 * open.unit(), sewn, {}), 0);
}

TEST(Sew, ASingleRoundHoleStaysOpen) {
  const Surface open = make_surface(shapes::grid(30, 30));
  Surface sewn;
  EXPECT_EQ(sew(open, 0.05 * open.unit(), sewn, {}), 0);
}

TEST(Sew, ABodyThatIsCutLeadsAsOne) {
  const auto shape = shapes::shuffled(shapes::creature(4), 3);
  for (const char* name : {"narrow_gaps", "gaps"}) {
    const auto kind = std::find_if(damage::kinds().begin(), damage::kinds().end(),
                                   [&](const damage::Kind& k) { return k.name == name; });
    ASSERT_NE(kind, damage::kinds().end());
    const damage::Damaged d = damage::damaged(shape.mesh, shape.partner, *kind, 1);
    const Surface surface = make_surface(d.mesh);
    int parts = 0;
    face_parts(surface.triangle, surface.vertices(), parts);
    ASSERT_GT(parts, 1);
    const SearchSurface search(make_surface(d.mesh), {}, {});
    EXPECT_NE(search.summary().find("sewn gaps"), std::string::npos) << search.summary();
    EXPECT_EQ(search.summary().find("wrapped"), std::string::npos) << search.summary();
  }
}

TEST(Sew, FinsAndDebrisBetweenPartsAreLeftAside) {
  const auto shape = shapes::shuffled(shapes::creature(5), 3);
  Random random(1);
  damage::Damaged d = damage::whole(shape.mesh, shape.partner);
  damage::add_fins(d, 100, random);
  damage::remove_strips(d, 3, random);
  damage::flip_faces(d, 0.2, random);
  damage::finish(d, random);
  const SearchSurface search(make_surface(d.mesh), {}, {});
  EXPECT_NE(search.summary().find("tiny sheets aside"), std::string::npos) << search.summary();
  EXPECT_NE(search.summary().find("sewn gaps"), std::string::npos) << search.summary();
  EXPECT_EQ(search.summary().find("wrapped"), std::string::npos) << search.summary();
}

}  // namespace
}  // namespace ga_symmetry
