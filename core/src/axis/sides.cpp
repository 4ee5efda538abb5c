// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/sides.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>

#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

constexpr float kNear2 = 0.02f;  // squared distance, in units, within which all pairs count alike

// Each pair's label, +1 if its first landmark is on the left. Neighbours are on the same side; the labels that agree
// best with all of that at once are the signs of an eigenvector, so no doubtful pair leads the others astray. Source:
// Singer, Angular synchronization by eigenvectors and semidefinite programming, 2011; here the angles are signs.
std::vector<float> label_pairs(const Landmarks& from, const Landmarks& to, float unit, int left) {
  const int count = static_cast<int>(from.vertex.size());
  std::vector<float> apart(count);
  for (int i = 0; i < count; ++i) apart[i] = from.field(i, to.vertex[i]);
  const double reach = unit / std::sqrt(static_cast<double>(count));  // how far apart landmarks are
  const auto near = [&](double distance) { return std::exp(-0.5 * distance * distance / (reach * reach)); };
  Eigen::MatrixXd agreement(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const int v = from.vertex[j], w = to.vertex[j];
      agreement(i, j) =
          i == j ? 0 : near(from.field(i, v)) + near(to.field(i, w)) - near(from.field(i, w)) - near(to.field(i, v));
    }
  agreement = (0.5 * (agreement + agreement.transpose())).eval();
  Eigen::VectorXd scale = agreement.cwiseAbs().rowwise().sum();
  for (double& x : scale) x = x > 0 ? 1 / std::sqrt(x) : 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * agreement * scale.asDiagonal());
  const auto vector = solver.eigenvectors().col(count - 1);
  if (left < 0) left = static_cast<int>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  std::vector<float> label(count);
  for (int i = 0; i < count; ++i) {
    const double sign = vector[i] * vector[left];
    label[i] = sign > 0 ? 1.f : sign < 0 ? -1.f : 0.f;
  }
  return label;
}

// A connected part of the surface where the function has one sign.
struct Piece {
  std::vector<int> vertices;
  double area = 0, change = 0;  // the latter if it went over to the other side
  bool positive = false, border = false;
};

struct Pieces {
  std::vector<Piece> piece;
  std::vector<int> of;  // per vertex
};

double change_of(const Surface& surface, const std::vector<float>& function, int v) {
  return std::abs(function[v]) * surface.vertex_area[v];
}

Pieces pieces_of(const Surface& surface, const std::vector<float>& function) {
  std::vector<char> border(surface.vertices(), 0);
  for (int corner = 0; corner < 3 * surface.triangles(); ++corner)
    if (surface.opposite[corner] < 0)
      border[surface.triangle[next_corner(corner)]] = border[surface.triangle[previous_corner(corner)]] = 1;
  Pieces out;
  out.of.assign(surface.vertices(), -1);
  for (int start = 0; start < surface.vertices(); ++start) {
    if (out.of[start] >= 0) continue;
    const int number = static_cast<int>(out.piece.size());
    Piece piece;
    piece.positive = function[start] > 0;
    piece.vertices = {start};
    out.of[start] = number;
    for (std::size_t k = 0; k < piece.vertices.size(); ++k) {
      const int v = piece.vertices[k];
      piece.area += surface.vertex_area[v];
      piece.change += change_of(surface, function, v);
      piece.border = piece.border || border[v];
      for_each_neighbor(surface, v, [&](int w) {
        if (out.of[w] >= 0 || (function[w] > 0) != piece.positive) return;
        out.of[w] = number;
        piece.vertices.push_back(w);
      });
    }
    out.piece.push_back(std::move(piece));
  }
  return out;
}

// Whether, since the pieces were told apart, one has lost a vertex to the other side or has come to touch another of
// its own side.
bool is_joined(const Surface& surface, const std::vector<float>& function, const Pieces& pieces, int number) {
  const Piece& piece = pieces.piece[number];
  return std::any_of(piece.vertices.begin(), piece.vertices.end(), [&](int v) {
    bool joined = (function[v] > 0) != piece.positive;
    for_each_neighbor(
        surface, v, [&](int w) { joined = joined || (pieces.of[w] != number && (function[w] > 0) == piece.positive); });
    return joined;
  });
}

