// SPDX-License-Identifier: GPL-3.0-or-later
// The promises of sample_meshes/README.md, checked on the files as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "geodesics/shortcuts.h"
#include "surface/surface.h"
#include "surface/welded_mesh.h"

namespace ga_symmetry {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = GA_SYMMETRY_SAMPLE_MESHES;

struct Sample {
  TriangleMesh mesh;
  Surface surface;
  std::vector<int> partner;  // -1: no counterpart
  std::vector<int> affected;
  std::array<int, 4> refs{};
};

bool begins(const std::string& name, const std::string& with) { return name.rfind(with, 0) == 0; }
bool turns(const std::string& name) { return begins(name, "trefoil") || begins(name, "pinwheel"); }
bool remeshed(const std::string& name) {
  return name == "person_dance" || name == "animal_graze" || name == "trefoil_curl" || name == "pinwheel_curl";
}
bool open(const std::string& name) { return name == "person_wave_hole" || name == "person_wave_scan"; }

class SampleMeshes : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string base = (kFolder / GetParam()).string();
    s.mesh = read_mesh(base + ".off");
    s.surface = make_surface(s.mesh);
    s.partner.assign(s.mesh.vertices(), -1);
    std::ifstream truth(base + ".truth");
    for (int v, w; truth >> v >> w;) {
      ASSERT_TRUE(v >= 0 && v < s.mesh.vertices() && w >= 0 && w < s.mesh.vertices());
      ASSERT_EQ(s.partner[v], -1) << "vertex " << v << " is listed twice";
      s.partner[v] = w;
    }
    std::ifstream affected(base + ".affected");
    for (int v; affected >> v;) s.affected.push_back(v);
    std::ifstream refs(base + ".refs");
    for (int& r : s.refs) ASSERT_TRUE(refs >> r);
  }

  double edge(int a, int b) const { return s.surface.edge_length(a, b); }

  double longest_edge() const {
    double longest = 0;
    for (int f = 0; f < s.surface.triangles(); ++f)
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, edge(s.surface.triangle[3 * f + k], s.surface.triangle[3 * f + (k + 1) % 3]));
    return longest;
  }

  Sample s;
};

TEST_P(SampleMeshes, IsOneOrientedSurfaceThroughTheDoor) {
  EXPECT_EQ(s.surface.vertices(), s.mesh.vertices());
  EXPECT_TRUE(s.surface.orientable);
  EXPECT_EQ(s.surface.closed, !open(GetParam()));
  EXPECT_EQ(s.surface.triangle, s.mesh.triangle) << "faces were turned or left out: " << s.surface.notes.size();
  double volume = 0;  // of the cones from a point amid the vertices
  double centre[3] = {0, 0, 0};
  for (int v = 0; v < s.surface.vertices(); ++v)
    for (int k = 0; k < 3; ++k) centre[k] += s.surface.point(v)[k] / s.surface.vertices();
  for (int f = 0; f < s.surface.triangles(); ++f) {
    double p[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) p[i][k] = s.surface.point(s.surface.triangle[3 * f + i])[k] - centre[k];
    for (int k = 0; k < 3; ++k)
      volume += p[0][k] * (p[1][(k + 1) % 3] * p[2][(k + 2) % 3] - p[1][(k + 2) % 3] * p[2][(k + 1) % 3]) / 6;
  }
  EXPECT_GT(volume, 0) << "the faces look inwards";
}

TEST_P(SampleMeshes, IsSmall) {
  constexpr std::uintmax_t kLimit = 300 * 1024;
  for (const char* ending : {".off", ".truth", ".refs"}) {
    const fs::path path = kFolder / (GetParam() + ending);
    EXPECT_LE(fs::file_size(path), kLimit) << path;
  }
  EXPECT_GE(s.mesh.vertices(), 2500);
  EXPECT_LE(s.mesh.vertices(), 5000);
}

