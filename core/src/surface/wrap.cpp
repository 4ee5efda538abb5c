// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/wrap.h"

#include <vcg/complex/complex.h>
// After complex.h.
#include <vcg/complex/algorithms/create/marching_cubes.h>
#include <vcg/complex/algorithms/create/mc_trivial_walker.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <type_traits>
#include <unordered_set>
#include <utility>

#include "ga_symmetry/errors.h"
#include "surface/nearest_point.h"
#include "util/disjoint_sets.h"

namespace ga_symmetry {
namespace {

using Point = Eigen::Vector3f;

// Distances at the nodes of a grid, exact up to a reach and the reach beyond it.
struct Grid {
  std::array<int, 3> size{};  // nodes
  Point low;                  // position of node 0
  float spacing = 0, reach = 0;
  std::vector<float> distance;

  int index(int x, int y, int z) const { return (z * size[1] + y) * size[0] + x; }
  std::array<int, 3> node(int i) const { return {i % size[0], i / size[0] % size[1], i / (size[0] * size[1])}; }
  Point at(int i) const {
    const auto n = node(i);
    return low + spacing * Point(static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]));
  }
  template <class Distance>
  void lower(const Point& from, const Point& to, const Distance& measure) {
    int first[3], last[3];
    for (int k = 0; k < 3; ++k) {
      first[k] = std::max(0, static_cast<int>(std::ceil((from[k] - reach - low[k]) / spacing)));
      last[k] = std::min(size[k] - 1, static_cast<int>(std::floor((to[k] + reach - low[k]) / spacing)));
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          float& d = distance[index(x, y, z)];
          d = std::min(d, measure(Point(low + spacing * Point(static_cast<float>(x), static_cast<float>(y),
                                                              static_cast<float>(z)))));
        }
  }
  void add_point(const Point& p) {
    lower(p, p, [&](const Point& at) { return (at - p).norm(); });
  }
};

// Halves a triangle along its longest edge until it spans few nodes, so that its box holds little that is far from it.
template <class Visit>
void cut_small(const Point& a, const Point& b, const Point& c, float size, const Visit& visit) {
  const float ab = (a - b).squaredNorm(), bc = (b - c).squaredNorm(), ca = (c - a).squaredNorm();
  if (std::max({ab, bc, ca}) <= size * size) return visit(a, b, c);
  if (ab >= bc && ab >= ca) {
    const Point m = 0.5f * (a + b);
    cut_small(a, m, c, size, visit), cut_small(m, b, c, size, visit);
  } else if (bc >= ca) {
    const Point m = 0.5f * (b + c);
    cut_small(a, b, m, size, visit), cut_small(a, m, c, size, visit);
  } else {
    const Point m = 0.5f * (c + a);
    cut_small(a, b, m, size, visit), cut_small(m, b, c, size, visit);
  }
}

void add_faces(Grid& grid, const std::vector<double>& position, const std::vector<int>& triangle,
               const Context& context) {
  const auto at = [&](int v) {
    const double* p = &position[3 * static_cast<std::size_t>(v)];
    return Point(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  };
  // Of triangles far below the grid's spacing one for each small cell will do: its centre, as a point.
  const float cell = 0.4f * grid.spacing;
  std::unordered_set<std::uint64_t> seen;
  for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
    if (f % 16384 == 0) context.report(static_cast<double>(3 * f) / static_cast<double>(triangle.size()), "wrapping");
    const Point a = at(triangle[3 * f]), b = at(triangle[3 * f + 1]), c = at(triangle[3 * f + 2]);
    if (std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()}) < cell * cell) {
      const Point m = (a + b + c) / 3;
      std::uint64_t key = 0;
      for (int k = 0; k < 3; ++k) key = key << 21 | static_cast<std::uint64_t>((m[k] - grid.low[k]) / cell);
      if (seen.insert(key).second) grid.add_point(m);
      continue;
    }
    cut_small(a, b, c, 6 * grid.spacing, [&](const Point& p, const Point& q, const Point& r) {
      grid.lower(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r),
                 [&](const Point& x) { return std::sqrt(squared_distance_to_triangle(x, p, q, r)); });
    });
  }
}

constexpr std::array<std::array<int, 3>, 6> kSides{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

template <class Visit>
void for_each_side(const Grid& g, int i, const Visit& visit) {
  const auto n = g.node(i);
  for (const auto& s : kSides) {
    const int x = n[0] + s[0], y = n[1] + s[1], z = n[2] + s[2];
    if (x >= 0 && y >= 0 && z >= 0 && x < g.size[0] && y < g.size[1] && z < g.size[2]) visit(g.index(x, y, z));
  }
}

// What lies inside becomes solid: only what the outside reaches stays empty. Node 0 is outside.
void fill_voids(Grid& g, float level) {
  std::vector<char> outside(g.distance.size(), 0);
  std::vector<int> stack{0};
  outside[0] = 1;
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    for_each_side(g, i, [&](int j) {
      if (!outside[j] && g.distance[j] > level) outside[j] = 1, stack.push_back(j);
    });
  }
  for (std::size_t i = 0; i < outside.size(); ++i)
    if (!outside[i] && g.distance[i] > level) g.distance[i] = 0;
}

