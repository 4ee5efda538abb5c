// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/shortcuts.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ga_symmetry {
namespace {

constexpr double kPinprick = 0.1;  // perimeter in units: a smaller hole is hardly a detour
constexpr double kSpacing = 0.05;  // of the points, in units, unless they become too many
constexpr double kMostPoints = 100;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Hole {
  std::vector<int> vertex;  // around it
  double perimeter = 0;
};

std::vector<Hole> large_holes(const Surface& s) {
  std::vector<int> next(s.vertices(), -1);  // where several holes touch, one of them is followed
  for (std::size_t c = 0; c < s.opposite.size(); ++c)
    if (s.opposite[c] < 0)
      next[s.triangle[next_corner(static_cast<int>(c))]] = s.triangle[previous_corner(static_cast<int>(c))];
  std::vector<Hole> out;
  for (int v = 0; v < s.vertices(); ++v) {
    Hole hole;
    for (int w = v; next[w] >= 0; w = std::exchange(next[w], -1)) {
      hole.vertex.push_back(w);
      hole.perimeter += s.edge_length(w, next[w]);
    }
    if (hole.perimeter >= kPinprick * s.unit()) out.push_back(std::move(hole));
  }
  return out;
}

}  // namespace

Shortcuts::Shortcuts(const Surface& surface, const GeodesicSolver& solver, int threads, const Context& context) {
  std::vector<Hole> holes = large_holes(surface);
  std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.perimeter > b.perimeter; });
  double total = 0;
  for (const Hole& hole : holes) total += hole.perimeter;
  const double spacing = std::max(kSpacing * surface.unit(), total / kMostPoints);
  std::vector<std::size_t> hole_of;
  for (std::size_t h = 0; h < holes.size() && points() < kMostPoints; ++h) {
    const std::vector<int>& around = holes[h].vertex;
    double at = 0, next = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (at >= next) {
        point_.push_back(around[i]);
        hole_of.push_back(h);
        next += spacing;
      }
      at += surface.edge_length(around[i], around[(i + 1) % around.size()]);
    }
  }
  if (none()) return;
  distance_ = solver.fields(point_, threads, context);
  straight_.resize(points(), points());
  for (int a = 0; a < points(); ++a)
    for (int b = 0; b < points(); ++b)
      straight_(a, b) =
          hole_of[a] == hole_of[b] ? static_cast<float>(surface.edge_length(point_[a], point_[b])) : kInfinity;
}

Shortcuts::Slack::Slack(const Shortcuts& shortcuts, const float* field)
    : shortcuts_(shortcuts), field_(field), entry_(Eigen::ArrayXf::Constant(shortcuts.points(), kInfinity)) {
  for (int a = 0; a < shortcuts.points(); ++a)
    entry_ = entry_.min(field[shortcuts.point_[a]] + shortcuts.straight_.col(a).array());
}

float Shortcuts::Slack::operator()(int v) const {
  if (shortcuts_.none()) return 0;
  return std::max(0.f, (field_[v] - (entry_ + shortcuts_.distance_.col(v).array()).minCoeff()) / 2);
}

}  // namespace ga_symmetry
