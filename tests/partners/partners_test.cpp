// SPDX-License-Identifier: GPL-3.0-or-later
// What is done with partners that are known: checks, transfer of values, asymmetry. All shapes have partners by
// construction.
#include "ga_symmetry/partners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ga_symmetry/asymmetry.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/mirror.h"
#include "partners/known_creature.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

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

// Every face has vertices of its own: what stands at one place is worth the same.
TEST_P(AsymmetryOf, VerticesSplitAlongSeamsAreWorthTheSame) {
  const shapes::Symmetric& shape = creature().straight;
  const int arm = creature().partners.side[shape.pair[0]] > 0 ? shape.pair[0] : shape.pair[1];
  const TriangleMesh mesh = with_swelling(shape, arm, 0.4);
  const Partners& whole = creature().partners;
  TriangleMesh split;
  std::vector<int> place, corner(mesh.vertices());
  for (const int v : mesh.triangle) {
    corner[v] = static_cast<int>(place.size());
    split.triangle.push_back(corner[v]);
    place.push_back(v);
    for (int k = 0; k < 3; ++k) split.position.push_back(mesh.position[3 * static_cast<std::size_t>(v) + k]);
  }
  Partners partners;
  for (const int v : place) {
    partners.partner.push_back(corner[whole.partner[v]]);
    partners.fitness.push_back(whole.fitness[v]);
    partners.side.push_back(whole.side[v]);
  }
  AsymmetryOptions options;
  options.measure = GetParam();
  const auto expected = asymmetry(mesh, whole, options), values = asymmetry(split, partners, options);
  for (std::size_t c = 0; c < place.size(); ++c) ASSERT_NEAR(values[c], expected[place[c]], 1e-3) << c;
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
