// SPDX-License-Identifier: GPL-3.0-or-later
#include "complete.h"

#include <algorithm>
#include <set>

namespace samples {
namespace {

constexpr double kSame = 1e-9;  // cm; rounding of coordinates below 200 cm is 1e-14

int element_of(const Eigen::Matrix3d& matrix, const std::vector<Eigen::Matrix3d>& group) {
  for (std::size_t g = 0; g < group.size(); ++g)
    if ((group[g] - matrix).norm() < kSame) return static_cast<int>(g);
  throw std::runtime_error("broken promise: the symmetries form a group");
}

std::vector<int> border_vertices(const Mesh& mesh) {
  std::set<std::pair<int, int>> open;
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) {
      const int a = f[k], b = f[(k + 1) % 3];
      if (!open.erase({b, a})) open.insert({a, b});
    }
  std::vector<int> out;
  for (const auto& e : open) out.push_back(e.first);
  std::sort(out.begin(), out.end());
  return out;
}

Face lowest_first(Face f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

void check(const Symmetric& s, const std::vector<Eigen::Matrix3d>& group) {
  std::set<Face> faces;
  for (const Face& f : s.mesh.face) faces.insert(lowest_first(f));
  require(faces.size() == s.mesh.face.size(), "faces are distinct");
  for (std::size_t g = 0; g < group.size(); ++g) {
    const std::vector<int>& to = s.image[g];
    for (int v = 0; v < s.mesh.points(); ++v)
      require((group[g] * s.mesh.point[v] - s.mesh.point[to[v]]).norm() < kSame, "vertices map onto vertices");
    for (const Face& f : s.mesh.face) {
      Face image = {to[f[0]], to[f[1]], to[f[2]]};
      if (group[g].determinant() < 0) std::swap(image[1], image[2]);
      require(faces.count(lowest_first(image)) == 1, "faces map onto faces");
    }
  }
}

}  // namespace

Symmetric complete(const Mesh& piece, const std::vector<Eigen::Matrix3d>& group) {
  const std::size_t order = group.size();
  Symmetric s;
  std::vector<int> vertex(piece.point.size() * order, -1);  // of piece vertex i under element g
  std::vector<int> joined;                                  // whole vertices on a seam
  const std::vector<int> border = border_vertices(piece);
  for (int i : border)
    for (std::size_t g = 0; g < order; ++g) {
      const Vec3 p = group[g] * piece.point[i];
      const auto same = std::find_if(joined.begin(), joined.end(),
                                     [&](int v) { return (s.mesh.point[v] - p).squaredNorm() < kSame * kSame; });
      vertex[i * order + g] = same != joined.end() ? *same : s.mesh.points();
      if (same != joined.end()) continue;
      joined.push_back(s.mesh.points());
      s.mesh.point.push_back(p);
    }
  for (std::size_t i = 0; i < piece.point.size(); ++i)
    for (std::size_t g = 0; g < order; ++g)
      if (vertex[i * order + g] < 0) {
        vertex[i * order + g] = s.mesh.points();
        s.mesh.point.push_back(group[g] * piece.point[i]);
      }
  for (std::size_t g = 0; g < order; ++g)
    for (const Face& f : piece.face) {
      Face image;
      for (int k = 0; k < 3; ++k) image[k] = vertex[f[k] * order + g];
      if (group[g].determinant() < 0) std::swap(image[1], image[2]);
      s.mesh.face.push_back(image);
    }
  s.image.assign(order, std::vector<int>(s.mesh.point.size(), -1));
  for (std::size_t g = 0; g < order; ++g)
    for (std::size_t h = 0; h < order; ++h) {
      const int product = element_of(group[g] * group[h], group);
      for (std::size_t i = 0; i < piece.point.size(); ++i)
        s.image[g][vertex[i * order + h]] = vertex[i * order + product];
    }
  check(s, group);
  return s;
}

}  // namespace samples
