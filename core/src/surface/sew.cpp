// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sew.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nanoflann.hpp>
#include <numeric>
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
  int corner, from, to, rim, sheet;
  double along;  // length of the rim up to its middle
};

// How the surface lies at a rim.
struct Frame {
  Vector outward = Vector::Zero();  // from the face over the edge
  Vector normal = Vector::Zero();
};

struct Rims {
  std::vector<RimEdge> edge;
  std::vector<double> length;               // per rim
  std::vector<Frame> frame;                 // per edge
  std::unordered_map<int, Frame> frame_at;  // per vertex: sum of those of its edges
};

// Whether two places may be the two sides of a gap: each looks to the other, and the surface goes on. Of two legs side
// by side rims look the same way, and where they touch the surfaces look at each other.
bool face_each_other(const Frame& a, const Frame& b) {
  return a.outward.dot(b.outward) < 0 && a.normal.dot(b.normal) > 0;
}

// Border corner of the edge that follows around the hole.
int next_on_border(const Surface& s, int corner) {
  int c = next_corner(corner);
  while (s.opposite[c] >= 0) c = next_corner(s.opposite[c]);
  return c;
}

Rims rims_of(const Surface& s) {
  const Sheets sheets(s);
  Rims out;
  std::vector<char> seen(s.triangle.size(), 0);
  for (int first = 0; first < static_cast<int>(s.triangle.size()); ++first) {
    const int sheet = sheets.of_face[first / 3];
    if (s.opposite[first] >= 0 || seen[first]) continue;
    double along = 0;
    for (int c = first; !seen[c]; c = next_on_border(s, c)) {
      seen[c] = 1;
      const int a = s.triangle[next_corner(c)], b = s.triangle[previous_corner(c)];
      const double length = s.edge_length(a, b);
      out.edge.push_back({c, a, b, static_cast<int>(out.length.size()), sheet, along + 0.5 * length});
      along += length;
    }
    out.length.push_back(along);
  }
  // A hole where a face or two are missing is no end of a limb.
  constexpr int kFewest = 6;  // edges
  std::vector<int> edges(out.length.size(), 0), most(sheets.count(), 0);
  for (const RimEdge& e : out.edge) ++edges[e.rim];
  for (const RimEdge& e : out.edge) most[e.sheet] = std::max(most[e.sheet], edges[e.rim]);
  out.edge.erase(std::remove_if(out.edge.begin(), out.edge.end(),
                                [&](const RimEdge& e) { return edges[e.rim] < std::min(kFewest, most[e.sheet]); }),
                 out.edge.end());
  for (const RimEdge& e : out.edge) {
    const Vector a(s.point(e.from)), b(s.point(e.to)), along = (b - a).stableNormalized();
    const Vector inward = Vector(s.point(s.triangle[e.corner])) - a;
    Frame f;
    f.outward = (inward.dot(along) * along - inward).stableNormalized();
    f.normal = along.cross(inward).stableNormalized();
    out.frame.push_back(f);
    for (const int v : {e.from, e.to}) out.frame_at[v].outward += f.outward, out.frame_at[v].normal += f.normal;
  }
  return out;
}

std::uint64_t key_of(int from, int to) {
  return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
}

