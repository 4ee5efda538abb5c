// SPDX-License-Identifier: GPL-3.0-or-later
#include "damage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace samples {
namespace {

// Per vertex, the next one along the border; -1 inside.
std::vector<std::vector<int>> border(const Mesh& mesh) {
  std::map<std::pair<int, int>, bool> directed;
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) directed[{f[k], f[(k + 1) % 3]}] = true;
  std::vector<std::vector<int>> next(mesh.point.size());
  for (const auto& e : directed)
    if (!directed.count({e.first.second, e.first.first})) next[e.first.first].push_back(e.first.second);
  return next;
}

// Faces of the component with the most faces, connected through edges.
std::vector<Face> largest_component(const std::vector<Face>& faces) {
  std::vector<int> root(faces.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  std::map<std::pair<int, int>, int> at;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [other, fresh] = at.insert({std::minmax(faces[f][k], faces[f][(k + 1) % 3]), static_cast<int>(f)});
      if (!fresh) root[find(static_cast<int>(f))] = find(other->second);
    }
  std::map<int, int> size;
  for (std::size_t f = 0; f < faces.size(); ++f) ++size[find(static_cast<int>(f))];
  const int largest =
      std::max_element(size.begin(), size.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
  std::vector<Face> out;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (find(static_cast<int>(f)) == largest) out.push_back(faces[f]);
  return out;
}

}  // namespace

Sample without(const Sample& s, std::vector<bool> drop) {
  std::vector<Face> faces = s.mesh.face;
  for (bool again = true; again;) {
    const auto gone = [&](const Face& f) { return drop[f[0]] || drop[f[1]] || drop[f[2]]; };
    faces.erase(std::remove_if(faces.begin(), faces.end(), gone), faces.end());
    faces = largest_component(faces);
    Mesh rest;
    rest.point = s.mesh.point;
    rest.face = faces;
    again = false;
    const auto next = border(rest);
    for (std::size_t v = 0; v < next.size(); ++v)
      if (next[v].size() > 1) drop[v] = again = true;
  }
  std::vector<int> index(s.mesh.point.size(), -1);
  for (const Face& f : faces)
    for (int v : f) index[v] = 0;
  Sample out = s;
  out.mesh = {};
  out.rest.clear();
  out.partner.clear();
  for (std::size_t v = 0; v < index.size(); ++v)
    if (index[v] == 0) {
      index[v] = out.mesh.points();
      out.mesh.point.push_back(s.mesh.point[v]);
      out.rest.push_back(s.rest[v]);
      out.partner.push_back(s.partner[v]);
    }
  for (const Face& f : faces) out.mesh.face.push_back({index[f[0]], index[f[1]], index[f[2]]});
  for (int& w : out.partner) w = w < 0 ? -1 : index[w];
  out.closed = false;
  return out;
}

namespace {

template <class Predicate>
Sample remove_where(const Sample& s, Predicate predicate) {
  std::vector<bool> drop(s.mesh.point.size());
  for (std::size_t v = 0; v < drop.size(); ++v) drop[v] = predicate(v);
  return without(s, std::move(drop));
}

}  // namespace

Sample without_left_hand(const Sample& whole) {
  Sample s = remove_where(whole, [&](std::size_t v) { return whole.rest[v].x() > 66; });
  const auto next = border(s.mesh);
  std::vector<int> loop;
  const auto on_border = [](const auto& n) { return !n.empty(); };
  const auto first = std::find_if(next.begin(), next.end(), on_border);
  require(first != next.end(), "there is a wound");
  int v = static_cast<int>(first - next.begin());
  do loop.push_back(v), v = next[v][0];
  while (v != loop[0]);
  require(std::count_if(next.begin(), next.end(), on_border) == std::ptrdiff_t(loop.size()), "the wound is one loop");
  Vec3 centre = Vec3::Zero(), rest = Vec3::Zero();
  for (int w : loop) centre += s.mesh.point[w] / loop.size(), rest += s.rest[w] / loop.size();
  for (std::size_t i = 0; i < loop.size(); ++i)
    s.mesh.face.push_back({loop[(i + 1) % loop.size()], loop[i], s.mesh.points()});
  s.mesh.point.push_back(centre);
  s.rest.push_back(rest);
  s.partner.push_back(-1);
  s.closed = true;
  return s;
}

Sample with_hump(const Sample& flat) {
  Sample s = flat;
  const Vec3 centre(8, 126, -10);
  constexpr double kRadius = 11, kHeight = 7;  // cm
  std::vector<Vec3> normal(s.mesh.point.size(), Vec3::Zero());
  for (const Face& f : s.mesh.face)
    for (int v : f)
      normal[v] += (s.mesh.point[f[1]] - s.mesh.point[f[0]]).cross(s.mesh.point[f[2]] - s.mesh.point[f[0]]);
  std::vector<int> raised;
  for (int v = 0; v < s.mesh.points(); ++v) {
    const double t = (s.rest[v] - centre).norm() / kRadius;
    if (t >= 1) continue;
    const double bump = (1 - t * t) * (1 - t * t);
    s.mesh.point[v] += kHeight * bump * normal[v].normalized();
    if (bump > 0.1) raised.push_back(v);
  }
  for (int v : raised) {
    if (s.partner[v] >= 0) s.partner[s.partner[v]] = -1;
    s.partner[v] = -1;
  }
  return s;
}

Sample with_hole(const Sample& s) {
  const Vec3 centre(7, 124, 9);
  constexpr double kRadius = 6;  // cm
  return remove_where(s, [&](std::size_t v) { return (s.rest[v] - centre).norm() < kRadius; });
}

Sample partial_scan(const Sample& s) {
  const Vec3 hidden = Vec3(0.8, 0.05, -0.6).normalized();  // the side that the scanner does not see
  std::vector<double> depth;
  for (const Vec3& p : s.mesh.point) depth.push_back(p.dot(hidden));
  std::vector<double> sorted = depth;
  const auto limit = sorted.begin() + static_cast<long>(3 * sorted.size() / 4);
  std::nth_element(sorted.begin(), limit, sorted.end());
  return remove_where(s, [&](std::size_t v) { return depth[v] > *limit; });
}

}  // namespace samples
