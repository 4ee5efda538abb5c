// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sew.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace ga_symmetry