// Faces with those sheets turned over that lie wrong side up beside others. Empty if there are none.
std::vector<int> turned_alike(const Surface& s, const Rims& rims, double reach) {
  Points middles(static_cast<Eigen::Index>(rims.edge.size()), 3);
  const auto direction = [&](const RimEdge& e) -> Vector { return Vector(s.point(e.to)) - Vector(s.point(e.from)); };
  for (std::size_t i = 0; i < rims.edge.size(); ++i)
    middles.row(static_cast<Eigen::Index>(i)) =
        (Vector(s.point(rims.edge[i].from)) + 0.5 * direction(rims.edge[i])).transpose();
  const nanoflann::KDTreeEigenMatrixAdaptor<Points, 3> tree(3, std::cref(middles));
  std::map<std::pair<int, int>, double> vote;  // of two sheets: how much of their rims has opposite normals, a length
  std::vector<std::pair<Eigen::Index, double>> near;
  for (std::size_t i = 0; i < rims.edge.size(); ++i) {
    const RimEdge& e = rims.edge[i];
    const Vector at = middles.row(static_cast<Eigen::Index>(i)).transpose();
    tree.index->radiusSearch(at.data(), reach * reach, near, nanoflann::SearchParams());
    const Frame& here = rims.frame[i];
    const auto other = std::find_if(near.begin(), near.end(), [&](const auto& found) {
      return rims.edge[found.first].sheet != e.sheet && here.outward.dot(rims.frame[found.first].outward) < 0;
    });
    if (other == near.end()) continue;
    vote[std::minmax(e.sheet, rims.edge[other->first].sheet)] -=
        direction(e).norm() * here.normal.dot(rims.frame[other->first].normal);
  }
  struct Vote {
    double strength;
    int a, b;
    bool same;
  };
  std::vector<Vote> votes;
  for (const auto& [pair, sum] : vote) votes.push_back({std::abs(sum), pair.first, pair.second, sum > 0});
  if (votes.empty()) return {};
  // Pieces of limbs and trunks bulge outwards.
  const Sheets of(s);
  const int outside = of.count(), sheets = outside + 1;
  std::vector<double> rim(outside, 0.0), along(outside, 0.0), away(outside, 0.0);
  std::vector<Vector> centre(outside, Vector::Zero());
  for (const RimEdge& e : rims.edge) rim[e.sheet] += direction(e).norm();
  const auto each_face = [&](const auto& body) {
    for (int f = 0; f < s.triangles(); ++f) {
      const Vector a(s.point(s.triangle[3 * f])), b(s.point(s.triangle[3 * f + 1])), c(s.point(s.triangle[3 * f + 2]));
      body(of.of_face[f], (a + b + c) / 3, 0.5 * (b - a).cross(c - a));
    }
  };
  each_face([&](int k, const Vector& at, const Vector& normal) { centre[k] += normal.norm() / of.area[k] * at; });
  each_face([&](int k, const Vector& at, const Vector& normal) {
    along[k] += (at - centre[k]).dot(normal), away[k] += (at - centre[k]).norm() * normal.norm();
  });
  std::vector<char> beside(outside, 0);
  for (const Vote& v : votes) beside[v.a] = beside[v.b] = 1;
  for (int k = 0; k < outside; ++k)
    if (beside[k] && away[k] > 0) votes.push_back({rim[k] * std::abs(along[k]) / away[k], k, outside, along[k] < 0});
  std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.strength > b.strength; });
  // Joins them, the surest first. Per sheet: the one it is joined to, and whether it is turned against that one.
  std::vector<int> root(sheets);
  std::vector<char> turned(sheets, 0);
  std::iota(root.begin(), root.end(), 0);
  for (const Vote& v : votes) {
    const int from = root[v.b], to = root[v.a];
    if (from == to) continue;
    const bool turn = turned[v.a] ^ turned[v.b] ^ v.same;
    for (int k = 0; k < sheets; ++k)
      if (root[k] == from) root[k] = to, turned[k] ^= turn;
  }
  if (std::find(turned.begin(), turned.end(), 1) == turned.end()) return {};
  std::vector<int> triangle = s.triangle;
  for (int f = 0; f < s.triangles(); ++f)
    if (turned[of.of_face[f]]) std::swap(triangle[3 * f], triangle[3 * f + 1]);
  return triangle;
}

// A triangle from an edge of a rim to the start of another.
struct Stitch {
  double cost;        // how wide it is, then over the share of their rims that faces the other
  int edge, to, rim;  // rim: that of `to`
};

std::vector<Stitch> possible_stitches(const Surface& s, const Rims& rims, double reach, const Context& context) {
  constexpr double kAround = 3;            // a rim faces itself where it is so many times longer than the way across
  constexpr std::size_t kMostPerEdge = 8;  // the narrowest
  Points starts(static_cast<Eigen::Index>(rims.edge.size()), 3);
  for (std::size_t i = 0; i < rims.edge.size(); ++i)
    starts.row(static_cast<Eigen::Index>(i)) = Vector(s.point(rims.edge[i].from)).transpose();
  const nanoflann::KDTreeEigenMatrixAdaptor<Points, 3> tree(3, std::cref(starts));
  std::vector<Stitch> out, mine;
  // Of two rims: the length of the first that faces the second, and the last edge that was counted.
  std::map<std::pair<int, int>, std::pair<double, int>> facing;
  std::vector<std::pair<Eigen::Index, double>> near;
  for (std::size_t i = 0; i < rims.edge.size(); ++i) {
    if (i % 4096 == 0 && context.cancelled()) throw Cancelled();
    const RimEdge& e = rims.edge[i];
    const Vector a(s.point(e.from)), b(s.point(e.to)), middle = 0.5 * (a + b);
    tree.index->radiusSearch(middle.data(), reach * reach, near, nanoflann::SearchParams());
    mine.clear();
    for (const auto& [j, squared] : near) {
      const RimEdge& f = rims.edge[j];
      const Vector c(s.point(f.from));
      if (f.from == e.from || f.from == e.to || (c - middle).dot(rims.frame[i].outward) < 0) continue;
      if (!face_each_other(rims.frame[i], rims.frame_at.at(f.from))) continue;
      const double width = std::max((c - a).norm(), (c - b).norm());
      if (f.rim == e.rim) {
        const double there = std::abs(f.along - e.along), around = std::min(there, rims.length[e.rim] - there);
        if (around < kAround * width) continue;
      }
      mine.push_back({width, static_cast<int>(i), f.from, f.rim});
      auto& [length, counted] = facing.try_emplace({e.rim, f.rim}, 0, -1).first->second;
      if (counted != static_cast<int>(i)) length += (b - a).norm(), counted = static_cast<int>(i);
    }
    const auto narrower = [](const Stitch& x, const Stitch& y) {
      return std::tie(x.cost, x.edge, x.to) < std::tie(y.cost, y.edge, y.to);
    };
    std::sort(mine.begin(), mine.end(), narrower);
    out.insert(out.end(), mine.begin(),
               mine.begin() + static_cast<std::ptrdiff_t>(std::min(mine.size(), kMostPerEdge)));
  }
  // Both sides of a gap run along each other; where limbs touch, only a little of their rims does.
  const auto share = [&](int a, int b) {
    const auto at = facing.find({a, b});
    return at == facing.end() ? 0 : at->second.first / rims.length[a];
  };
  constexpr double kLeast = 0.2;
  for (Stitch& stitch : out) {
    const int a = rims.edge[stitch.edge].rim, b = stitch.rim;
    const double most = std::max(share(a, b), share(b, a));
    stitch.cost = most < kLeast ? INFINITY : stitch.cost / most;
  }
  out.erase(std::remove_if(out.begin(), out.end(), [](const Stitch& x) { return !std::isfinite(x.cost); }), out.end());
  std::sort(out.begin(), out.end(), [](const Stitch& x, const Stitch& y) {
    return std::tie(x.cost, x.edge, x.to) < std::tie(y.cost, y.edge, y.to);
  });
  return out;
}

