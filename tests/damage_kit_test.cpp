// SPDX-License-Identifier: GPL-3.0-or-later
// What each damage of the kit promises, and that the search bears it.
#include "damage_kit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <ostream>
#include <set>
#include <string>

#include "ga_symmetry/symmetry.h"
#include "surface/welded_mesh.h"
#include "symmetric_shapes.h"

namespace ga_symmetry::damage {

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

namespace {

using Place = std::array<double, 3>;

const shapes::Symmetric& creature() {
  static const shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(4), 0.1), 3);
  return shape;
}

Place place(const TriangleMesh& mesh, int v) {
  return {mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]};
}

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

int parts(const TriangleMesh& mesh) {
  int count = 0;
  face_parts(mesh.triangle, mesh.vertices(), count);
  return count;
}

// Edges by how many faces are at them.
std::map<int, int> edges_by_faces(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> faces;
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c) {
    const int a = mesh.triangle[c], b = mesh.triangle[c % 3 == 2 ? c - 2 : c + 1];
    ++faces[{std::min(a, b), std::max(a, b)}];
  }
  std::map<int, int> out;
  for (const auto& [edge, count] : faces) ++out[count];
  return out;
}

double area(const TriangleMesh& mesh, int f) {
  const Place a = place(mesh, mesh.triangle[3 * f]), b = place(mesh, mesh.triangle[3 * f + 1]),
              c = place(mesh, mesh.triangle[3 * f + 2]);
  std::array<double, 3> u, v;
  for (int k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
  return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (int f = 0; f < mesh.triangles(); ++f) sum += area(mesh, f);
  return sum;
}

template <class Apply>
Damaged with(const Apply& apply) {
  Random random(5);
  Damaged d = whole(creature().mesh, creature().partner);
  apply(d, random);
  finish(d, random);
  return d;
}

// A vertex of the whole mesh is at all its copies, within `apart`; whoever is new is where it is told to be.
void expect_copies(const Damaged& d, double apart) {
  for (int v = 0; v < d.mesh.vertices(); ++v)
    if (d.origin[v] >= 0) {
      ASSERT_EQ(d.nearest[v], d.origin[v]);
      ASSERT_LE(distance(place(d.mesh, v), place(creature().mesh, d.origin[v])), apart) << v;
    }
}

int new_vertices(const Damaged& d) { return static_cast<int>(std::count(d.origin.begin(), d.origin.end(), -1)); }

constexpr int kVertices = 2562, kFaces = 5120, kEdges = 7680;

TEST(DamageKit, SeamsDoubleVerticesAndMoveNone) {
  const Damaged d = with([](Damaged& x, Random& random) { split_seams(x, 12, random); });
  EXPECT_EQ(parts(d.mesh), 12);
  EXPECT_GT(d.mesh.vertices(), kVertices + 100);
  EXPECT_EQ(edges_by_faces(d.mesh).count(3), 0u);
  expect_copies(d, 0);
  EXPECT_EQ(d.mesh.triangles(), kFaces);
}

TEST(DamageKit, SeamsApartAreNotQuiteAtOnePlace) {
  const Damaged d = with([](Damaged& x, Random& random) { split_seams_apart(x, 12, random); });
  EXPECT_EQ(parts(d.mesh), 12);
  std::set<Place> places;
  for (int v = 0; v < d.mesh.vertices(); ++v) places.insert(place(d.mesh, v));
  EXPECT_EQ(static_cast<int>(places.size()), d.mesh.vertices());
  expect_copies(d, 1e-5);
}

TEST(DamageKit, CutsAreAsWideAsAsked) {
  const Damaged closed = with([](Damaged& x, Random& random) { cut(x, 1, 0, random); });
  EXPECT_GE(parts(closed.mesh), 2);
  expect_copies(closed, 0);
  const Damaged open = with([](Damaged& x, Random& random) { cut(x, 1, 0.2, random); });
  EXPECT_EQ(open.mesh.vertices(), closed.mesh.vertices());
  double edge = 0;
  for (std::size_t c = 0; c < creature().mesh.triangle.size(); ++c)
    edge += distance(place(creature().mesh, creature().mesh.triangle[c]),
                     place(creature().mesh, creature().mesh.triangle[c % 3 == 2 ? c - 2 : c + 1])) /
            static_cast<double>(creature().mesh.triangle.size());
  std::map<int, std::vector<int>> copies;
  for (int v = 0; v < open.mesh.vertices(); ++v) copies[open.origin[v]].push_back(v);
  int pairs = 0;
  for (const auto& [origin, v] : copies) {
    if (v.size() == 1) continue;
    ASSERT_EQ(v.size(), 2u);
    ++pairs;
    EXPECT_NEAR(distance(place(open.mesh, v[0]), place(open.mesh, v[1])), 0.2 * edge, 1e-9);
  }
  EXPECT_EQ(pairs, open.mesh.vertices() - kVertices);
  EXPECT_GT(pairs, 10);
}

TEST(DamageKit, StripsLeavePartsApart) {
  const Damaged d = with([](Damaged& x, Random& random) { remove_strips(x, 1, random); });
  EXPECT_GE(parts(d.mesh), 2);
  EXPECT_LT(d.mesh.triangles(), kFaces - 20);
  EXPECT_GT(d.mesh.triangles(), kFaces * 9 / 10);
  expect_copies(d, 0);
}

TEST(DamageKit, FinsStandOnEdges) {
  const Damaged d = with([](Damaged& x, Random& random) { add_fins(x, 40, random); });
  const std::map<int, int> edges = edges_by_faces(d.mesh);
  EXPECT_EQ(edges.at(3), 40);
  EXPECT_EQ(edges.at(1), 80);
  EXPECT_EQ(new_vertices(d), 40);
  for (int v = 0; v < d.mesh.vertices(); ++v) EXPECT_EQ(d.partner[v] < 0, d.origin[v] < 0);
  expect_copies(d, 0);
}

TEST(DamageKit, RepeatedFacesAreThereTwice) {
  const Damaged d = with([](Damaged& x, Random& random) { repeat_faces(x, 100, random); });
  std::map<std::array<int, 3>, int> faces;
  for (int f = 0; f < d.mesh.triangles(); ++f) {
    std::array<int, 3> t{d.mesh.triangle[3 * f], d.mesh.triangle[3 * f + 1], d.mesh.triangle[3 * f + 2]};
    std::sort(t.begin(), t.end());
    ++faces[t];
  }
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto& f) { return f.second == 2; }), 100);
  EXPECT_EQ(static_cast<int>(faces.size()), kFaces);
}

