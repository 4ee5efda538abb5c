// What is done with partners that are known: checks, transfer of values, pairs, the axis, asymmetry. All shapes have
// partners by construction.
#include "ga_symmetry/partners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "axis/sides.h"
#include "ga_symmetry/asymmetry.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mirror.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/sampling.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

constexpr int kLevel = 4;  // 2562 vertices

// The creature is mirrored in x: left is where x > 0 before any bending.
Partners partners_of(const shapes::Symmetric& shape) {
  Partners out;
  out.partner = shape.partner;
  out.fitness.assign(shape.partner.size(), 0.0);
  for (std::size_t v = 0; v < shape.partner.size(); ++v)
    out.side.push_back(shape.partner[v] == static_cast<int>(v) ? 0 : shape.mesh.position[3 * v] > 0 ? 1 : -1);
  return out;
}

struct Creature {
  shapes::Symmetric straight = shapes::shuffled(shapes::creature(kLevel), 5);
  TriangleMesh mesh = shapes::bent(straight, 0.3).mesh;
  Partners partners = partners_of(straight);
};

const Creature& creature() {
  static const Creature shared;
  return shared;
}

std::string refusal(const Partners& partners, const TriangleMesh& mesh) {
  try {
    check_partners(partners, mesh);
  } catch (const InvalidOption& error) {
    return error.what();
  }
  return "";
}

TEST(CheckPartners, AcceptsTheTruthAndWhatIsMissing) {
  Partners p = creature().partners;
  EXPECT_EQ(refusal(p, creature().mesh), "");
  std::fill(p.partner.begin(), p.partner.end(), -1);
  EXPECT_EQ(refusal(p, creature().mesh), "");
}

TEST(CheckPartners, RefusesWhatCannotBe) {
  const auto broken = [](const auto& change) {
    Partners p = creature().partners;
    change(p);
    return refusal(p, creature().mesh);
  };
  EXPECT_NE(broken([](Partners& p) { p.partner[7] = static_cast<int>(p.partner.size()); }).find("vertex 7"),
            std::string::npos);
  EXPECT_NE(broken([](Partners& p) { p.partner[7] = -2; }), "");
  EXPECT_NE(broken([](Partners& p) { p.fitness[7] = NAN; }), "");
  EXPECT_NE(broken([](Partners& p) { p.side[7] = 2; }), "");
  EXPECT_NE(broken([](Partners& p) { p.side.pop_back(); }), "");
}

TEST(CheckPartners, RefusesThoseOfAMeshWithOtherNumbers) {
  const auto other = partners_of(shapes::shuffled(shapes::creature(kLevel), 6));
  EXPECT_NE(refusal(other, creature().mesh).find("not of this mesh"), std::string::npos);
}

TEST(Mirror, EachDirection) {
  // 0 and 1 are left, 2 and 3 right, 4 on the axis; 1 and 3 have no partner.
  Partners p{{2, -1, 0, -1, 4}, {0, 0, 0, 0, 0}, {1, 1, -1, -1, 0}};
  const std::vector<double> values{10, 20, 30, 40, 50};
  const auto result = [&](Transfer transfer, int changed, int without) {
    const TransferPlan plan = plan_transfer(p, transfer);
    EXPECT_EQ(plan.changed, changed);
    EXPECT_EQ(plan.without_partner, without);
    return transferred(values, plan, transfer);
  };
  EXPECT_EQ(result(Transfer::left_to_right, 1, 1), (std::vector<double>{10, 20, 10, 40, 50}));
  EXPECT_EQ(result(Transfer::right_to_left, 1, 1), (std::vector<double>{30, 20, 30, 40, 50}));
  EXPECT_EQ(result(Transfer::swap, 3, 2), (std::vector<double>{30, 20, 10, 40, 50}));
  EXPECT_EQ(result(Transfer::average, 3, 2), (std::vector<double>{20, 20, 20, 40, 50}));
  p.partner[2] = 3;  // on its own side
  EXPECT_EQ(result(Transfer::left_to_right, 0, 2), values);
  p.side.assign(5, 0);
  EXPECT_THROW(plan_transfer(p, Transfer::left_to_right), InvalidOption);
  EXPECT_NO_THROW(plan_transfer(p, Transfer::swap));
}

TEST(Mirror, Laws) {
  const Partners& p = creature().partners;
  std::vector<double> values;
  for (std::size_t v = 0; v < p.partner.size(); ++v) values.push_back(std::sin(double(v)));
  const auto apply = [&](const std::vector<double>& x, Transfer t) { return transferred(x, plan_transfer(p, t), t); };
  EXPECT_EQ(apply(apply(values, Transfer::swap), Transfer::swap), values);
  for (const Transfer t : {Transfer::left_to_right, Transfer::right_to_left, Transfer::average}) {
    const auto once = apply(values, t);
    EXPECT_EQ(apply(once, Transfer::swap), once) << "not symmetric";
    EXPECT_EQ(apply(once, t), once) << "not idempotent";
  }
}