// Where a few stitches of a rim lead elsewhere than those before and after, limbs touch.
// @param apex_of  per edge: the apex of its stitch, or -1
void drop_short_runs(const Rims& rims, std::vector<int>& apex_of) {
  constexpr std::size_t kShort = 4;  // edges
  constexpr double kMuch = 0.25;     // of a rim
  std::unordered_map<int, int> rim_at;
  for (const RimEdge& e : rims.edge) rim_at[e.from] = e.rim;
  const auto leads_to = [&](std::size_t i) { return apex_of[i] < 0 ? -1 : rim_at.at(apex_of[i]); };
  for (std::size_t first = 0, last; first < rims.edge.size(); first = last) {
    for (last = first; last < rims.edge.size() && rims.edge[last].rim == rims.edge[first].rim;) ++last;
    const std::size_t count = last - first;
    std::size_t start = 0;  // of a run
    while (start < count && leads_to(first + start) == leads_to(first + (start + count - 1) % count)) ++start;
    for (std::size_t k = 0, length; k < count; k += length) {
      const auto at = [&](std::size_t i) { return first + (start + i) % count; };
      for (length = 1; k + length < count && leads_to(at(k + length)) == leads_to(at(k));) ++length;
      if (length < kShort && static_cast<double>(length) < kMuch * static_cast<double>(count))
        for (std::size_t i = k; i < k + length; ++i) apex_of[at(i)] = -1;
    }
  }
}

}  // namespace

int sew(const Surface& as_it_is, double reach, Surface& to, const Context& context) {
  if (!as_it_is.orientable || as_it_is.closed) return 0;
  constexpr std::size_t kMost = 200000;  // edges on rims; a mesh of more is torn all over
  Rims rims = rims_of(as_it_is);
  if (rims.edge.empty() || rims.edge.size() > kMost) return 0;
  Surface turned;
  std::vector<int> alike = turned_alike(as_it_is, rims, reach);
  if (!alike.empty()) {
    turned = surface_of(as_it_is.position, std::move(alike), context);
    rims = rims_of(turned);
  }
  const Surface& mesh = turned.triangle.empty() ? as_it_is : turned;

  // Edges of faces between vertices of rims, in their direction: each may be there once.
  std::vector<char> on_rim(mesh.vertices(), 0);
  for (const RimEdge& e : rims.edge) on_rim[e.from] = 1;
  std::unordered_set<std::uint64_t> taken;
  for (int c = 0; c < static_cast<int>(mesh.triangle.size()); ++c)
    if (on_rim[mesh.triangle[c]] && on_rim[mesh.triangle[next_corner(c)]])
      taken.insert(key_of(mesh.triangle[c], mesh.triangle[next_corner(c)]));
  std::vector<int> apex_of(rims.edge.size(), -1);  // of the stitch at each edge
  const auto fits = [&](const RimEdge& e, int apex) {
    return face_each_other(rims.frame[&e - rims.edge.data()], rims.frame_at.at(apex)) && apex != e.from &&
           apex != e.to && !taken.count(key_of(e.to, e.from)) && !taken.count(key_of(e.from, apex)) &&
           !taken.count(key_of(apex, e.to));
  };
  const auto add = [&](const RimEdge& e, int apex) {
    taken.insert({key_of(e.to, e.from), key_of(e.from, apex), key_of(apex, e.to)});
    apex_of[&e - rims.edge.data()] = apex;
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
  drop_short_runs(rims, apex_of);
  std::vector<int> triangle = mesh.triangle;
  int added = 0;
  for (std::size_t i = 0; i < rims.edge.size(); ++i)
    if (apex_of[i] >= 0) triangle.insert(triangle.end(), {rims.edge[i].to, rims.edge[i].from, apex_of[i]}), ++added;
  if (added > 0) to = surface_of(mesh.position, std::move(triangle), context);
  return added;
}

}  // namespace ga_symmetry