TEST(DamageKit, FacesWithoutAreaKeepItClosed) {
  const Damaged d = with([](Damaged& x, Random& random) { add_zero_area(x, 100, random); });
  int without = 0;
  for (int f = 0; f < d.mesh.triangles(); ++f) without += area(d.mesh, f) < 1e-12;
  EXPECT_EQ(without, 100);
  EXPECT_EQ(new_vertices(d), 50) << "every other one is a needle";
  EXPECT_NEAR(area(d.mesh), area(creature().mesh), 1e-9);
  EXPECT_EQ(edges_by_faces(d.mesh).at(1), 100) << "both free edges of each face with two corners at one place";
}

TEST(DamageKit, FlippedFacesAreAShare) {
  const Damaged d = with([](Damaged& x, Random& random) { flip_faces(x, 0.2, random); });
  std::set<std::pair<int, int>> directed;
  for (std::size_t c = 0; c < d.mesh.triangle.size(); ++c)
    directed.insert({d.mesh.triangle[c], d.mesh.triangle[c % 3 == 2 ? c - 2 : c + 1]});
  // Of an edge one of two faces is turned with probability 2 * 0.2 * 0.8; both directions are one then.
  EXPECT_NEAR(static_cast<double>(2 * kEdges - directed.size()), 0.32 * kEdges, 0.03 * kEdges);
  EXPECT_EQ(d.mesh.vertices(), kVertices);
}

TEST(DamageKit, SoupHasAllItsCorners) {
  const Damaged d = with([](Damaged& x, Random& random) { loosen_faces(x, 1, random); });
  EXPECT_EQ(d.mesh.vertices(), 3 * kFaces);
  EXPECT_EQ(parts(d.mesh), kFaces);
  expect_copies(d, 0);
}

TEST(DamageKit, DebrisHasNoTruth) {
  const Damaged d = with([](Damaged& x, Random& random) { add_debris(x, 30, random); });
  EXPECT_EQ(parts(d.mesh), 31);
  EXPECT_EQ(new_vertices(d), 120);
  for (int v = 0; v < d.mesh.vertices(); ++v) {
    EXPECT_EQ(d.partner[v] < 0, d.origin[v] < 0);
    EXPECT_EQ(d.nearest[v] < 0, d.origin[v] < 0);
  }
}

TEST(DamageKit, JunctionsHaveAnEdgeOnOneSideOnly) {
  const Damaged d = with([](Damaged& x, Random& random) { add_junctions(x, 50, random); });
  EXPECT_EQ(new_vertices(d), 50);
  EXPECT_EQ(edges_by_faces(d.mesh).at(1), 150) << "the whole edge and both halves";
  EXPECT_NEAR(area(d.mesh), area(creature().mesh), 1e-9);
}

TEST(DamageKit, NoiseIsAsLargeAsAsked) {
  const Damaged d = with([](Damaged& x, Random& random) { add_noise(x, 0.01, random); });
  expect_copies(d, 0.01 * std::sqrt(3));
  EXPECT_NE(place(d.mesh, 0), place(creature().mesh, d.origin[0]));
}