// Solid nodes that hang together: label per node (-1 = empty), and the number of labels.
std::vector<int> label_solids(const Grid& g, float level, int& count) {
  std::vector<int> label(g.distance.size(), -1), stack;
  count = 0;
  for (std::size_t start = 0; start < label.size(); ++start) {
    if (label[start] >= 0 || g.distance[start] > level) continue;
    label[start] = count;
    stack.push_back(static_cast<int>(start));
    while (!stack.empty()) {
      const int i = stack.back();
      stack.pop_back();
      for_each_side(g, i, [&](int j) {
        if (label[j] < 0 && g.distance[j] <= level) label[j] = count, stack.push_back(j);
      });
    }
    ++count;
  }
  return label;
}

// Joins solids that are neighbours. @return gaps bridged
int bridge_gaps(Grid& g, float level, const Context& context) {
  constexpr float kAsNear = 1.15f;  // times a gap's least width is still the gap
  constexpr float kMuchWider = 1.2f;
  int count = 0;
  std::vector<int> label = label_solids(g, level, count);
  if (count == 1) return 0;
  // The nearest solid node of every empty one, as it spreads from neighbour to neighbour.
  const int n = static_cast<int>(g.distance.size());
  std::vector<int> source(n, -1);
  std::vector<float> away(n, std::numeric_limits<float>::infinity());
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (int i = 0; i < n; ++i)
    if (label[i] >= 0) source[i] = i, away[i] = 0;
  for (int i = 0; i < n; ++i)
    if (label[i] >= 0) {
      bool rim = false;
      for_each_side(g, i, [&](int j) { rim = rim || label[j] < 0; });
      if (rim) queue.push({0.f, i});
    }
  while (!queue.empty()) {
    const auto [d, i] = queue.top();
    queue.pop();
    if (d > away[i]) continue;
    for_each_side(g, i, [&, s = source[i]](int j) {
      const float now = (g.at(j) - g.at(s)).norm();
      if (now < away[j]) away[j] = now, source[j] = s, queue.push({now, j});
    });
  }
  if (context.cancelled()) throw Cancelled();
  // Where two regions meet.
  struct Meeting {
    float width;
    int a, b;  // solid nodes on both sides
  };
  std::map<std::pair<int, int>, std::vector<Meeting>> meetings;
  for (int i = 0; i < n; ++i)
    for_each_side(g, i, [&](int j) {
      const int x = label[source[i]], y = label[source[j]];
      if (x < y) meetings[{x, y}].push_back({(g.at(source[i]) - g.at(source[j])).norm(), source[i], source[j]});
    });
  std::map<std::pair<int, int>, float> gap;
  for (const auto& [pair, list] : meetings)
    gap[pair] = std::min_element(list.begin(), list.end(), [](const auto& p, const auto& q) {
                  return p.width < q.width;
                })->width;
  // A gap is passed over where a way over third solids has much smaller ones only (relative neighbourhood; with a
  // tolerance, so that gaps of the same width on both sides are treated alike). What is left hangs together.
  std::vector<std::pair<float, std::pair<int, int>>> by_width;
  for (const auto& [pair, width] : gap) by_width.push_back({width, pair});
  std::sort(by_width.begin(), by_width.end());
  DisjointSets together(count);
  int bridged = 0;
  std::vector<Point> filling;
  std::size_t joined = 0;  // those of by_width that are joined: all that are much narrower than the present one
  for (const auto& [width, pair] : by_width) {
    for (; joined < by_width.size() && by_width[joined].first * kMuchWider < width; ++joined)
      together.join(by_width[joined].second.first, by_width[joined].second.second);
    if (together.find(pair.first) == together.find(pair.second)) continue;
    ++bridged;
    for (const Meeting& m : meetings[pair]) {
      if (m.width > kAsNear * width + g.spacing) continue;
      const Point p = g.at(m.a), q = g.at(m.b);
      const int steps = std::max(1, static_cast<int>(std::ceil((q - p).norm() / (0.7f * g.spacing))));
      for (int s = 0; s <= steps; ++s)
        filling.push_back(p + (q - p) * (static_cast<float>(s) / static_cast<float>(steps)));
    }
  }
  std::unordered_set<std::uint64_t> seen;
  for (const Point& p : filling) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key = key << 21 | static_cast<std::uint64_t>((p[k] - g.low[k]) / (0.4f * g.spacing));
    if (seen.insert(key).second) g.add_point(p);
  }
  return bridged;
}

