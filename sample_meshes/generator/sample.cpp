// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "remesh.h"

namespace samples {
namespace {

using Neighbours = std::vector<std::set<int>>;

Neighbours neighbours(const Mesh& mesh) {
  Neighbours out(mesh.point.size());
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) out[f[k]].insert(f[(k + 1) % 3]), out[f[(k + 1) % 3]].insert(f[k]);
  return out;
}

// Shortest ways along edges: good enough to choose references.
std::vector<double> distances(const Mesh& mesh, const Neighbours& around, const std::vector<int>& sources) {
  std::vector<double> d(mesh.point.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
  for (int s : sources) queue.push({d[s] = 0, s});
  while (!queue.empty()) {
    const auto [now, v] = queue.top();
    queue.pop();
    if (now > d[v]) continue;
    for (int w : around[v]) {
      const double way = now + (mesh.point[w] - mesh.point[v]).norm();
      if (way < d[w]) queue.push({d[w] = way, w});
    }
  }
  return d;
}

double least_angle(const Mesh& mesh) {
  double least = 180;
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = mesh.point[f[(k + 1) % 3]] - mesh.point[f[k]], v = mesh.point[f[(k + 2) % 3]] - mesh.point[f[k]];
      least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::acos(-1.0));
    }
  return least;
}

void check_truth(const Sample& s) {
  std::vector<int> seen(s.partner.size(), 0);
  std::map<int, int> offsets;
  for (int v = 0; v < s.mesh.points(); ++v) {
    const int w = s.partner[v];
    if (w < 0) continue;
    ++seen[w];
    if (v != w) ++offsets[w - v];
    if (!s.exact) continue;
    int back = v;
    for (int k = 0; k < s.order && back >= 0; ++k) back = s.partner[back];
    require(back >= 0 && s.mesh.point[back] == s.mesh.point[v],
            s.name + ": the truth leads back after " + std::to_string(s.order) + " steps");
  }
  if (s.exact && !s.assembled)
    for (int count : seen) require(count <= 1, s.name + ": no two vertices share a partner");
  for (const auto& [offset, count] : offsets)
    require(count < 20 + s.mesh.points() / 100, s.name + ": indices tell nothing about partners");
}

// Share of edges that the truth maps onto edges: 1 would be symmetric connectivity.
double kept_edges(const Sample& s, const Neighbours& around) {
  double kept = 0, all = 0;
  for (int v = 0; v < s.mesh.points(); ++v)
    for (int w : around[v])
      if (s.partner[v] >= 0 && s.partner[w] >= 0) {
        ++all;
        kept += around[s.partner[v]].count(s.partner[w]) > 0;
      }
  return kept / all;
}

std::ofstream open(const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  if (!out) throw std::runtime_error("cannot write " + path + ": make the folder, or choose another");
  return out;
}

void close(std::ofstream& out, const std::string& path) {
  out.close();
  if (!out) throw std::runtime_error("cannot write all of " + path + ": is the disk full?");
}

}  // namespace

std::array<int, 4> references(const Sample& s) {
  const Neighbours around = neighbours(s.mesh);
  std::vector<int> fixed;
  for (int v = 0; v < s.mesh.points(); ++v)
    if (s.partner[v] == v) fixed.push_back(v);
  require(fixed.size() >= 2, "at least two vertices are their own partners");
  std::array<int, 4> refs{};
  double farthest = -1;
  for (int a = fixed[0];;) {  // to the farthest one and back, until that is no gain
    const std::vector<double> d = distances(s.mesh, around, {a});
    const int b = *std::max_element(fixed.begin(), fixed.end(), [&](int v, int w) { return d[v] < d[w]; });
    if (d[b] <= farthest) break;
    farthest = d[b];
    refs[0] = a;
    refs[1] = b;
    a = b;
  }
  const std::vector<double> d = distances(s.mesh, around, fixed);
  farthest = -1;
  for (int v = 0; v < s.mesh.points(); ++v) {
    const int w = s.partner[v];
    if (w < 0 || s.partner[w] < 0 || (s.order == 2 && s.partner[w] != v)) continue;
    if (d[v] > farthest) farthest = d[v], refs[2] = v, refs[3] = w;
  }
  return refs;
}

