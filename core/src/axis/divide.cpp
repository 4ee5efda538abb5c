// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/divide.h"

#include "axis/sides.h"
#include "axis/zero_set.h"
#include "surface/neighbors.h"
#include "surface/welded_mesh.h"

namespace ga_symmetry {
namespace {

// (f(v) - f(partner(v))) / 2, smoothed over the surface, as partners are vertices and no exact points.
std::vector<float> antisymmetric(const Surface& surface, const std::vector<float>& function,
                                 const std::vector<int>& partner) {
  constexpr int kSmoothing = 10;  // rounds, in which a value spreads over about three edges
  std::vector<float> out = function;
  for (int v = 0; v < surface.vertices(); ++v)
    if (const int w = partner[v]; w >= 0) out[v] = 0.5f * (function[v] - function[w]);
  for (int round = 0; round < kSmoothing; ++round) {
    const std::vector<float> before = out;
    for (int v = 0; v < surface.vertices(); ++v) {
      float sum = 0;
      int count = 0;
      for_each_neighbor(surface, v, [&](int w) { sum += before[w], ++count; });
      if (count > 0) out[v] = 0.5f * (before[v] + sum / static_cast<float>(count));
    }
  }
  return out;
}

}  // namespace

Division divide(const Surface& surface, const std::vector<float>& left_right, const std::vector<int>& partner) {
  // Of the total length. Lines of a closed surface are all of the axis, however short beside the others; at a border,
  // where stray pieces stay, so short a line is one of theirs.
  constexpr double kShortest = 0.05;
  std::vector<float> function = antisymmetric(surface, left_right, partner);
  int parts = 0;
  face_parts(surface.triangle, surface.vertices(), parts);
  if (parts == 1) connect_sides(surface, function);  // of several, many have one sign only, as they should
  return {sides(surface, function), zero_set(surface, function, kShortest)};
}

}  // namespace ga_symmetry
