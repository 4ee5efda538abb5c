// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/locate.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

#include "surface/nearest_point.h"
#include "util/parallel.h"

namespace ga_symmetry {

using Vector = Eigen::Vector3d;

std::vector<std::array<double, 3>> vertex_normals(const std::vector<double>& position,
                                                  const std::vector<int>& triangle) {
  std::vector<std::array<double, 3>> out(position.size() / 3, {0, 0, 0});
  const auto at = [&](int v) { return Vector(&position[3 * static_cast<std::size_t>(v)]); };
  for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
    const Vector a = at(triangle[3 * f]), n = (at(triangle[3 * f + 1]) - a).cross(at(triangle[3 * f + 2]) - a);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) out[triangle[3 * f + k]][i] += n[i];
  }
  return out;
}

std::vector<SurfacePoint> locate(const Surface& mesh, const Surface& s, int threads) {
  constexpr int kNear = 6;            // vertices whose faces are looked at: the nearest point is among them
  constexpr double kOtherSide = 0.7;  // mean edges that facing away counts as
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> points(s.position.data(),
                                                                                           s.vertices(), 3);
  const nanoflann::KDTreeEigenMatrixAdaptor<decltype(points), 3> tree(3, std::cref(points));
  const auto normals = vertex_normals(mesh.position, mesh.triangle);
  std::vector<Vector> face_normal(s.triangles());
  for (int f = 0; f < s.triangles(); ++f) {
    const Vector a(s.point(s.triangle[3 * f]));
    face_normal[f] = (Vector(s.point(s.triangle[3 * f + 1])) - a).cross(Vector(s.point(s.triangle[3 * f + 2])) - a);
  }
  const double away = kOtherSide * std::sqrt(2 * s.area / s.triangles());
  std::vector<SurfacePoint> out(mesh.vertices());
  constexpr int kBlock = 1024;
  parallel_blocks(mesh.vertices(), kBlock, threads, [&](int begin, int end, int) {
    for (int p = begin; p < end; ++p) {
      const Vector at(mesh.point(p)), normal(normals[p].data());
      std::array<Eigen::Index, kNear> near{};
      std::array<double, kNear> squared{};
      const auto found = tree.index->knnSearch(at.data(), kNear, near.data(), squared.data());
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < found; ++i) {
        const int v = static_cast<int>(near[i]);
        for (int k = s.first_corner[v]; k < s.first_corner[v + 1]; ++k) {
          const int f = s.corner_at[k] / 3, *t = &s.triangle[3 * static_cast<std::size_t>(f)];
          const Vector a(s.point(t[0])), ab = Vector(s.point(t[1])) - a, ac = Vector(s.point(t[2])) - a;
          const Vector ap = at - a;
          double x, y;
          nearest_in_triangle(ap, ab, ac, x, y);
          double d = (ap - x * ab - y * ac).norm();
          if (s.orientable && normal.dot(face_normal[f]) < 0) d += away;
          if (d < least) least = d, out[p] = {{t[0], t[1], t[2]}, {std::max(0.0, 1 - x - y), x, y}};
        }
      }
    }
  });
  return out;
}

}  // namespace ga_symmetry