TEST_P(SampleMeshes, EveryVertexHasAPartnerOrIsListedAsAffected) {
  const std::set<int> affected(s.affected.begin(), s.affected.end());
  EXPECT_EQ(affected.size(), s.affected.size());
  for (int v = 0; v < s.mesh.vertices(); ++v) EXPECT_EQ(s.partner[v] < 0, affected.count(v) == 1) << "vertex " << v;
  EXPECT_EQ(affected.empty(), !begins(GetParam(), "person_wave_"));
}

// Exact where vertices map onto vertices. A remeshed sample takes the nearest vertex each time: each step is off by at
// most one edge at rest, and posing stretches edges by less than twice.
TEST_P(SampleMeshes, TruthLeadsBack) {
  const int order = turns(GetParam()) ? 3 : 2;
  const double tolerance = remeshed(GetParam()) ? 2 * order * longest_edge() : 0;
  std::vector<int> seen(s.mesh.vertices(), 0);
  for (int v = 0; v < s.mesh.vertices(); ++v) {
    if (s.partner[v] < 0) continue;
    ++seen[s.partner[v]];
    int back = v;
    for (int k = 0; k < order; ++k) {
      back = s.partner[back];
      ASSERT_GE(back, 0) << "vertex " << v;
    }
    EXPECT_LE(edge(v, back), tolerance) << "vertex " << v;
  }
  if (!remeshed(GetParam())) {
    EXPECT_LE(*std::max_element(seen.begin(), seen.end()), 1) << "two vertices share a partner";
  }
}

