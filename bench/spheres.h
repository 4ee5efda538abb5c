// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulated unit spheres, on which every geodesic is a great circle.
#pragma once
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "ga_symmetry/mesh.h"
#include "surface/surface.h"
#include "util/random.h"

namespace ga_symmetry::spheres {

inline void to_unit(double* p) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int k = 0; k < 3; ++k) p[k] /= length;
}

/// An icosahedron, each edge cut into `parts`: 10 parts^2 + 2 vertices, edges of about 1.2 / parts. Every coordinate is
/// moved at random by up to `jitter`, then back to the sphere; above 0.4 / parts faces may fold.
inline TriangleMesh icosphere(int parts, double jitter = 0) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const double corner[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const int face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  TriangleMesh mesh;
  Random random(1);
  std::map<std::array<int, 12>, int> index;  // by weight of each corner: faces share their borders
  const auto vertex = [&](const int* f, int i, int j) {
    std::array<int, 12> weight{};
    weight[f[0]] = parts - i - j, weight[f[1]] = i, weight[f[2]] = j;
    const auto [at, fresh] = index.try_emplace(weight, mesh.vertices());
    if (fresh) {
      double p[3] = {0, 0, 0};
      for (int c = 0; c < 12; ++c)
        for (int k = 0; k < 3; ++k) p[k] += weight[c] * corner[c][k];
      to_unit(p);
      for (double& x : p) x += jitter * (2 * draw_unit(random) - 1);
      to_unit(p);
      mesh.position.insert(mesh.position.end(), p, p + 3);
    }
    return at->second;
  };
  for (const auto& f : face)
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const int a = vertex(f, i, j), b = vertex(f, i + 1, j), c = vertex(f, i, j + 1);
        mesh.triangle.insert(mesh.triangle.end(), {a, b, c});
        if (i + j + 2 <= parts) mesh.triangle.insert(mesh.triangle.end(), {b, vertex(f, i + 1, j + 1), c});
      }
  return mesh;
}

/// Meridians and circles of latitude: slivers at the poles. (rings - 1) * segments + 2 vertices.
inline TriangleMesh uv_sphere(int rings, int segments) {
  const double pi = std::acos(-1.0);
  TriangleMesh mesh;
  mesh.position = {0, 0, 1, 0, 0, -1};
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double u = pi * i / rings, v = 2 * pi * j / segments;
      mesh.position.insert(mesh.position.end(), {std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)});
    }
  const auto at = [&](int i, int j) { return 2 + (i - 1) * segments + j % segments; };
  for (int j = 0; j < segments; ++j) {
    mesh.triangle.insert(mesh.triangle.end(), {0, at(1, j), at(1, j + 1), at(rings - 1, j), 1, at(rings - 1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      mesh.triangle.insert(mesh.triangle.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

/// The true distance on the unit sphere.
inline double great_circle(const double* a, const double* b) {
  const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return std::atan2(std::sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// Length of 1 in the unit of the surface that the door made of a mesh.
inline double scale_of(const TriangleMesh& mesh, const Surface& surface) {
  const int a = surface.triangle[0], b = surface.triangle[1];
  const double* p = &mesh.position[3 * surface.mesh_vertex[a]];
  const double* q = &mesh.position[3 * surface.mesh_vertex[b]];
  return surface.edge_length(a, b) / std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace ga_symmetry::spheres
