// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace ga_symmetry {

void split_long_edges(std::vector<double>& position, std::vector<int>& triangle, double length) {
  const auto squared = [&](int a, int b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = position[3 * static_cast<std::size_t>(a) + k] - position[3 * static_cast<std::size_t>(b) + k];
      sum += d * d;
    }
    return sum;
  };
  for (bool again = true; again;) {
    again = false;
    // A face is split at its longest edge only, and its neighbour there with it, so that no angle becomes much smaller
    // (Rivara 1984); an edge that is not its neighbour's longest is split there all the same, lest a gap opens.
    std::unordered_map<std::uint64_t, int> middle;
    const auto key = [](int a, int b) {
      return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
    };
    for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
      int corner = 0;
      double most = -1;
      for (int k = 0; k < 3; ++k)
        if (const double d = squared(triangle[3 * f + k], triangle[3 * f + (k + 1) % 3]); d > most)
          most = d, corner = k;
      if (most <= length * length) continue;
      const int a = triangle[3 * f + corner], b = triangle[3 * f + (corner + 1) % 3];
      const auto [it, fresh] = middle.try_emplace(key(a, b), static_cast<int>(position.size() / 3));
      if (!fresh) continue;
      for (int k = 0; k < 3; ++k)
        position.push_back(
            0.5 * (position[3 * static_cast<std::size_t>(a) + k] + position[3 * static_cast<std::size_t>(b) + k]));
    }
    if (middle.empty()) break;
    again = true;
    std::vector<int> next;
    next.reserve(2 * triangle.size());
    for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
      std::array<int, 3> t{triangle[3 * f], triangle[3 * f + 1], triangle[3 * f + 2]}, m{};
      int split = 0;
      for (int k = 0; k < 3; ++k) {
        const auto it = middle.find(key(t[k], t[(k + 1) % 3]));
        m[k] = it == middle.end() ? -1 : it->second;
        split += m[k] >= 0;
      }
      const auto add = [&](int a, int b, int c) { next.insert(next.end(), {a, b, c}); };
      const auto turn = [&] {
        std::rotate(t.begin(), t.begin() + 1, t.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      };
      switch (split) {
        case 0:
          add(t[0], t[1], t[2]);
          break;
        case 1:
          while (m[0] < 0) turn();
          add(t[0], m[0], t[2]), add(m[0], t[1], t[2]);
          break;
        case 2:
          while (m[2] >= 0) turn();  // m[0] and m[1] are split
          add(m[0], t[1], m[1]);
          if (squared(t[0], m[1]) <= squared(m[0], t[2]))
            add(t[0], m[0], m[1]), add(t[0], m[1], t[2]);
          else
            add(t[0], m[0], t[2]), add(m[0], m[1], t[2]);
          break;
        default:
          add(t[0], m[0], m[2]), add(m[0], t[1], m[1]), add(m[2], m[1], t[2]), add(m[0], m[1], m[2]);
      }
    }
    triangle.swap(next);
  }
}

}  // namespace ga_symmetry