class EachDamage : public testing::TestWithParam<Kind> {};

TEST_P(EachDamage, KeepsTheTruth) {
  const Damaged d = damaged(creature().mesh, creature().partner, GetParam(), 1);
  int known = 0;
  for (int v = 0; v < d.mesh.vertices(); ++v) {
    const int w = d.partner[v];
    if (w < 0) continue;
    ++known;
    ASSERT_LT(w, d.mesh.vertices());
    ASSERT_EQ(d.origin[w], creature().partner[d.nearest[v]]);
    ASSERT_EQ(d.nearest[d.partner[w]], d.nearest[v]) << "it leads back to a copy";
  }
  EXPECT_GT(known, 0.97 * kVertices);
  const Damaged again = damaged(creature().mesh, creature().partner, GetParam(), 1),
                other = damaged(creature().mesh, creature().partner, GetParam(), 2);
  EXPECT_EQ(again.mesh.position, d.mesh.position);
  EXPECT_EQ(again.mesh.triangle, d.mesh.triangle);
  EXPECT_NE(other.mesh.position, d.mesh.position);
  // The truth itself, as a result, has no error.
  const Evaluation e = evaluate_partners(creature().mesh, truth_of_whole(d), map_of_whole(d, d.partner), 1);
  EXPECT_EQ(e.mean, 0);
  EXPECT_EQ(coverage(d, d.partner), 1);
}

INSTANTIATE_TEST_SUITE_P(DamageKit, EachDamage, testing::ValuesIn(kinds()),
                         [](const auto& info) { return info.param.name; });

TEST(DamageKit, WhatLosesItsCounterpartHasNoPartner) {
  for (const Kind& kind : partial_kinds()) {
    const Damaged d = damaged(creature().mesh, creature().partner, kind, 1);
    EXPECT_EQ(parts(d.mesh), 1) << kind.name;
    EXPECT_LT(d.mesh.vertices(), 0.95 * kVertices) << kind.name;
    EXPECT_GT(d.mesh.vertices(), 0.6 * kVertices) << kind.name;
    std::set<int> left(d.origin.begin(), d.origin.end());
    for (int v = 0; v < d.mesh.vertices(); ++v) {
      const int partner = creature().partner[d.origin[v]];
      if (left.count(partner))
        EXPECT_EQ(d.origin[d.partner[v]], partner);
      else
        EXPECT_EQ(d.partner[v], -1);
    }
  }
}

// One test for all of them: the whole creature is searched and the distances are measured once.
TEST(DamageKit, CostsTheSearchHardlyAnything) {
  constexpr double kMean = 0.003, kCorr = 0.01;
  // These cost more, and all at once far more: docs/robustness.md.
  const std::map<std::string, double> costly{{"narrow_gaps", 0.01}, {"gaps", 0.01}};
  std::vector<std::vector<int>> maps{find_symmetry(creature().mesh).partners.partner};
  Truth lines = truth_of_whole(whole(creature().mesh, creature().partner));
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Damaged d = damaged(creature().mesh, creature().partner, kind, 1);
    const Result result = find_symmetry(d.mesh);
    const std::vector<int>& partner = result.partners.partner;
    std::map<Place, Place> partner_place;
    for (int v = 0; v < d.mesh.vertices(); ++v) {
      ASSERT_GE(partner[v], 0);
      const Place to = place(d.mesh, partner[v]);
      ASSERT_EQ(partner_place.try_emplace(place(d.mesh, v), to).first->second, to) << "of what is at one place";
    }
    maps.push_back(map_of_whole(d, partner));
    const Truth left = truth_of_whole(d);
    Truth both;
    std::set_intersection(lines.begin(), lines.end(), left.begin(), left.end(), std::back_inserter(both));
    lines = both;
  }
  ASSERT_GT(lines.size(), 0.9 * kVertices);
  const std::vector<Evaluation> e = evaluate_partners(creature().mesh, lines, maps, 0);
  EXPECT_GT(e[0].corr, 0.98);
  for (std::size_t k = 1; k < e.size(); ++k) {
    const std::string& name = kinds()[k - 1].name;
    RecordProperty(name, "mean " + std::to_string(e[k].mean) + " corr " + std::to_string(e[k].corr));
    if (name == "all") continue;
    EXPECT_LE(e[k].mean, e[0].mean + (costly.count(name) ? costly.at(name) : kMean)) << name;
    EXPECT_GE(e[k].corr, e[0].corr - kCorr) << name;
    EXPECT_GE(e[k].involution, e[0].involution - kCorr) << name;
  }
}

}  // namespace
}  // namespace ga_symmetry::damage
