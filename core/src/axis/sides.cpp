#include "axis/sides.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>

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

template <class Visit>
void for_each_neighbor(const Surface& surface, int v, const Visit& visit) {
  for (int i = surface.first_corner[v]; i < surface.first_corner[v + 1]; ++i) {
    const int corner = surface.corner_at[i];
    visit(surface.triangle[next_corner(corner)]);
    visit(surface.triangle[previous_corner(corner)]);
  }
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

// The vertices of the other side through which a piece reaches the rest of its own side, if that changes less than to
// give the piece up. Empty if not.
std::vector<int> bridge(const Surface& surface, const std::vector<float>& function, const Pieces& pieces, int number) {
  const Piece& piece = pieces.piece[number];
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  std::map<int, std::pair<double, int>> reached;  // vertex -> change on the way there, vertex before
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
    if (pieces.piece[pieces.of[v]].positive == piece.positive && pieces.of[v] != number) {
      std::vector<int> way;
      for (int w = reached[v].second; pieces.of[w] != number; w = reached[w].second) way.push_back(w);
      return way;
    }
    for_each_neighbor(surface, v, [&, at = change, from = v](int w) {
      const bool own = pieces.piece[pieces.of[w]].positive == piece.positive;
      reach(w, at + (own ? 0 : change_of(surface, function, w)), from);
    });
  }
  return {};
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

void connect_sides(const Surface& surface, std::vector<float>& function) {
  Pieces pieces = pieces_of(surface, function);
  for (std::size_t rounds = pieces.piece.size(); rounds > 0; --rounds) {
    int largest[2] = {-1, -1}, smallest = -1;
    const auto area = [&](int number) { return pieces.piece[number].area; };
    const int count = static_cast<int>(pieces.piece.size());
    for (int i = 0; i < count; ++i) {
      int& side = largest[pieces.piece[i].positive];
      if (side < 0 || area(i) > area(side)) side = i;
    }
    for (int i = 0; i < count; ++i)
      if (i != largest[0] && i != largest[1] && !pieces.piece[i].border && (smallest < 0 || area(i) < area(smallest)))
        smallest = i;
    if (smallest < 0) return;
    const bool positive = pieces.piece[smallest].positive;
    std::vector<int> over = bridge(surface, function, pieces, smallest);
    const bool joins = !over.empty();
    if (!joins) over = pieces.piece[smallest].vertices;
    for (const int v : over) {
      const float size = std::max(std::abs(function[v]), std::numeric_limits<float>::min());
      function[v] = positive == joins ? size : -size;
    }
    pieces = pieces_of(surface, function);
  }
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
