// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/zero_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

using Lines = std::vector<std::vector<SurfacePoint>>;

std::array<double, 3> at(const Surface& s, const SurfacePoint& p) {
  std::array<double, 3> out{};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) out[k] += p.weight[c] * s.point(p.vertex[c])[k];
  return out;
}

double length(const Surface& s, const std::vector<SurfacePoint>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto p = at(s, line[i - 1]), q = at(s, line[i]);
    sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  return sum;
}

std::vector<float> values(const Surface& s, const std::function<double(const double*)>& f) {
  std::vector<float> out;
  for (int v = 0; v < s.vertices(); ++v) out.push_back(static_cast<float>(f(s.point(v))));
  return out;
}

bool closed(const std::vector<SurfacePoint>& line) {
  return line.front().vertex == line.back().vertex && line.front().weight == line.back().weight;
}

TEST(ZeroSet, AGreatCircleOfASphere) {
  const Surface s = make_surface(shapes::icosphere(4));
  // Oblique, so that no vertex is on it. Interpolated linearly over faces the plane is met exactly.
  std::array<double, 3> centre{};
  for (int v = 0; v < s.vertices(); ++v)
    for (int k = 0; k < 3; ++k) centre[k] += s.point(v)[k] / s.vertices();
  const auto plane = [&](const double* p) {
    return 0.6 * (p[0] - centre[0]) - 0.35 * (p[1] - centre[1]) + 0.72 * (p[2] - centre[2]) - 0.003 * s.unit();
  };
  const Lines lines = zero_set(s, values(s, plane), 0);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(closed(lines[0]));
  for (const SurfacePoint& p : lines[0]) EXPECT_NEAR(plane(at(s, p).data()), 0, 1e-6 * s.unit());
  // A sphere's circumference over sqrt(area) is sqrt(pi); chords are a little shorter.
  EXPECT_NEAR(length(s, lines[0]) / s.unit(), std::sqrt(std::acos(-1.0)), 0.01);
}

TEST(ZeroSet, OpenLinesRunFromBorderToBorderLongestFirst) {
  const Surface s = make_surface(shapes::grid(31, 21));
  const double width = s.point(30)[0] - s.point(0)[0];
  // Zero on x = 0.305 across the whole sheet, and on the corner beyond x + y = 1.9.
  const auto f = values(s, [&](const double* p) {
    const double x = (p[0] - s.point(0)[0]) / width, y = (p[1] - s.point(0)[1]) / width;
    return std::min(x - 0.305, 1.9 - x - y);
  });
  const Lines lines = zero_set(s, f, 0);
  ASSERT_EQ(lines.size(), 2u);
  for (const auto& line : lines) EXPECT_FALSE(closed(line));
  EXPECT_NEAR(length(s, lines[0]) / width, 1, 1e-6);
  EXPECT_NEAR(length(s, lines[1]) / width, 0.1 * std::sqrt(2.0), 0.02);
  EXPECT_EQ(zero_set(s, f, 0.2).size(), 1u) << "the short one is less than a fifth of both";
}

TEST(ZeroSet, NothingWhereTheSignIsTheSame) {
  const Surface s = make_surface(shapes::icosphere(2));
  EXPECT_TRUE(zero_set(s, std::vector<float>(s.vertices(), 1.f), 0).empty());
  EXPECT_TRUE(zero_set(s, std::vector<float>(s.vertices(), 0.f), 0).empty());
}

}  // namespace
}  // namespace ga_symmetry
