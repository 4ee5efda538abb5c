// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh with every face cut in four at the middles of its edges; the vertices that there are keep their numbers.
#pragma once
#include <algorithm>
#include <map>
#include <utility>

#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

inline TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.position = mesh.position;
  std::map<std::pair<int, int>, int> middle;
  const auto between = [&](int a, int b) {
    const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), out.vertices());
    if (fresh)
      for (int k = 0; k < 3; ++k) out.position.push_back(0.5 * (mesh.position[3 * a + k] + mesh.position[3 * b + k]));
    return it->second;
  };
  for (std::size_t f = 0; f < mesh.triangle.size(); f += 3) {
    const int a = mesh.triangle[f], b = mesh.triangle[f + 1], c = mesh.triangle[f + 2];
    const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
    out.triangle.insert(out.triangle.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return out;
}

}  // namespace ga_symmetry