TEST(Pairs, SpreadOverTheLeftAndNested) {
  const auto pairs = spread_pairs(creature().mesh, creature().partners, 40);
  ASSERT_EQ(pairs.size(), 40u);
  std::set<int> used;
  for (const SymmetricPair& pair : pairs) {
    EXPECT_EQ(creature().partners.side[pair.vertex], 1);
    EXPECT_EQ(pair.partner, creature().partners.partner[pair.vertex]);
    EXPECT_TRUE(used.insert(pair.vertex).second) << "chosen twice";
  }
  const auto fewer = spread_pairs(creature().mesh, creature().partners, 10);
  for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_EQ(fewer[i].vertex, pairs[i].vertex);
  const auto& side = creature().partners.side;
  EXPECT_EQ(spread_pairs(creature().mesh, creature().partners, 100000).size(),
            static_cast<std::size_t>(std::count(side.begin(), side.end(), 1)));
  EXPECT_THROW(spread_pairs(creature().mesh, creature().partners, 0), InvalidOption);
}

TEST(Pairs, NoneWithoutPartners) {
  Partners p = creature().partners;
  std::fill(p.partner.begin(), p.partner.end(), -1);
  EXPECT_TRUE(spread_pairs(creature().mesh, p, 10).empty());
}

// Points of the axis on the straight creature, where it is the plane x = 0.
TEST(AxisLines, OneClosedLineInThePlane) {
  const Creature& c = creature();
  const auto lines = axis_lines(c.mesh, c.partners, 1);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_GT(lines[0].size(), 50u);
  EXPECT_EQ(position_of(c.mesh, lines[0].front()), position_of(c.mesh, lines[0].back())) << "not closed";
  double off = 0;
  for (const SurfacePoint& point : lines[0]) off += std::abs(position_of(c.straight.mesh, point)[0]);
  // The creature is about 4 long, its edges about 0.08; bending moves the middle of the distances by a little.
  EXPECT_LT(off / static_cast<double>(lines[0].size()), 0.08);
  const auto threads = axis_lines(c.mesh, c.partners, 3);
  ASSERT_EQ(threads[0].size(), lines[0].size());
  for (std::size_t i = 0; i < lines[0].size(); ++i) EXPECT_EQ(threads[0][i].weight, lines[0][i].weight);
}

// A thin tail on the axis is nearly its own mirror image: a map that leaves it in place is hardly wrong, but tells
// nothing of its sides.
TEST(AxisLines, OneLineThoughTheMapLeavesTheTailInPlace) {
  const Creature& c = creature();
  Partners p = c.partners;
  const double* tip = &c.straight.mesh.position[3 * c.straight.axis[1]];
  int in_place = 0;
  for (std::size_t v = 0; v < p.partner.size(); ++v) {
    const double* x = &c.straight.mesh.position[3 * v];
    if (std::hypot(x[0] - tip[0], x[1] - tip[1], x[2] - tip[2]) > 0.8) continue;
    p.partner[v] = static_cast<int>(v);
    ++in_place;
  }
  ASSERT_GT(in_place, 50);
  EXPECT_EQ(axis_lines(c.mesh, p, 1).size(), 1u);
}

// Mirrored in x its axis goes twice around the tube, mirrored in z twice around the hole.
TEST(AxisLines, ATorusKeepsBothItsLines) {
  const TriangleMesh mesh = shapes::torus(48, 24);
  for (const int mirrored : {0, 2}) {
    Partners p;
    for (int v = 0; v < mesh.vertices(); ++v) {
      double at[3] = {mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]};
      p.side.push_back(std::abs(at[mirrored]) < 1e-9 ? 0 : at[mirrored] > 0 ? 1 : -1);
      at[mirrored] = -at[mirrored];
      int nearest = 0;
      const auto distance = [&](int w) {
        return std::hypot(mesh.position[3 * w] - at[0], mesh.position[3 * w + 1] - at[1],
                          mesh.position[3 * w + 2] - at[2]);
      };
      for (int w = 1; w < mesh.vertices(); ++w)
        if (distance(w) < distance(nearest)) nearest = w;
      ASSERT_LT(distance(nearest), 1e-9);
      p.partner.push_back(nearest);
      p.fitness.push_back(0);
    }
    const auto lines = axis_lines(mesh, p, 1);
    ASSERT_EQ(lines.size(), 2u) << "mirrored in "
                                << "xyz"[mirrored];
    for (const auto& line : lines) {
      EXPECT_EQ(position_of(mesh, line.front()), position_of(mesh, line.back())) << "not closed";
      for (const SurfacePoint& point : line) EXPECT_LT(std::abs(position_of(mesh, point)[mirrored]), 0.1);
    }
  }
}

