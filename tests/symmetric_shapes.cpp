// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetric_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "util/random.h"

namespace ga_symmetry::shapes {
namespace {

constexpr double kPi = 3.14159265358979323846;

void normalize(double* p) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int k = 0; k < 3; ++k) p[k] /= length;
}

// Two triangles for the cell between rows i, i+1 and columns j, j+1.
void add_cell(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangle.insert(mesh.triangle.end(), {a, b, c, a, c, d});
}

}  // namespace

TriangleMesh icosphere(int level) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  mesh.position = {-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
                   0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1};
  mesh.triangle = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                   3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
  for (int v = 0; v < 12; ++v) normalize(&mesh.position[3 * v]);
  for (int step = 0; step < level; ++step) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), mesh.vertices());
      if (fresh) {
        double p[3];
        for (int k = 0; k < 3; ++k) p[k] = mesh.position[3 * a + k] + mesh.position[3 * b + k];
        normalize(p);
        mesh.position.insert(mesh.position.end(), p, p + 3);
      }
      return it->second;
    };
    std::vector<int> finer;
    for (std::size_t i = 0; i < mesh.triangle.size(); i += 3) {
      const int a = mesh.triangle[i], b = mesh.triangle[i + 1], c = mesh.triangle[i + 2];
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    mesh.triangle = std::move(finer);
  }
  return mesh;
}

TriangleMesh torus(int around, int along, double tube) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / along, r = 1 + tube * std::cos(v);
      mesh.position.insert(mesh.position.end(), {r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const int next_i = (i + 1) % around, next_j = (j + 1) % along;
      add_cell(mesh, i * along + j, next_i * along + j, next_i * along + next_j, i * along + next_j);
    }
  return mesh;
}

TriangleMesh grid(int columns, int rows) {
  TriangleMesh mesh;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      mesh.position.insert(mesh.position.end(), {double(i) / (columns - 1), double(j) / (rows - 1), 0});
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int at = j * columns + i;
      add_cell(mesh, at, at + 1, at + columns + 1, at + columns);
    }
  return mesh;
}

Symmetric creature(int level) {
  Symmetric out;
  out.mesh = icosphere(level);
  const TriangleMesh ball = out.mesh;
  const int n = ball.vertices();
  std::map<std::array<long, 3>, int> at;
  const auto key = [&](int v, int sign) {
    const double* p = &ball.position[3 * v];
    return std::array<long, 3>{sign * std::lround(p[0] * 1e6), std::lround(p[1] * 1e6), std::lround(p[2] * 1e6)};
  };
  for (int v = 0; v < n; ++v) at[key(v, 1)] = v;
  for (int v = 0; v < n; ++v) out.partner.push_back(at.at(key(v, -1)));

  struct Bump {
    double x, y, z, height, sharpness;
  };
  // Arms and legs stand for both sides, at +x and -x.
  const Bump bumps[] = {
      {0, 0.15, 1, 0.7, 10}, {0, -1, -0.4, 0.9, 25}, {0.9, 0.2, 0.5, 1.4, 20}, {0.5, 0.1, -0.9, 1.2, 20}};
  for (int v = 0; v < n; ++v) {
    double* p = &out.mesh.position[3 * v];
    // Of a mirrored pair both get the radius of the one at +x, so that rounding cannot tell them apart.
    const double* d = &ball.position[3 * (p[0] >= 0 ? v : out.partner[v])];
    double radius = 1;
    for (const Bump& b : bumps) {
      const double norm = std::sqrt(b.x * b.x + b.y * b.y + b.z * b.z);
      for (int sign : {1, -1}) {
        if (b.x == 0 && sign < 0) continue;
        const double cosine = (sign * b.x * d[0] + b.y * d[1] + b.z * d[2]) / norm;
        radius += b.height * std::exp(b.sharpness * (cosine - 1));
      }
    }
    const double sign = out.partner[v] == v ? 0 : p[0] > 0 ? 1 : -1;
    p[0] = sign * std::abs(d[0]) * radius, p[1] = d[1] * radius, p[2] = d[2] * radius;
  }
  const auto extreme = [&](auto score) {
    int best = -1;
    for (int v = 0; v < n; ++v)
      if (best < 0 || score(v) > score(best)) best = v;
    return best;
  };
  const auto height = [&](int v) { return out.mesh.position[3 * v + 2]; };
  const auto on_axis = [&](int v) { return out.partner[v] == v ? 0.0 : -1e3; };
  out.axis = {extreme([&](int v) { return on_axis(v) + height(v); }),
              extreme([&](int v) { return on_axis(v) - out.mesh.position[3 * v + 1]; })};
  const int left = extreme([&](int v) { return out.mesh.position[3 * v]; });
  out.pair = {left, out.partner[left]};
  return out;
}

Symmetric bent(Symmetric shape, double curvature) {
  for (int v = 0; v < shape.mesh.vertices(); ++v) {
    double* p = &shape.mesh.position[3 * v];
    const double radius = 1 / curvature - p[0], angle = curvature * p[2];
    p[0] = 1 / curvature - radius * std::cos(angle);
    p[2] = radius * std::sin(angle);
  }
  return shape;
}

std::vector<int> random_permutation(int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<int> out(n);
  std::iota(out.begin(), out.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(out[i], out[draw_below(random, i + 1)]);
  return out;
}

TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<int>& permutation) {
  TriangleMesh out = mesh;
  for (int v = 0; v < mesh.vertices(); ++v) std::copy_n(&mesh.position[3 * v], 3, &out.position[3 * permutation[v]]);
  const int m = mesh.triangles();
  const std::vector<int> place = random_permutation(m, 7);
  for (int f = 0; f < m; ++f)
    for (int k = 0; k < 3; ++k) out.triangle[3 * place[f] + (k + f) % 3] = permutation[mesh.triangle[3 * f + k]];
  return out;
}

Symmetric renumbered(const Symmetric& shape, const std::vector<int>& permutation) {
  Symmetric out = shape;
  out.mesh = renumbered(shape.mesh, permutation);
  for (int v = 0; v < shape.mesh.vertices(); ++v) out.partner[permutation[v]] = permutation[shape.partner[v]];
  for (int k = 0; k < 2; ++k) {
    out.axis[k] = permutation[shape.axis[k]];
    out.pair[k] = permutation[shape.pair[k]];
  }
  return out;
}

Symmetric shuffled(const Symmetric& shape, std::uint64_t seed) {
  return renumbered(shape, random_permutation(shape.mesh.vertices(), seed));
}

TriangleMesh moved(TriangleMesh mesh, double scale) {
  const double axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, cosine = std::cos(0.7), sine = std::sin(0.7);
  for (int v = 0; v < mesh.vertices(); ++v) {
    double* p = &mesh.position[3 * v];
    const double q[3] = {p[0], p[1], p[2]};
    const double along = axis[0] * q[0] + axis[1] * q[1] + axis[2] * q[2];
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const double turned = q[k] * cosine + (axis[a] * q[b] - axis[b] * q[a]) * sine + axis[k] * along * (1 - cosine);
      p[k] = scale * (turned + k - 5);
    }
  }
  return mesh;
}

}  // namespace ga_symmetry::shapes
