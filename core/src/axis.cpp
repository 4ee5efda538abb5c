#include "ga_symmetry/axis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ga_symmetry {
namespace {

constexpr float kNear2 = 0.02f;  // squared distance, in units, within which all pairs count alike

// Each pair's label, +1 if its first landmark is on the left. Neighbours are on the same side; the labels that agree
// best with all of that at once are the signs of an eigenvector, so no doubtful pair leads the others astray. Source:
// Singer, Angular synchronization by eigenvectors and semidefinite programming, 2011; here the angles are signs.
std::vector<float> label_pairs(const Landmarks& landmarks, const DistanceFields& from, const DistanceFields& to,
                               float unit, int left) {
  const int count = static_cast<int>(landmarks.from.size());
  std::vector<float> apart(count);
  for (int i = 0; i < count; ++i) apart[i] = from(i, landmarks.to[i]);
  const double reach = unit / std::sqrt(static_cast<double>(count));  // how far apart landmarks are
  const auto near = [&](double distance) { return std::exp(-0.5 * distance * distance / (reach * reach)); };
  Eigen::MatrixXd agreement(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const int v = landmarks.from[j], w = landmarks.to[j];
      agreement(i, j) = i == j ? 0 : near(from(i, v)) + near(to(i, w)) - near(from(i, w)) - near(to(i, v));
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

}  // namespace

std::vector<float> left_right_function(const Surface& surface, const Landmarks& landmarks, const DistanceFields& from,
                                       const DistanceFields& to, int left) {
  const float unit = static_cast<float>(surface.unit());
  const std::vector<float> label = label_pairs(landmarks, from, to, unit, left);
  std::vector<float> out(surface.vertices(), 0.f), total(out);
  for (std::size_t i = 0; i < label.size(); ++i)
    for (int v = 0; v < surface.vertices(); ++v) {
      const float a = from(i, v) / unit, b = to(i, v) / unit, near = std::min(a, b);
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
