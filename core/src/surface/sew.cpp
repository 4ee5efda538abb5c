// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sew.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "ga_symmetry/errors.h"
#include "surface/sheets.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// An edge of a rim, from `from` to `to` with its face on the left.
struct RimEdge {
  int corner, from, to, rim;
  double along;  // length of the rim up to its middle
};

struct Rims {
  std::vector<RimEdge> edge;
  std::vector<double> length;  // per rim
};

// Border corner of the edge that follows around the hole.
int next_on_border(const Surface& s, int corner) {
  int c = next_corner(corner);
  while (s.opposite[c] >= 0) c = next_corner(s.opposite[c]);
  return c;
}

Rims rims_of(const Surface& s, const std::vector<char>& wanted) {
  Rims out;
  std::vector<char> seen(s.triangle.size(), 0);
  for (int first = 0; first < static_cast<int>(s.triangle.size()); ++first) {
    if (s.opposite[first] >= 0 || seen[first] || !wanted[first / 3]) continue;
    double along = 0;
    for (int c = first; !seen[c]; c = next_on_border(s, c)) {
      seen[c] = 1;
      const int a = s.triangle[next_corner(c)], b = s.triangle[previous_corner(c)];
      const double length = s.edge_length(a, b);
      out.edge.push_back({c, a, b, static_cast<int>(out.length.size()), along + 0.5 * length});
      along += length;
    }
    out.length.push_back(along);
  }
  return out;
}

std::uint64_t key_of(int from, int to) {
  return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
}

// A triangle from an edge of a rim to the start of another.
struct Stitch {
  double width;
  int edge, to;
};

std::vector<Stitch> possible_stitches(const Surface& s, const Rims& rims, double reach, const Context& context) {
  constexpr double kAround = 3;            // a rim faces itself where it is so many times longer than the way across
  constexpr std::size_t kMostPerEdge = 8;  // the narrowest
  Points starts(static_cast<Eigen::Index>(rims.edge.size()), 3);
  for (std::size_t i = 0; i < rims.edge.size(); ++i)
    starts.row(static_cast<Eigen::Index>(i)) = Vector(s.point(rims.edge[i].from)).transpose();
  const nanoflann::KDTreeEigenMatrixAdaptor<Points, 3> tree(3, std::cref(starts));
  std::vector<Stitch> out, mine;
  std::vector<std::pair<Eigen::Index, double>> near;
  for (std::size_t i = 0; i < rims.edge.size(); ++i) {
    if (i % 4096 == 0 && context.cancelled()) throw Cancelled();
    const RimEdge& e = rims.edge[i];
    const Vector a(s.point(e.from)), b(s.point(e.to)), middle = 0.5 * (a + b);
    const Vector outward = middle - Vector(s.point(s.triangle[e.corner]));  // from the face over its edge
    const Vector across = outward - outward.dot(b - a) / (b - a).squaredNorm() * (b - a);
    tree.index->radiusSearch(middle.data(), reach * reach, near, nanoflann::SearchParams());
    mine.clear();
    for (const auto& [j, squared] : near) {
      const RimEdge& f = rims.edge[j];
      const Vector c(s.point(f.from));
      if (f.from == e.from || f.from == e.to || (c - middle).dot(across) < 0) continue;
      const double width = std::max((c - a).norm(), (c - b).norm());
      if (f.rim == e.rim) {
        const double there = std::abs(f.along - e.along), around = std::min(there, rims.length[e.rim] - there);
        if (around < kAround * width) continue;
      }
      mine.push_back({width, static_cast<int>(i), f.from});
    }
    const auto narrower = [](const Stitch& x, const Stitch& y) {
      return std::tie(x.width, x.edge, x.to) < std::tie(y.width, y.edge, y.to);
    };
    std::sort(mine.begin(), mine.end(), narrower);
    out.insert(out.end(), mine.begin(),
               mine.begin() + static_cast<std::ptrdiff_t>(std::min(mine.size(), kMostPerEdge)));
  }
  std::sort(out.begin(), out.end(), [](const Stitch& x, const Stitch& y) {
    return std::tie(x.width, x.edge, x.to) < std::tie(y.width, y.edge, y.to);
  });
  return out;
}

}  // namespace

int sew(const Surface& mesh, double reach, Surface& to, const Context& context) {
  if (!mesh.orientable || mesh.closed) return 0;
  constexpr double kScrap = 0.01;        // of the area: less is no part that a rim could lead to
  constexpr std::size_t kMost = 200000;  // edges on rims; a mesh of more is torn all over
  const Sheets sheets(mesh);
  std::vector<char> wanted(mesh.triangles());
  for (int f = 0; f < mesh.triangles(); ++f) wanted[f] = sheets.area[sheets.of_face[f]] >= kScrap * mesh.area;
  const Rims rims = rims_of(mesh, wanted);
  if (rims.edge.empty() || rims.edge.size() > kMost) return 0;

  // Edges of faces between vertices of rims, in their direction: each may be there once.
  std::vector<char> on_rim(mesh.vertices(), 0);
  for (const RimEdge& e : rims.edge) on_rim[e.from] = 1;
  std::unordered_set<std::uint64_t> taken;
  for (int c = 0; c < static_cast<int>(mesh.triangle.size()); ++c)
    if (on_rim[mesh.triangle[c]] && on_rim[mesh.triangle[next_corner(c)]])
      taken.insert(key_of(mesh.triangle[c], mesh.triangle[next_corner(c)]));
  std::vector<int> triangle = mesh.triangle;
  int added = 0;
  const auto fits = [&](const RimEdge& e, int apex) {
    return apex != e.from && apex != e.to && !taken.count(key_of(e.to, e.from)) && !taken.count(key_of(e.from, apex)) &&
           !taken.count(key_of(apex, e.to));
  };
  const auto add = [&](const RimEdge& e, int apex) {
    taken.insert({key_of(e.to, e.from), key_of(e.from, apex), key_of(apex, e.to)});
    triangle.insert(triangle.end(), {e.to, e.from, apex});
    ++added;
  };
  std::unordered_map<int, int> starting, ending;  // per vertex: an edge of a rim
  for (int i = static_cast<int>(rims.edge.size()) - 1; i >= 0; --i)
    starting[rims.edge[i].from] = i, ending[rims.edge[i].to] = i;
  // Goes on from a side p -> q of a strip, by the edge that starts at q or the one that ends at p, until it is too
  // wide.
  const auto go_on = [&](int p, int q) {
    while (!taken.count(key_of(q, p))) {
      const auto at_q = starting.find(q), at_p = ending.find(p);
      double first = INFINITY, second = INFINITY;
      if (at_q != starting.end() && fits(rims.edge[at_q->second], p))
        first = mesh.edge_length(rims.edge[at_q->second].to, p);
      if (at_p != ending.end() && fits(rims.edge[at_p->second], q))
        second = mesh.edge_length(rims.edge[at_p->second].from, q);
      if (std::min(first, second) > reach) return;
      if (first <= second) {
        add(rims.edge[at_q->second], p);
        q = rims.edge[at_q->second].to;
      } else {
        add(rims.edge[at_p->second], q);
        p = rims.edge[at_p->second].from;
      }
    }
  };
  for (const Stitch& stitch : possible_stitches(mesh, rims, reach, context)) {
    const RimEdge& e = rims.edge[stitch.edge];
    if (!fits(e, stitch.to)) continue;
    add(e, stitch.to);
    go_on(e.from, stitch.to);
    go_on(stitch.to, e.to);
  }
  if (added > 0) to = surface_of(mesh.position, std::move(triangle), context);
  return added;
}

}  // namespace ga_symmetry