// The vertices of the other side through which a piece reaches the rest of its own side, if that changes less than to
// give the piece up. Empty if not.
std::vector<int> bridge(const Surface& surface, const std::vector<float>& function, const Pieces& pieces, int number) {
  const Piece& piece = pieces.piece[number];
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  std::map<int, std::pair<double, int>> reached;  // vertex -> change on the way there, vertex before
  const auto own = [&](int v) { return (function[v] > 0) == piece.positive; };
  const auto reach = [&](int v, double change, int before) {
    if (change >= piece.change) return;
    const auto [at, fresh] = reached.try_emplace(v, change, before);
    if (!fresh && at->second.first <= change) return;
    at->second = {change, before};
    queue.push({change, v});
  };
  for (const int v : piece.vertices) reach(v, 0, -1);
  while (!queue.empty()) {
    const auto [change, v] = queue.top();
    queue.pop();
    if (change > reached[v].first) continue;
    if (own(v) && pieces.of[v] != number) {
      std::vector<int> way;
      for (int w = reached[v].second; pieces.of[w] != number; w = reached[w].second) way.push_back(w);
      return way;
    }
    for_each_neighbor(surface, v, [&, at = change, from = v](int w) {
      reach(w, at + (own(w) ? 0 : change_of(surface, function, w)), from);
    });
  }
  return {};
}

}  // namespace

std::vector<float> left_right_function(const Surface& surface, const Landmarks& from, const Landmarks& to, int left) {
  const float unit = static_cast<float>(surface.unit());
  const std::vector<float> label = label_pairs(from, to, unit, left);
  constexpr float kFar = 4;  // units: farther than any two points of a body are
  std::vector<float> out(surface.vertices(), 0.f), total(out);
  for (std::size_t i = 0; i < label.size(); ++i)
    for (int v = 0; v < surface.vertices(); ++v) {
      // Another part of the mesh is far, but not infinitely.
      const float a = std::min(kFar, from.field(i, v) / unit), b = std::min(kFar, to.field(i, v) / unit);
      const float near = std::min(a, b);
      const float weight = 1 / (near * near + kNear2);
      out[v] += weight * label[i] * (b - a);
      total[v] += weight;
    }
  for (int v = 0; v < surface.vertices(); ++v) out[v] = total[v] > 0 ? out[v] / total[v] : 0;
  return out;
}

std::vector<int> sides(const Surface& surface, const std::vector<float>& function) {
  std::vector<int> side(surface.vertices());
  for (int v = 0; v < surface.vertices(); ++v) side[v] = function[v] > 0 ? 1 : function[v] < 0 ? -1 : 0;
  const std::vector<int> sign = side;
  for (int corner = 0; corner < 3 * surface.triangles(); ++corner) {
    const int a = surface.triangle[next_corner(corner)], b = surface.triangle[previous_corner(corner)];
    if (sign[a] * sign[b] >= 0) continue;
    const float at_a = std::abs(function[a]), at_b = std::abs(function[b]);
    side[at_a < at_b || (at_a == at_b && a < b) ? a : b] = 0;
  }
  return side;
}

int connect_sides(const Surface& surface, std::vector<float>& function) {
  int rounds = 0;
  for (std::size_t most = surface.vertices(); most > 0; --most) {
    const Pieces pieces = pieces_of(surface, function);
    ++rounds;
    const int count = static_cast<int>(pieces.piece.size());
    const auto area = [&](int number) { return pieces.piece[number].area; };
    int largest[2] = {-1, -1};
    for (int i = 0; i < count; ++i) {
      int& side = largest[pieces.piece[i].positive];
      if (side < 0 || area(i) > area(side)) side = i;
    }
    std::vector<int> stray;
    for (int i = 0; i < count; ++i)
      if (i != largest[0] && i != largest[1] && !pieces.piece[i].border) stray.push_back(i);
    if (stray.empty()) return rounds;
    std::stable_sort(stray.begin(), stray.end(), [&](int a, int b) { return area(a) < area(b); });
    for (const int number : stray) {
      const Piece& piece = pieces.piece[number];
      if (is_joined(surface, function, pieces, number)) continue;  // by one before it
      std::vector<int> over = bridge(surface, function, pieces, number);
      const bool joins = !over.empty();
      if (!joins) over = piece.vertices;
      for (const int v : over) {
        const float size = std::max(std::abs(function[v]), std::numeric_limits<float>::min());
        function[v] = piece.positive == joins ? size : -size;
      }
    }
  }
  return rounds;
}

}  // namespace ga_symmetry