TEST(AxisLines, OneClosedLineOnTheSamples) {
  for (const std::string name : {"animal_graze", "animal_walk", "person_dance"}) {
    const TriangleMesh mesh = read_mesh(std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/" + name + ".off");
    const Result found = find_symmetry(mesh);
    const auto lines = axis_lines(mesh, {found.partner, found.fitness, found.side}, 0);
    ASSERT_EQ(lines.size(), 1u) << name;
    EXPECT_EQ(position_of(mesh, lines[0].front()), position_of(mesh, lines[0].back())) << name << ": not closed";
  }
}

int pieces(const Surface& surface, const std::vector<float>& function) {
  std::vector<int> piece(surface.vertices(), -1);
  int count = 0;
  for (int start = 0; start < surface.vertices(); ++start) {
    if (piece[start] >= 0) continue;
    std::vector<int> stack{start};
    piece[start] = count;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int corner = 0; corner < 3 * surface.triangles(); ++corner) {
        if (surface.triangle[corner] != v) continue;
        for (const int w : {surface.triangle[next_corner(corner)], surface.triangle[previous_corner(corner)]})
          if (piece[w] < 0 && (function[w] > 0) == (function[v] > 0)) piece[w] = count, stack.push_back(w);
      }
    }
    ++count;
  }
  return count;
}

TEST(ConnectSides, JoinsWhatIsCutOffAndDropsWhatIsStray) {
  const TriangleMesh mesh = shapes::icosphere(3);
  const Surface surface = make_surface(mesh);
  std::vector<float> clean;
  const auto point = [&](int v) { return &mesh.position[3 * surface.mesh_vertex[v]]; };
  for (int v = 0; v < surface.vertices(); ++v) clean.push_back(static_cast<float>(point(v)[0]) + 0.01f);
  auto function = clean;
  connect_sides(surface, function);
  EXPECT_EQ(function, clean) << "two sides in one piece each were changed";
  // A weak spot in the middle of the other side goes over to it, and nothing else changes.
  const auto within = [&](int v, double x, double y, double z, double radius) {
    const double* p = point(v);
    return std::hypot(p[0] - x, p[1] - y, p[2] - z) < radius;
  };
  for (int v = 0; v < surface.vertices(); ++v)
    if (within(v, -1, 0, 0, 0.3)) function[v] = 0.01f;
  ASSERT_EQ(pieces(surface, function), 3);
  connect_sides(surface, function);
  EXPECT_EQ(pieces(surface, function), 2);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_EQ(function[v] > 0, clean[v] > 0);
  // A strong part of the left that a weak ditch cuts off is joined to it again: the part keeps its sign.
  function = clean;
  for (int v = 0; v < surface.vertices(); ++v)
    if (within(v, 1, 0, 0, 0.6) && !within(v, 1, 0, 0, 0.35)) function[v] = -0.01f;
  ASSERT_EQ(pieces(surface, function), 4);
  const auto before = function;
  connect_sides(surface, function);
  EXPECT_EQ(pieces(surface, function), 2);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_TRUE(before[v] <= 0 || function[v] > 0) << v;
}

TEST(ConnectSides, PiecesAtABorderStay) {
  const TriangleMesh mesh = shapes::grid(20, 20);
  const Surface surface = make_surface(mesh);
  std::vector<float> function;
  for (int v = 0; v < surface.vertices(); ++v)
    function.push_back(static_cast<float>(0.1 - std::abs(mesh.position[3 * v] - 0.5)));  // a strip across
  const auto before = function;
  ASSERT_EQ(pieces(surface, function), 3);
  connect_sides(surface, function);
  EXPECT_EQ(function, before);
}

// Landmarks on both sides, every tenth with a wrong image: no limb may change sides for it.
TEST(LeftRightFunction, OneSideIsOneSideEverywhere) {
  const Creature& c = creature();
  const Surface surface = make_surface(c.mesh);
  const GeodesicSolver solver(surface);
  const Samples samples = evenly_spaced_samples(surface, solver, 80, 1);
  Landmarks landmarks;
  landmarks.from = samples.vertex;
  for (const int v : landmarks.from) landmarks.to.push_back(c.partners.partner[v]);
  for (std::size_t i = 5; i < landmarks.to.size(); i += 10) landmarks.to[i] = landmarks.to[i - 1];
  const auto side =
      sides(surface, left_right_function(surface, landmarks, samples.distance, solver.fields(landmarks.to, 1)));
  int same = 0, other = 0, axis = 0;
  for (int v = 0; v < surface.vertices(); ++v) {
    if (std::abs(c.straight.mesh.position[3 * v]) < 0.2) continue;  // two edges from the axis, or nearer
    const int product = side[v] * c.partners.side[v];
    ++(product > 0 ? same : product < 0 ? other : axis);
  }
  EXPECT_EQ(std::min(same, other), 0) << same << " as by construction, " << other << " the other way";
  EXPECT_LT(axis, 0.01 * surface.vertices());
}