// A symmetry moves neighbours to neighbours, and does not fold: one edge becomes at most a few.
TEST_P(SampleMeshes, TruthIsContinuous) {
  const double limit = 3 * longest_edge();
  for (int f = 0; f < s.surface.triangles(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int v = s.partner[s.surface.triangle[3 * f + k]], w = s.partner[s.surface.triangle[3 * f + (k + 1) % 3]];
      if (v < 0 || w < 0) continue;
      EXPECT_LT(edge(v, w), limit) << "face " << f;
    }
}

// Nearly an isometry of the posed surface: bending stretches an elbow or a hip a little, as it does in real scans. Ways
// round a missing part are longer on one side: there, distances may differ by as much as they are in doubt.
TEST_P(SampleMeshes, TruthKeepsGeodesicDistances) {
  constexpr double kStretch = 0.07;  // mean, in sqrt(area); measured 0.02 to 0.055
  const GeodesicSolver solver(s.surface);
  const auto [a0, a1, l, r] = s.refs;
  const DistanceFields d = solver.fields({a0, a1, l, r}, 1);
  const Shortcuts shortcuts(s.surface, solver, 1);
  std::vector<Shortcuts::Slack> slack;
  for (int i = 0; i < 4; ++i) slack.push_back(shortcuts.slack(d.row(i).data()));
  // How far apart two distances are at least.
  const auto difference = [&](int i, int v, int j, int w) {
    const float a = slack[i](v), b = slack[j](w);
    return std::max(0.f, std::abs((d(i, v) - a) - (d(j, w) - b)) - a - b) / s.surface.unit();
  };
  double truth = 0, nothing = 0;  // `nothing`: every vertex stays where it is, measured from l and r
  int count = 0;
  for (int v = 0; v < s.mesh.vertices(); ++v) {
    const int w = s.partner[v];
    if (w < 0) continue;
    for (auto [from, to] : {std::pair(0, 0), std::pair(1, 1), std::pair(2, 3)}) truth += difference(from, v, to, w);
    nothing += difference(2, v, 3, v);
    ++count;
  }
  EXPECT_LT(truth / (3 * count), kStretch);
  EXPECT_GT(nothing / count, kStretch) << "the measure cannot tell a symmetry from none";
}

TEST_P(SampleMeshes, NeitherIndicesNorConnectivityTellThePartner) {
  std::map<int, int> offsets, sums;
  int moved = 0;
  for (int v = 0; v < s.mesh.vertices(); ++v) {
    if (s.partner[v] < 0 || s.partner[v] == v) continue;
    ++moved;
    ++offsets[s.partner[v] - v];
    ++sums[s.partner[v] + v];
  }
  // n random partners fall on one offset or sum about n / 2n times; 20 is far beyond chance.
  for (const auto* counts : {&offsets, &sums})
    for (const auto& [value, count] : *counts) EXPECT_LT(count, 20) << "for " << value << " of " << moved;
  std::set<std::pair<int, int>> edges;
  for (int f = 0; f < s.surface.triangles(); ++f)
    for (int k = 0; k < 3; ++k)
      edges.insert(std::minmax(s.surface.triangle[3 * f + k], s.surface.triangle[3 * f + (k + 1) % 3]));
  double kept = 0, all = 0;
  for (auto [v, w] : edges) {
    if (s.partner[v] < 0 || s.partner[w] < 0) continue;
    ++all;
    kept += static_cast<double>(edges.count(std::minmax(s.partner[v], s.partner[w])));
  }
  EXPECT_LT(kept / all, 0.9) << "share of edges that the truth maps onto edges";
}

TEST_P(SampleMeshes, ReferencesAgreeWithTheTruth) {
  const auto [a0, a1, l, r] = s.refs;
  EXPECT_EQ(s.partner[a0], a0);
  EXPECT_EQ(s.partner[a1], a1);
  EXPECT_NE(a0, a1);
  EXPECT_EQ(s.partner[l], r);
  EXPECT_NE(l, r);
  if (!turns(GetParam())) {
    EXPECT_EQ(s.partner[r], l);
  }
}

TEST_P(SampleMeshes, MirrorsOfTheTrefoil) {
  const fs::path path = kFolder / (GetParam() + ".mirrors");
  EXPECT_EQ(fs::exists(path), begins(GetParam(), "trefoil"));
  if (!fs::exists(path)) return;
  std::ifstream in(path);
  std::vector<std::array<int, 3>> mirror(s.mesh.vertices());
  int lines = 0;
  for (int v, a, b, c; in >> v >> a >> b >> c; ++lines) mirror.at(v) = {a, b, c};
  ASSERT_EQ(lines, s.mesh.vertices());
  if (remeshed(GetParam())) return;
  for (int v = 0; v < s.mesh.vertices(); ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(mirror[mirror[v][k]][k], v);
    // Two mirrors after each other are a turn, one way or the other.
    const int turned = mirror[mirror[v][0]][1], once = s.partner[v];
    EXPECT_TRUE(turned == once || turned == s.partner[once]) << "vertex " << v;
  }
}

// As people have meshes: in parts, with seams, debris, few polygons.
const std::set<std::string> kAsPeopleHaveThem{"animal_beg_debris", "person_dressed_reach", "person_dressed_walk",
                                              "person_wave_low_poly"};

class SampleAsPeopleHaveThem : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string base = (kFolder / GetParam()).string();
    mesh = read_mesh(base + ".off");
    std::map<std::array<double, 3>, int> at;
    for (int v = 0; v < mesh.vertices(); ++v)
      first.push_back(
          at.try_emplace({mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]}, v).first->second);
    partner.assign(mesh.vertices(), -1);
    for (const auto& [v, w] : read_truth(base + ".truth")) partner.at(v) = w;
    std::ifstream list(base + ".affected");
    for (int v; list >> v;) affected.insert(v);
    std::ifstream references(base + ".refs");
    for (int& r : refs) ASSERT_TRUE(references >> r);
  }

  TriangleMesh mesh;
  std::vector<int> first;  // per vertex: the first one at its place
  std::vector<int> partner;
  std::set<int> affected;
  std::array<int, 4> refs{};
};

