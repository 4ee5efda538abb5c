// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ga_symmetry/errors.h"
#include "io/mesh_formats.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

// Coordinates of the corners of a binary STL's triangles, or nothing if the size is not the one it promises.
std::vector<float> binary_corners(std::string_view text) {
  constexpr std::size_t kHeader = 80, kFacet = 50, kNormal = 12, kCorners = 36;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(text[at + i]);
    return value;
  };
  if (text.size() < kHeader + 4 || (text.size() - kHeader - 4) / kFacet < word(kHeader)) return {};
  const std::size_t facets = word(kHeader);
  std::vector<float> corners;
  corners.reserve(9 * facets);
  for (std::size_t f = 0; f < facets; ++f)
    for (std::size_t at = 0; at < kCorners; at += 4) {
      const std::uint32_t bits = word(kHeader + 4 + kFacet * f + kNormal + at);
      float x;
      std::memcpy(&x, &bits, sizeof x);
      corners.push_back(x);
    }
  return corners;
}

std::vector<float> text_corners(std::string_view text, const Context& context) {
  std::vector<float> corners;
  std::size_t facets = 0;
  bool closed = false;
  TextScanner words(text);
  for (long row = 0; words.next(); ++row) {
    report_reading(row, static_cast<double>(text.size() - words.rest().size()), static_cast<double>(text.size()),
                   context);
    const std::string_view keyword = words.word();
    words.drop(keyword.size());
    closed = keyword == "endsolid";
    facets += keyword == "endfacet";
    if (keyword == "vertex")
      for (int k = 0; k < 3; ++k) {
        double x;
        if (!words.next_in_line() || !words.read(x)) refuse_line(words.line(), "a vertex needs three coordinates");
        corners.push_back(static_cast<float>(x));
      }
    words.next_line();
  }
  if (!closed) throw FileError("the file ends within a solid: it is cut short or damaged");
  if (corners.size() != 9 * facets) throw FileError("its facets are not all triangles");
  return corners;
}

}  // namespace

// Corners of the same coordinates are one vertex; faces that this leaves with less than three are dropped.
TriangleMesh read_stl(std::string_view text, const Context& context) {
  std::vector<float> corners = binary_corners(text);
  if (corners.empty() && text.substr(0, 5) == "solid") corners = text_corners(text, context);
  if (corners.empty()) throw FileError("it holds no triangles, or is not an STL of the size that it promises");
  using Corner = std::array<float, 3>;
  struct Hash {
    std::size_t operator()(const Corner& c) const {
      return std::hash<std::string_view>()({reinterpret_cast<const char*>(c.data()), sizeof c});
    }
  };
  std::unordered_map<Corner, int, Hash> vertex_at;
  vertex_at.reserve(corners.size() / 12);  // a closed surface has half as many vertices as triangles, or less
  TriangleMesh mesh;
  for (std::size_t f = 0; f < corners.size() / 9; ++f) {
    if (f % 4096 == 0 && context.cancelled()) throw Cancelled();
    std::array<int, 3> face;
    for (int k = 0; k < 3; ++k) {
      Corner corner;
      for (int i = 0; i < 3; ++i) corner[i] = corners[9 * f + 3 * k + i] + 0.0f;                 // -0 is 0
      if (!std::all_of(corner.begin(), corner.end(), [](float x) { return std::isfinite(x); }))  // and so equal to none
        throw FileError("triangle " + std::to_string(f) + " has a coordinate that is not finite");
      const auto [it, fresh] = vertex_at.try_emplace(corner, mesh.vertices());
      if (fresh) mesh.position.insert(mesh.position.end(), corner.begin(), corner.end());
      face[k] = it->second;
    }
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0])
      mesh.triangle.insert(mesh.triangle.end(), face.begin(), face.end());
  }
  return mesh;
}

}  // namespace ga_symmetry
