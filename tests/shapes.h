// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes whose properties are known by construction.
#pragma once
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "ga_symmetry/mesh.h"
#include "util/random.h"

namespace ga_symmetry::shapes {

/// A closed surface: `rings` circles of `segments` vertices from the north to the south of the unit sphere, then both
/// poles; every vertex is moved by deform(x, y, z).
template <class Deform>
TriangleMesh globe(int rings, int segments, const Deform& deform) {
  const double pi = std::acos(-1.0);
  TriangleMesh mesh;
  const auto add = [&](double x, double y, double z) {
    deform(x, y, z);
    mesh.position.insert(mesh.position.end(), {x, y, z});
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double u = pi * (i + 1) / (rings + 1), v = 2 * pi * j / segments;
      add(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u));
    }
  add(0, 0, 1);
  add(0, 0, -1);
  const int north = rings * segments, south = north + 1;
  for (int j = 0; j < segments; ++j) {
    const int next = (j + 1) % segments, last = (rings - 1) * segments;
    mesh.triangle.insert(mesh.triangle.end(), {north, j, next, south, last + next, last + j});
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = i * segments + j, b = i * segments + next;
      mesh.triangle.insert(mesh.triangle.end(), {a, a + segments, b + segments, a, b + segments, b});
    }
  }
  return mesh;
}

inline TriangleMesh sphere(int rings = 11, int segments = 16) {
  return globe(rings, segments, [](double&, double&, double&) {});
}

/// Larger than the sphere and mirrored in x: a head at (0,0,2), one foot at (0,-0.5,-3), arms at (2,0,0.6) and
/// (-2,0,0.6), about.
inline TriangleMesh body() {
  return globe(35, 48, [](double& x, double& y, double& z) {
    const auto bump = [&](double a, double b, double c, double height) {
      const double cosine = (a * x + b * y + c * z) / std::sqrt(a * a + b * b + c * c);
      return height * std::exp(15 * (cosine - 1));
    };
    const double radius = 1 + bump(0, 0, 1, 1) + bump(0, -0.5, -3, 2) + bump(2, 0, 0.6, 1.1) + bump(-2, 0, 0.6, 1.1);
    x *= radius, y *= radius, z *= radius;
  });
}

/// A one-sided strip of width 0.5 around a circle of radius 1, open; `along` * `across` vertices.
inline TriangleMesh moebius_strip(int along = 40, int across = 6) {
  TriangleMesh mesh;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::acos(-1.0) * i / along, w = 0.5 * j / (across - 1) - 0.25;
      const double r = 1 + w * std::cos(u / 2);
      mesh.position.insert(mesh.position.end(), {r * std::cos(u), r * std::sin(u), w * std::sin(u / 2)});
    }
  for (int i = 0; i < along; ++i)
    for (int j = 0; j + 1 < across; ++j) {
      const bool seam = i + 1 == along;  // half a turn: column j meets column across - 1 - j
      const int a = i * across + j, b = seam ? across - 1 - j : a + across, c = seam ? b - 1 : b + 1;
      mesh.triangle.insert(mesh.triangle.end(), {a, b, c, a, c, a + 1});
    }
  return mesh;
}

/// Both in one, apart.
inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int n = a.vertices();
  for (std::size_t i = 0; i < b.position.size(); ++i) a.position.push_back(b.position[i] + (i % 3 ? 0 : 10));
  for (int v : b.triangle) a.triangle.push_back(n + v);
  return a;
}

inline TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (double& x : mesh.position) x *= factor;
  return mesh;
}

inline int nearest_vertex(const TriangleMesh& mesh, double x, double y, double z) {
  int best = 0;
  double lowest = INFINITY;
  for (int v = 0; v < mesh.vertices(); ++v) {
    const double* p = &mesh.position[3 * v];
    const double d = std::hypot(p[0] - x, p[1] - y, p[2] - z);
    if (d < lowest) lowest = d, best = v;
  }
  return best;
}

/// Vertices in a random order: vertex v becomes to[v], if asked.
inline TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed, std::vector<int>* to = nullptr) {
  Random random(seed);
  std::vector<int> order(mesh.vertices());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[draw_below(random, i)]);
  TriangleMesh out = mesh;
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int k = 0; k < 3; ++k) out.position[3 * order[v] + k] = mesh.position[3 * v + k];
  for (int& v : out.triangle) v = order[v];
  if (to) *to = order;
  return out;
}

}  // namespace ga_symmetry::shapes