TEST_P(SampleAsPeopleHaveThem, IsWhatItsNameSays) {
  const Surface surface = make_surface(mesh);
  int parts = 0;
  face_parts(surface.triangle, surface.vertices(), parts);
  const int doubled = mesh.vertices() - surface.vertices();
  if (begins(GetParam(), "person_dressed")) {
    EXPECT_EQ(parts, 8) << "body, shirt, hat, bag, two shoes, two eyes";
    EXPECT_GT(doubled, 100) << "seams";
  } else if (GetParam() == "animal_beg_debris") {
    EXPECT_EQ(parts, 41);
  } else {
    EXPECT_EQ(parts, 1);
    EXPECT_LT(mesh.vertices(), 300);
    EXPECT_TRUE(surface.closed);
  }
  EXPECT_LE(mesh.vertices(), 5000);
  EXPECT_LE(fs::file_size(kFolder / (GetParam() + ".off")), 300u * 1024);
}

// By place: of several copies of a vertex the truth names any.
TEST_P(SampleAsPeopleHaveThem, TruthLeadsBack) {
  for (int v = 0; v < mesh.vertices(); ++v) {
    ASSERT_EQ(partner[v] < 0, affected.count(v) == 1) << "vertex " << v;
    if (partner[v] < 0) continue;
    ASSERT_GE(partner[partner[v]], 0);
    ASSERT_EQ(first[partner[partner[v]]], first[v]) << "vertex " << v;
    ASSERT_EQ(first[partner[first[v]]], first[partner[v]]) << "vertex " << v;
  }
  const auto [a0, a1, l, r] = refs;
  EXPECT_EQ(partner[a0], a0);
  EXPECT_EQ(partner[a1], a1);
  EXPECT_EQ(partner[l], r);
  EXPECT_EQ(partner[r], l);
  EXPECT_EQ((std::set<int>{a0, a1, l, r}.size()), 4u);
}

TEST_P(SampleAsPeopleHaveThem, IsFoundWithDefaultOptions) {
  const Result result = find_symmetry(mesh);
  EXPECT_EQ(result.matched, mesh.vertices());
  TriangleMesh welded = mesh;
  for (int& v : welded.triangle) v = first[v];
  Truth lines;
  std::vector<int> map(mesh.vertices());
  for (int v = 0; v < mesh.vertices(); ++v) {
    map[v] = first[result.partners.partner[v]];
    EXPECT_EQ(map[v], first[result.partners.partner[first[v]]]) << "of what is at one place";
    if (first[v] == v && partner[v] >= 0) lines.push_back({v, first[partner[v]]});
  }
  const Evaluation e = evaluate_partners(welded, lines, map);
  EXPECT_GT(e.corr, 0.9) << result.surface;
  EXPECT_LT(e.mean, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, SampleAsPeopleHaveThem, ::testing::ValuesIn(kAsPeopleHaveThem),
                         [](const auto& info) { return info.param; });

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".off") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::string> clean_names() {
  std::vector<std::string> out = names();
  out.erase(std::remove_if(out.begin(), out.end(), [](const auto& n) { return kAsPeopleHaveThem.count(n) > 0; }),
            out.end());
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, SampleMeshes, ::testing::ValuesIn(clean_names()),
                         [](const auto& info) { return info.param; });

TEST(SampleMeshFolder, HoldsTheSamplesOfItsReadme) {
  EXPECT_EQ(names(), (std::vector<std::string>{"animal_beg", "animal_beg_debris", "animal_graze", "animal_walk",
                                               "person_dance", "person_dressed_reach", "person_dressed_walk",
                                               "person_run", "person_wave", "person_wave_hole", "person_wave_hump",
                                               "person_wave_low_poly", "person_wave_no_hand", "person_wave_scan",
                                               "pinwheel_bend", "pinwheel_curl", "trefoil_bend", "trefoil_curl"}));
}

}  // namespace
}  // namespace ga_symmetry