TEST(AxisLines, NoneAfterARotation) {
  Partners p = creature().partners;
  std::fill(p.side.begin(), p.side.end(), 0);
  EXPECT_THROW(axis_lines(creature().mesh, p, 1), InvalidOption);
}

TEST(ValueAt, Interpolates) {
  const SurfacePoint point{{2, 0, 1}, {0.5, 0.25, 0.25}};
  EXPECT_DOUBLE_EQ(value_at({4, 8, 2}, point), 4);
}

// The left half blown up around a point of the left arm.
TriangleMesh with_swelling(const shapes::Symmetric& shape, int centre, double amount) {
  TriangleMesh mesh = shape.mesh;
  const double* c = &shape.mesh.position[3 * centre];
  for (int v = 0; v < mesh.vertices(); ++v) {
    double* p = &mesh.position[3 * v];
    const double d2 = std::pow(p[0] - c[0], 2) + std::pow(p[1] - c[1], 2) + std::pow(p[2] - c[2], 2);
    const double stretch = 1 + amount * std::exp(-d2 / 0.4);
    for (int k = 0; k < 3; ++k) p[k] = c[k] + (p[k] - c[k]) * stretch;
  }
  return mesh;
}

class AsymmetryOf : public testing::TestWithParam<AsymmetryMeasure> {};

TEST_P(AsymmetryOf, NothingWhereBothSidesAreEqual) {
  AsymmetryOptions options;
  options.measure = GetParam();
  const shapes::Symmetric& shape = creature().straight;
  const auto values = asymmetry(shape.mesh, creature().partners, options);
  for (std::size_t v = 0; v < values.size(); ++v) ASSERT_NEAR(values[v], 0, 1e-3) << v;
}

TEST_P(AsymmetryOf, PositiveOnTheLargerSideAndNegativeOnTheOther) {
  const shapes::Symmetric& shape = creature().straight;
  const int arm = creature().partners.side[shape.pair[0]] > 0 ? shape.pair[0] : shape.pair[1];
  const TriangleMesh mesh = with_swelling(shape, arm, GetParam() == AsymmetryMeasure::curvature ? -0.4 : 0.4);
  AsymmetryOptions options;
  options.measure = GetParam();
  options.threads = 1;
  const auto values = asymmetry(mesh, creature().partners, options);
  EXPECT_GT(values[arm], 0.2);
  EXPECT_LT(values[shape.partner[arm]], -0.2);
  // Far away nothing has changed: relative to the disc of the axis' ends.
  for (const int end : shape.axis) EXPECT_NEAR(values[end], 0, 0.02);
  options.threads = 3;
  EXPECT_EQ(asymmetry(mesh, creature().partners, options), values);
}

TEST_P(AsymmetryOf, ZeroWithoutAPartnerAndScaleFree) {
  AsymmetryOptions options;
  options.measure = GetParam();
  Partners p = creature().partners;
  for (std::size_t v = 0; v < p.partner.size(); v += 3) p.partner[v] = -1;
  const auto values = asymmetry(creature().mesh, p, options);
  for (std::size_t v = 0; v < p.partner.size(); v += 3) ASSERT_EQ(values[v], 0);
  const auto moved = asymmetry(shapes::moved(creature().mesh, 100), p, options);
  for (std::size_t v = 0; v < values.size(); ++v) ASSERT_NEAR(moved[v], values[v], 1e-2 * (1 + std::abs(values[v])));
}

INSTANTIATE_TEST_SUITE_P(Measures, AsymmetryOf,
                         testing::Values(AsymmetryMeasure::area, AsymmetryMeasure::length,
                                         AsymmetryMeasure::curvature));

TEST(Asymmetry, RefusesBadOptions) {
  AsymmetryOptions options;
  for (const double radius : {0.0, -1.0, 1.5, double(NAN)}) {
    options.radius = radius;
    EXPECT_THROW(asymmetry(creature().mesh, creature().partners, options), InvalidOption);
  }
  options = {};
  options.threads = -1;
  EXPECT_THROW(asymmetry(creature().mesh, creature().partners, options), InvalidOption);
}

}  // namespace
}  // namespace ga_symmetry
