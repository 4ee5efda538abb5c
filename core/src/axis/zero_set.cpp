// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/zero_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ga_symmetry {

std::vector<std::vector<SurfacePoint>> zero_set(const Surface& surface, const std::vector<float>& function,
                                                double shortest) {
  const auto positive = [&](int v) { return function[v] > 0; };
  // Nodes are crossed edges, named by their two vertices; every crossed face links two of them.
  using Edge = std::pair<int, int>;
  std::map<Edge, std::array<int, 2>> faces_at;  // crossed edge -> faces, -1 = none
  for (int f = 0; f < surface.triangles(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangle[3 * f + k], b = surface.triangle[3 * f + (k + 1) % 3];
      if (positive(a) == positive(b)) continue;
      auto [at, fresh] = faces_at.try_emplace({std::min(a, b), std::max(a, b)}, std::array<int, 2>{f, -1});
      if (!fresh) at->second[1] = f;
    }
  const auto point = [&](const Edge& e) {
    const double a = function[e.first], b = function[e.second], t = a == b ? 0.5 : a / (a - b);
    return SurfacePoint{{e.first, e.second, e.second}, {1 - t, t, 0}};
  };
  const auto other_edge = [&](int f, const Edge& e) {
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangle[3 * f + k], b = surface.triangle[3 * f + (k + 1) % 3];
      const Edge other{std::min(a, b), std::max(a, b)};
      if (other != e && positive(a) != positive(b)) return other;
    }
    return e;
  };
  std::map<Edge, bool> visited;
  std::vector<std::vector<SurfacePoint>> lines;
  const auto walk = [&](Edge e, int face) {  // from e through face, until the border or a visited edge
    std::vector<SurfacePoint> line{point(e)};
    visited[e] = true;
    const Edge start = e;
    while (face >= 0) {
      const Edge next = other_edge(face, e);
      if (next == e) break;
      line.push_back(point(next));
      if (next == start) break;
      if (visited[next]) break;
      visited[next] = true;
      const auto& at = faces_at[next];
      face = at[0] == face ? at[1] : at[0];
      e = next;
    }
    return line;
  };
  for (const auto& [edge, faces] : faces_at)  // open ones start at the border
    if (faces[1] < 0 && !visited[edge]) lines.push_back(walk(edge, faces[0]));
  for (const auto& [edge, faces] : faces_at)
    if (!visited[edge]) lines.push_back(walk(edge, faces[0]));

  std::vector<double> length;
  for (const auto& line : lines) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      double square = 0;
      for (int k = 0; k < 3; ++k) {
        double delta = 0;
        for (int c = 0; c < 3; ++c)
          delta += line[i].weight[c] * surface.point(line[i].vertex[c])[k] -
                   line[i - 1].weight[c] * surface.point(line[i - 1].vertex[c])[k];
        square += delta * delta;
      }
      sum += std::sqrt(square);
    }
    length.push_back(sum);
  }
  const double total = std::accumulate(length.begin(), length.end(), 0.0);
  std::vector<int> order(lines.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[a] > length[b]; });
  std::vector<std::vector<SurfacePoint>> out;
  for (int i : order)
    if (length[i] >= shortest * total) out.push_back(std::move(lines[i]));
  return out;
}

}  // namespace ga_symmetry
