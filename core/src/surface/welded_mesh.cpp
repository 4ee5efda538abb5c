// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/welded_mesh.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "ga_symmetry/errors.h"
#include "util/disjoint_sets.h"

namespace ga_symmetry {
namespace {

// A face is without area when its area is below rounding in float coordinates, relative to its longest edge squared.
constexpr double kZeroArea = 1e-9;
// Vertices on a border are one when they are nearer than this share of the shortest edge at either: far below what
// anyone models, far above what a text file of six digits rounds.
constexpr double kSeam = 0.01;

// Twice the area, squared.
double squared_area(const double* a, const double* b, const double* c) {
  const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return x * x + y * y + z * z;
}

void check_input(const TriangleMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max();  // corners are numbered in int
  if (mesh.position.size() / 3 > kMost || mesh.triangle.size() > kMost)
    throw InvalidMesh("the mesh has more than " + std::to_string(kMost / 3) + " faces or " + std::to_string(kMost) +
                      " vertices: simplify it first");
  const int n = mesh.vertices();
  if (n == 0) throw InvalidMesh("the mesh is empty: open a mesh with triangles");
  if (mesh.triangles() == 0)
    throw InvalidMesh("the mesh has no faces (a point cloud): reconstruct a surface from its points first");
  for (int v : mesh.triangle)
    if (v < 0 || v >= n)
      throw InvalidMesh("a face refers to vertex " + std::to_string(v) + " of " + std::to_string(n) +
                        ": repair the mesh file");
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    if (!std::isfinite(mesh.position[i]))
      throw InvalidMesh("vertex " + std::to_string(i / 3) +
                        " has a coordinate that is not finite: repair or delete it");
}

// To the unit box before anything is squared, so that 1e-30 and 1e+30 neither vanish nor overflow.
std::vector<double> normalized(const TriangleMesh& mesh, double& size) {
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = INFINITY, high[k] = -INFINITY;
  for (int v : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const double x = mesh.position[3 * static_cast<std::size_t>(v) + k];
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
    }
  size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  if (!(size > 0) || !std::isfinite(size))
    throw InvalidMesh("the mesh has no extent that can be measured: check the scale of its coordinates");
  std::vector<double> out(mesh.position.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (mesh.position[i] - low[i % 3]) / size + 0.0;  // -0 is 0
  return out;
}

void stop_at(std::size_t i, const Context& context) {
  if (i % 65536 == 0 && context.cancelled()) throw Cancelled();
}

// The vertices that have a place, along a curve that fills space (Morton 1966); those of equal coordinates beside each
// other, the lowest first.
std::vector<int> along_curve(const std::vector<double>& position, const std::vector<int>& place) {
  constexpr unsigned kBits = 10;      // per axis
  const auto spread = [](double x) {  // its bits, two zeros between each two
    auto bits = static_cast<std::uint32_t>(x * ((1 << kBits) - 1));
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    return (bits | bits << 2) & 0x09249249;
  };
  const auto at = [&](int v) { return &position[3 * static_cast<std::size_t>(v)]; };
  std::vector<std::pair<std::uint32_t, int>> spots;
  spots.reserve(place.size());
  for (int v = 0; v < static_cast<int>(place.size()); ++v)
    if (place[v] >= 0) spots.push_back({spread(at(v)[0]) | spread(at(v)[1]) << 1 | spread(at(v)[2]) << 2, v});
  std::sort(spots.begin(), spots.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const double *p = at(a.second), *q = at(b.second);
    return std::tie(p[0], p[1], p[2], a.second) < std::tie(q[0], q[1], q[2], b.second);
  });
  std::vector<int> out;
  out.reserve(spots.size());
  for (const auto& spot : spots) out.push_back(spot.second);
  return out;
}

// Faces in the order of their lowest places.
void sort_faces(std::vector<int>& triangle, int places) {
  const auto lowest = [&](std::size_t f) {
    return std::min({triangle[3 * f], triangle[3 * f + 1], triangle[3 * f + 2]});
  };
  std::vector<int> at(places + 1, 0), sorted(triangle.size());
  for (std::size_t f = 0; f < triangle.size() / 3; ++f) ++at[lowest(f) + 1];
  std::partial_sum(at.begin(), at.end(), at.begin());
  for (std::size_t f = 0; f < triangle.size() / 3; ++f)
    std::copy_n(&triangle[3 * f], 3, &sorted[3 * static_cast<std::size_t>(at[lowest(f)]++)]);
  triangle = std::move(sorted);
}

std::uint64_t edge_key(int a, int b) {
  if (a > b) std::swap(a, b);
  return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
}

// Corners whose edge to the next corner of the face belongs to no other face.
std::vector<int> border_corners(const std::vector<int>& triangle, int places) {
  struct Edge {
    int high, corner;
  };
  const auto next = [&](int c) { return triangle[c % 3 == 2 ? c - 2 : c + 1]; };
  const int corners = static_cast<int>(triangle.size());
  std::vector<int> first(places + 1, 0);
  for (int c = 0; c < corners; ++c) ++first[std::min(triangle[c], next(c)) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Edge> edges(triangle.size());
  std::vector<int> at(first.begin(), first.end() - 1);
  for (int c = 0; c < corners; ++c) edges[at[std::min(triangle[c], next(c))]++] = {std::max(triangle[c], next(c)), c};
  std::vector<int> out;
  for (int p = 0; p < places; ++p) {
    const auto begin = edges.begin() + first[p], end = edges.begin() + first[p + 1];
    std::sort(begin, end,
              [](const Edge& x, const Edge& y) { return std::tie(x.high, x.corner) < std::tie(y.high, y.corner); });
    for (auto i = begin; i != end;) {
      auto j = i + 1;
      while (j != end && j->high == i->high) ++j;
      if (j - i == 1) out.push_back(i->corner);
      i = j;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Points, 3>;

// The ends of border edges, to be found by position.
class Border {
 public:
  Border(const std::vector<double>& position, const std::vector<int>& triangle, const std::vector<int>& corners) {
    for (int c : corners)
      for (int p : {triangle[c], triangle[c % 3 == 2 ? c - 2 : c + 1]}) place_.push_back(p);
    std::sort(place_.begin(), place_.end());
    place_.erase(std::unique(place_.begin(), place_.end()), place_.end());
    points_.resize(static_cast<Eigen::Index>(place_.size()), 3);
    for (std::size_t i = 0; i < place_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        points_(static_cast<Eigen::Index>(i), k) = position[3 * static_cast<std::size_t>(place_[i]) + k];
    tree_ = std::make_unique<Tree>(3, std::cref(points_));
  }
  const std::vector<int>& places() const { return place_; }
  /// Places within a distance, lowest first.
  void within(const double* p, double radius, std::vector<int>& out) {
    found_.clear();
    tree_->index->radiusSearch(p, radius * radius, found_, nanoflann::SearchParams());
    out.clear();
    for (const auto& [i, squared] : found_) out.push_back(place_[i]);
    std::sort(out.begin(), out.end());
  }

 private:
  std::vector<int> place_;
  Points points_;
  std::unique_ptr<Tree> tree_;
  std::vector<std::pair<Eigen::Index, double>> found_;
};

// Places on a border that are one by kSeam; the lower index stays. @return how many went
int weld_seams(const std::vector<double>& position, std::vector<int>& triangle, DisjointSets& merged,
               const Context& context) {
  const int n = static_cast<int>(position.size() / 3);
  const std::vector<int> corners = border_corners(triangle, n);
  if (corners.empty()) return 0;
  const auto at = [&](int p) { return &position[3 * static_cast<std::size_t>(p)]; };
  std::vector<float> shortest(n, -1);  // edge at a place on the border
  Border border(position, triangle, corners);
  for (int p : border.places()) shortest[p] = 4;  // longer than anything in the unit box
  for (std::size_t c = 0; c < triangle.size(); ++c) {
    const int a = triangle[c], b = triangle[c % 3 == 2 ? c - 2 : c + 1];
    if (shortest[a] < 0 && shortest[b] < 0) continue;
    const auto length = static_cast<float>(std::sqrt(squared_distance(at(a), at(b))));
    for (int v : {a, b}) shortest[v] = std::min(shortest[v], length);
  }
  int gone = 0;
  std::vector<int> near;
  for (std::size_t i = 0; i < border.places().size(); ++i) {
    stop_at(i, context);
    const int a = border.places()[i];
    border.within(at(a), kSeam * shortest[a], near);
    for (int b : near) {
      if (b <= a || squared_distance(at(a), at(b)) > std::pow(kSeam * shortest[b], 2)) continue;
      gone += merged.join(a, b);
    }
  }
  for (int& v : triangle) v = merged.find(v);
  return gone;
}

// T-junctions: a place on a border that lies within an edge of a border is made a corner of the face there.
// @return how many
int split_at_junctions(const std::vector<double>& position, std::vector<int>& triangle, const Context& context) {
  constexpr double kOnEdge = 0.002;  // of its length, off the edge: far below what is modelled as a gap
  constexpr int kMostRounds = 64;    // each puts one place into each edge
  const auto at = [&](int p) { return &position[3 * static_cast<std::size_t>(p)]; };
  int inserted = 0;
  std::vector<int> corners = border_corners(triangle, static_cast<int>(position.size() / 3)), near;
  if (corners.empty()) return 0;
  Border border(position, triangle, corners);
  for (int round = 0; round < kMostRounds && !corners.empty(); ++round) {
    std::vector<char> changed(triangle.size() / 3, 0);
    std::vector<int> again;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      stop_at(i, context);
      const int c = corners[i], f = c / 3, a = triangle[c], b = triangle[3 * f + (c + 1) % 3],
                d = triangle[3 * f + (c + 2) % 3];
      const double length = std::sqrt(squared_distance(at(a), at(b)));
      if (changed[f]) {  // its corners may have moved: next round
        again.push_back(c);
        continue;
      }
      double middle[3];
      for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (at(a)[k] + at(b)[k]);
      border.within(middle, 0.5 * length, near);
      int best = -1;
      double nearest = 1;  // to the middle, so that no sliver is cut off first
      for (int p : near) {
        if (p == a || p == b || p == d) continue;
        double along = 0, off = 0;
        for (int k = 0; k < 3; ++k) along += (at(p)[k] - at(a)[k]) * (at(b)[k] - at(a)[k]) / (length * length);
        for (int k = 0; k < 3; ++k) {
          const double x = at(p)[k] - at(a)[k] - along * (at(b)[k] - at(a)[k]);
          off += x * x;
        }
        if (off > std::pow(kOnEdge * length, 2) || along < kSeam || along > 1 - kSeam) continue;
        if (std::abs(along - 0.5) < nearest) nearest = std::abs(along - 0.5), best = p;
      }
      if (best < 0) continue;
      // a-b-d becomes a-best-d and best-b-d.
      triangle[3 * f + (c + 1) % 3] = best;
      const int fresh = static_cast<int>(triangle.size());
      triangle.insert(triangle.end(), {best, b, d});
      changed[f] = 1;
      changed.push_back(1);
      again.push_back(c), again.push_back(fresh);
      ++inserted;
    }
    corners.swap(again);
    // An edge of a changed face may be on the border at another corner now.
    if (!corners.empty()) {
      const std::vector<int> now = border_corners(triangle, static_cast<int>(position.size() / 3));
      std::vector<int> faces;
      for (int c : corners) faces.push_back(c / 3);
      std::sort(faces.begin(), faces.end());
      corners.clear();
      for (int c : now)
        if (std::binary_search(faces.begin(), faces.end(), c / 3)) corners.push_back(c);
    }
  }
  return inserted;
}

// Gives needles - faces of three different places on one line - to the face across their longest edge, which is split
// at the place in its middle; again and again, as that may be a needle too. One that has none beside it is dropped.
int dissolve_needles(const std::vector<double>& position, std::vector<int>& triangle) {
  const auto at = [&](int p) { return &position[3 * static_cast<std::size_t>(p)]; };
  const auto longest = [&](const int* t) {  // its corner opposite of the longest edge
    double most = -1;
    int corner = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = squared_distance(at(t[(k + 1) % 3]), at(t[(k + 2) % 3]));
      if (d > most) most = d, corner = k;
    }
    return std::make_pair(corner, most);
  };
  const auto is_needle = [&](const int* t) {
    const double most = longest(t).second;
    return squared_area(at(t[0]), at(t[1]), at(t[2])) <= 4 * kZeroArea * kZeroArea * most * most;
  };
  std::vector<int> needles;
  for (int f = 0; f < static_cast<int>(triangle.size() / 3); ++f)
    if (is_needle(&triangle[3 * static_cast<std::size_t>(f)])) needles.push_back(f);
  if (needles.empty()) return 0;
  const int found = static_cast<int>(needles.size());
  std::unordered_multimap<std::uint64_t, int>
      faces;  // by edge; entries of faces that have changed since are passed over
  const auto enter = [&](int f) {
    for (int k = 0; k < 3; ++k) faces.emplace(edge_key(triangle[3 * f + k], triangle[3 * f + (k + 1) % 3]), f);
  };
  faces.reserve(triangle.size());
  for (int f = 0; f < static_cast<int>(triangle.size() / 3); ++f) enter(f);
  std::vector<char> dead(triangle.size() / 3, 0);
  const auto has_edge = [&](int f, int a, int b) {
    int met = 0;
    for (int k = 0; k < 3; ++k) met += triangle[3 * f + k] == a || triangle[3 * f + k] == b;
    return !dead[f] && met == 2;
  };
  // Each step splits one face, and needles only beget needles with a shorter longest edge; the bound is for rounding.
  const std::size_t most_steps = 20 * needles.size() + 1000;
  for (std::size_t step = 0; step < needles.size(); ++step) {
    const int f = needles[step];
    if (dead[f]) continue;
    const int corner = longest(&triangle[3 * static_cast<std::size_t>(f)]).first;
    const int c = triangle[3 * f + corner], a = triangle[3 * f + (corner + 1) % 3],
              b = triangle[3 * f + (corner + 2) % 3];
    dead[f] = 1;
    if (step > most_steps) continue;
    int across = -1;
    const auto range = faces.equal_range(edge_key(a, b));
    for (auto it = range.first; it != range.second; ++it)
      if (it->second != f && has_edge(it->second, a, b) && (across < 0 || it->second < across)) across = it->second;
    if (across < 0) continue;
    int k = 0;  // corner of `across` opposite of the edge
    while (triangle[3 * across + k] == a || triangle[3 * across + k] == b) ++k;
    const int d = triangle[3 * across + k], x = triangle[3 * across + (k + 1) % 3],
              y = triangle[3 * across + (k + 2) % 3];
    if (d == c) {  // the same three places: both go
      dead[across] = 1;
      continue;
    }
    const int fresh = static_cast<int>(triangle.size() / 3);
    triangle[3 * across] = d, triangle[3 * across + 1] = x, triangle[3 * across + 2] = c;
    triangle.insert(triangle.end(), {d, c, y});
    dead.push_back(0);
    for (int g : {across, fresh}) {
      enter(g);
      if (is_needle(&triangle[3 * static_cast<std::size_t>(g)])) needles.push_back(g);
    }
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < dead.size(); ++f)
    if (!dead[f]) std::copy_n(&triangle[3 * f], 3, &triangle[3 * kept++]);
  triangle.resize(3 * kept);
  return found;
}

// Of faces on the same places the first stays. @return how many went
int drop_repeated(std::vector<int>& triangle) {
  std::vector<std::array<int, 4>> key(triangle.size() / 3);
  for (std::size_t f = 0; f < key.size(); ++f) {
    std::array<int, 3> t{triangle[3 * f], triangle[3 * f + 1], triangle[3 * f + 2]};
    std::sort(t.begin(), t.end());
    key[f] = {t[0], t[1], t[2], static_cast<int>(f)};
  }
  std::sort(key.begin(), key.end());
  std::vector<char> again(key.size(), 0);
  int found = 0;
  for (std::size_t i = 1; i < key.size(); ++i)
    if (std::equal(key[i].begin(), key[i].begin() + 3, key[i - 1].begin())) again[key[i][3]] = 1, ++found;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < again.size(); ++f)
    if (!again[f]) std::copy_n(&triangle[3 * f], 3, &triangle[3 * kept++]);
  triangle.resize(3 * kept);
  return found;
}

}  // namespace

WeldedMesh weld(const TriangleMesh& mesh, const Context& context) {
  check_input(mesh);
  WeldedMesh out;
  double size;
  const std::vector<double> position = normalized(mesh, size);
  stop_at(0, context);
  int welded = 0, zero_area = 0, repeated = 0;
  const int n = mesh.vertices();
  out.place.assign(n, -1);
  for (int v : mesh.triangle) out.place[v] = 0;
  std::vector<int> order = along_curve(position, out.place), twin(n, -1);  // twin: the first of the same coordinates
  const int unused = n - static_cast<int>(order.size());
  const auto at = [&](int v) { return &position[3 * static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && std::equal(at(order[i]), at(order[i]) + 3, at(order[i - 1]));
    twin[order[i]] = again ? twin[order[i - 1]] : order[i];
  }
  // In the order of the file, every pass over a large mesh would fetch its neighbours from all over the memory. What
  // fits into the cache stays as it is.
  constexpr int kFits = 50000;
  if (n <= kFits) std::sort(order.begin(), order.end());
  for (const int v : order) {
    if (twin[v] != v) {
      out.place[v] = out.place[twin[v]];
      ++welded;
      continue;
    }
    out.place[v] = out.places();
    out.position.insert(out.position.end(), at(v), at(v) + 3);
    out.vertex.push_back(v);
  }
  stop_at(0, context);
  std::vector<int> triangle(mesh.triangle.size());
  for (std::size_t c = 0; c < triangle.size(); ++c) triangle[c] = out.place[mesh.triangle[c]];
  if (n > kFits) sort_faces(triangle, out.places());

  DisjointSets merged(out.places());
  if (const int gone = weld_seams(out.position, triangle, merged, context)) {
    welded += gone;
    // Close up the places that are left, in their order.
    std::vector<int> index(out.places());
    int kept = 0;
    for (int p = 0; p < out.places(); ++p) {
      if (const int first = merged.find(p); first != p) {
        index[p] = index[first];
        continue;
      }
      std::copy_n(&out.position[3 * static_cast<std::size_t>(p)], 3, &out.position[3 * static_cast<std::size_t>(kept)]);
      out.vertex[kept] = out.vertex[p];
      index[p] = kept++;
    }
    out.position.resize(3 * static_cast<std::size_t>(kept));
    out.vertex.resize(kept);
    for (int& p : out.place)
      if (p >= 0) p = index[p];
    for (int& p : triangle) p = index[p];
  }

  std::size_t kept = 0;
  for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
    const int *t = &triangle[3 * f], a = t[0], b = t[1], c = t[2];
    if (a == b || b == c || c == a) {
      ++zero_area;
      continue;
    }
    std::copy_n(t, 3, &triangle[3 * kept++]);
  }
  triangle.resize(3 * kept);
  // First: what follows splits one face of several on the same places, and the halves would lie on the rest.
  repeated += drop_repeated(triangle);
  const int needles = dissolve_needles(out.position, triangle);
  zero_area += needles;
  const int junctions = split_at_junctions(out.position, triangle, context);
  if (needles > 0 || junctions > 0) repeated += drop_repeated(triangle);
  stop_at(0, context);

  out.triangle = std::move(triangle);
  const auto note = [&](int count, const char* one, const char* many, const char* before, const char* after) {
    if (count)
      out.notes.push_back(std::string(before) + std::to_string(count) + " " + (count == 1 ? one : many) + after);
  };
  note(unused, "vertex", "vertices", "left out ", " that no face uses");
  note(welded, "vertex", "vertices", "welded ", " that stand where another does");
  note(zero_area, "face", "faces", "dropped ", " without area");
  note(repeated, "face", "faces", "dropped ", " that are there twice");
  note(junctions, "T-junction", "T-junctions", "closed ", "");
  if (out.triangle.empty())
    throw InvalidMesh("all faces of the mesh are without area: check the scale of its coordinates");
  return out;
}

void keep_largest(WeldedMesh& mesh) {
  int count = 0;
  const std::vector<int> part = face_parts(mesh.triangle, mesh.places(), count);
  if (count == 1) return;
  std::vector<double> area(count, 0.0);
  std::vector<int> places(count, 0), part_of(mesh.places(), -1);
  double total = 0;
  for (std::size_t f = 0; f < part.size(); ++f) {
    const double a = std::sqrt(squared_area(mesh.point(mesh.triangle[3 * f]), mesh.point(mesh.triangle[3 * f + 1]),
                                            mesh.point(mesh.triangle[3 * f + 2])));
    area[part[f]] += a;
    total += a;
    for (int k = 0; k < 3; ++k) {
      int& mine = part_of[mesh.triangle[3 * f + k]];
      if (mine < 0) ++places[part[f]];
      mine = part[f];
    }
  }
  int keep = 0;
  for (int i = 1; i < count; ++i)
    if (area[i] * places[i] > area[keep] * places[keep]) keep = i;
  std::vector<int> index(mesh.places(), -1), triangle, vertex;
  std::vector<double> position;
  for (int p = 0; p < mesh.places(); ++p) {
    if (part_of[p] != keep) continue;
    index[p] = static_cast<int>(vertex.size());
    vertex.push_back(mesh.vertex[p]);
    position.insert(position.end(), mesh.point(p), mesh.point(p) + 3);
  }
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c)
    if (part[c / 3] == keep) triangle.push_back(index[mesh.triangle[c]]);
  char text[120];
  std::snprintf(text, sizeof text, "used the largest of %d parts: %.0f %% of the area, %.0f %% of the vertices", count,
                100 * area[keep] / total, 100.0 * static_cast<double>(vertex.size()) / mesh.places());
  mesh.notes.push_back(text);
  for (int& p : mesh.place)
    if (p >= 0) p = index[p];
  mesh.position = std::move(position);
  mesh.triangle = std::move(triangle);
  mesh.vertex = std::move(vertex);
}

std::vector<int> face_parts(const std::vector<int>& triangle, int places, int& count) {
  DisjointSets together(places);
  for (std::size_t i = 0; i < triangle.size(); i += 3)
    for (int k = 1; k < 3; ++k) together.join(triangle[i], triangle[i + k]);
  std::vector<int> label(places, -1), part(triangle.size() / 3);
  count = 0;
  for (std::size_t f = 0; f < part.size(); ++f) {
    int& mine = label[together.find(triangle[3 * f])];
    if (mine < 0) mine = count++;
    part[f] = mine;
  }
  return part;
}

}  // namespace ga_symmetry