void check_surface(const Sample& s) {
  const Mesh& m = s.mesh;
  const Neighbours around = neighbours(m);
  std::map<std::pair<int, int>, int> next;  // directed edge -> third vertex
  for (const Face& f : m.face)
    for (int k = 0; k < 3; ++k)
      require(next.insert({{f[k], f[(k + 1) % 3]}, f[(k + 2) % 3]}).second,
              s.name + " is manifold and coherently oriented");
  std::vector<int> corners(m.point.size(), 0), open(m.point.size(), 0);
  std::vector<std::pair<int, int>> start(m.point.size(), {-1, -1});
  bool closed = true;
  for (const auto& [edge, third] : next) {
    const auto [v, w] = edge;
    ++corners[v];
    const bool border = !next.count({w, v});
    closed = closed && !border;
    open[v] += border;
    if (border || start[v].first < 0) start[v] = {v, w};
  }
  require(closed == s.closed, s.name + " is " + (s.closed ? "closed" : "open"));
  for (int v = 0; v < m.points(); ++v) {
    require(corners[v] > 0 && open[v] <= 1, s.name + ": every vertex is in one fan of faces");
    int turn = 0;  // faces met by going round the vertex from the border, or from anywhere
    auto edge = start[v];
    do {
      const auto face = next.find(edge);
      if (face == next.end()) break;
      edge = {v, face->second};
      ++turn;
    } while (edge != start[v] && turn <= corners[v]);
    require(turn == corners[v], s.name + ": every vertex is in one fan of faces");
  }
  const std::vector<double> d = distances(m, around, {0});
  require(*std::max_element(d.begin(), d.end()) < 1e30, s.name + " is one component");
  double volume = 0;
  const Vec3 inside = std::accumulate(m.point.begin(), m.point.end(), Vec3(0, 0, 0)) / m.points();
  for (const Face& f : m.face)
    volume += (m.point[f[0]] - inside).dot((m.point[f[1]] - inside).cross(m.point[f[2]] - inside)) / 6;
  require(volume > 0, s.name + " is oriented outwards");
  require(self_intersections(m) == 0,
          s.name + " does not cut itself: " + std::to_string(self_intersections(m)) + " faces do");
}

void shuffle(Sample& sample, ga_symmetry::Random& random) {
  const auto order = [&](std::size_t n) {
    std::vector<int> out(n);
    std::iota(out.begin(), out.end(), 0);
    for (std::size_t i = n; i > 1; --i) std::swap(out[i - 1], out[ga_symmetry::draw_below(random, i)]);
    return out;
  };
  const Sample old = sample;
  const std::vector<int> from = order(old.mesh.point.size());
  std::vector<int> to(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[from[i]] = static_cast<int>(i);
  const auto renamed = [&](int v) { return v < 0 ? -1 : to[v]; };
  for (std::size_t i = 0; i < from.size(); ++i) {
    sample.mesh.point[i] = old.mesh.point[from[i]];
    sample.rest[i] = old.rest[from[i]];
    sample.partner[i] = renamed(old.partner[from[i]]);
    for (std::size_t k = 0; k < old.mirrors.size(); ++k) sample.mirrors[k][i] = renamed(old.mirrors[k][from[i]]);
  }
  const std::vector<int> face_from = order(old.mesh.face.size());
  for (std::size_t i = 0; i < face_from.size(); ++i) {
    Face f = old.mesh.face[face_from[i]];
    std::rotate(f.begin(), f.begin() + static_cast<long>(ga_symmetry::draw_below(random, 3)), f.end());
    for (int k = 0; k < 3; ++k) sample.mesh.face[i][k] = to[f[k]];
  }
}

void write(Sample s, const std::string& folder) {
  for (Vec3& p : s.mesh.point) p = (p * 1000).array().round() / 1000;  // three decimals are written
  const Neighbours around = neighbours(s.mesh);
  if (!s.assembled) check_surface(s);
  check_truth(s);
  const double angle = least_angle(s.mesh), kept = kept_edges(s, around);
  require(s.assembled || angle > 3, s.name + " has no slivers, least angle " + std::to_string(angle));
  require(s.assembled || kept < 0.95, s.name + ": connectivity is not symmetric");

  const std::string base = folder + "/" + s.name;
  const int n = s.mesh.points();
  std::ofstream off = open(base + ".off");
  off << "OFF\n" << n << ' ' << s.mesh.face.size() << " 0\n";
  char line[96];
  for (const Vec3& p : s.mesh.point) {
    std::snprintf(line, sizeof line, "%.3f %.3f %.3f\n", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
    off << line;
  }
  for (const Face& f : s.mesh.face) off << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  close(off, base + ".off");

  std::ofstream truth = open(base + ".truth");
  int without = 0;
  for (int v = 0; v < n; ++v)
    if (s.partner[v] >= 0)
      truth << v << ' ' << s.partner[v] << '\n';
    else
      ++without;
  close(truth, base + ".truth");
  if (without > 0) {
    std::ofstream affected = open(base + ".affected");
    for (int v = 0; v < n; ++v)
      if (s.partner[v] < 0) affected << v << '\n';
    close(affected, base + ".affected");
  }
  if (!s.mirrors.empty()) {
    std::ofstream mirrors = open(base + ".mirrors");
    for (int v = 0; v < n; ++v) {
      mirrors << v;
      for (const auto& m : s.mirrors) mirrors << ' ' << m[v];
      mirrors << '\n';
    }
    close(mirrors, base + ".mirrors");
  }
  const std::array<int, 4> refs = s.refs[0] < 0 ? references(s) : s.refs;
  std::ofstream out = open(base + ".refs");
  out << refs[0] << ' ' << refs[1] << ' ' << refs[2] << ' ' << refs[3] << '\n';
  close(out, base + ".refs");
  std::printf("%-22s %6d vertices %7zu faces  least angle %4.1f  edges kept %.2f  without partner %d\n", s.name.c_str(),
              n, s.mesh.face.size(), angle, kept, without);
}

}  // namespace samples