class WrapVertex;
class WrapFace;
struct WrapTypes : vcg::UsedTypes<vcg::Use<WrapVertex>::AsVertexType, vcg::Use<WrapFace>::AsFaceType> {};
class WrapVertex : public vcg::Vertex<WrapTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::BitFlags> {};
class WrapFace : public vcg::Face<WrapTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class WrapMesh : public vcg::tri::TriMesh<std::vector<WrapVertex>, std::vector<WrapFace>> {};

// The grid as vcglib's marching cubes ask for it.
class Volume {
 public:
  Volume(const Grid& grid, float level) : grid_(grid), level_(level) {}
  vcg::Point3i ISize() const { return {grid_.size[0] + 1, grid_.size[1] + 1, grid_.size[2] + 1}; }
  // Never the level itself, or corners of faces would coincide.
  float Val(int x, int y, int z) const {
    const float off = grid_.distance[grid_.index(x, y, z)] - level_, least = 0.02f * grid_.spacing;
    return level_ + (off > 0 ? std::max(off, least) : std::min(off, -least));
  }
  bool ValidCell(const vcg::Point3i&, const vcg::Point3i&) const { return true; }
  template <class Vertex>
  void GetXIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex& v, float) const {
    set(a, b, v);
  }
  template <class Vertex>
  void GetYIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex& v, float) const {
    set(a, b, v);
  }
  template <class Vertex>
  void GetZIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex& v, float) const {
    set(a, b, v);
  }

 private:
  template <class Vertex>
  void set(const vcg::Point3i& a, const vcg::Point3i& b, Vertex& v) const {
    const float fa = Val(a[0], a[1], a[2]) - level_, fb = Val(b[0], b[1], b[2]) - level_, t = fa / (fa - fb);
    for (int k = 0; k < 3; ++k)
      v->P()[k] = grid_.low[k] + grid_.spacing * (static_cast<float>(a[k]) * (1 - t) + static_cast<float>(b[k]) * t);
  }
  const Grid& grid_;
  const float level_;
};

// vcglib's walker never frees its slices where they are plain arrays; in later releases they are vectors.
template <class Slice>
void free_slice(Slice& slice) {
  if constexpr (std::is_pointer_v<Slice>) delete[] slice;
}

// For BuildMesh, which makes the slices, alone.
struct Walker : vcg::tri::TrivialWalker<WrapMesh, Volume> {
  ~Walker() { free_slice(_x_cs), free_slice(_y_cs), free_slice(_z_cs), free_slice(_x_ns), free_slice(_z_ns); }
};

TriangleMesh boundary(const Grid& grid, float level) {
  Volume volume(grid, level);
  WrapMesh mesh;
  Walker walker;
  vcg::tri::MarchingCubes<WrapMesh, Walker> extractor(mesh, walker);
  walker.BuildMesh(mesh, volume, extractor, level);
  return to_triangle_mesh(mesh);
}

}  // namespace

Wrap wrap(const std::vector<double>& position, const std::vector<int>& triangle, double spacing,
          const Context& context) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (int v : triangle) {
    const Eigen::Vector3d p(&position[3 * static_cast<std::size_t>(v)]);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  constexpr double kMostNodes = 250;  // along the longest side: 16 million nodes at most
  spacing = std::max(spacing, (high - low).maxCoeff() / kMostNodes);
  constexpr int kMargin = 4;  // nodes around everything, so that the outside hangs together
  Grid grid;
  grid.spacing = static_cast<float>(spacing);
  grid.reach = 2.1f * grid.spacing;
  grid.low = (low - Eigen::Vector3d::Constant(kMargin * spacing)).cast<float>();
  std::size_t nodes = 1;
  for (int k = 0; k < 3; ++k) {
    grid.size[k] = static_cast<int>(std::ceil((high[k] - low[k]) / spacing)) + 2 * kMargin + 1;
    nodes *= static_cast<std::size_t>(grid.size[k]);
  }
  grid.distance.assign(nodes, grid.reach);
  const float level = grid.spacing;
  Wrap out;
  out.spacing = spacing;
  add_faces(grid, position, triangle, context.part(0, 0.7));
  fill_voids(grid, level);
  out.bridged = bridge_gaps(grid, level, context);
  if (out.bridged > 0) fill_voids(grid, level);
  context.report(0.8, "wrapping");
  out.mesh = boundary(grid, level);
  context.report(1, "wrapping");
  return out;
}

}  // namespace ga_symmetry
