// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "ga_symmetry/errors.h"
#include "surface/welded_mesh.h"

namespace ga_symmetry {
namespace {

double triangle_area(const double* a, const double* b, const double* c) {
  const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

std::string count_of(long n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

void stop_at(std::size_t i, const Context& context) {
  if (i % 65536 == 0 && context.cancelled()) throw Cancelled();
}

// At an edge of more than two faces: which of them are one sheet. Faces that hang on nothing else, fins, come last.
// Pairs wound alike come first, as the two sides of one solid are; of those the flattest. What is left over is a
// border.
// @param opposite  where edges of two faces alone are linked
void pair_sheets(Surface& s, const std::vector<int>& opposite, const int* corner, int count) {
  using Vector = Eigen::Vector3d;
  struct Pair {
    bool loose;    // one of them is a fin
    bool against;  // wound against each other
    double bend;   // cosine of the angle between the faces: -1 = flat
    int i, j;
  };
  std::vector<Vector> across(count);
  std::vector<bool> forward(count), loose(count);
  for (int i = 0; i < count; ++i) {
    const int c = corner[i], a = s.triangle[next_corner(c)], b = s.triangle[previous_corner(c)];
    const Vector p(s.point(std::min(a, b))), along = (Vector(s.point(std::max(a, b))) - p).normalized();
    const Vector up = Vector(s.point(s.triangle[c])) - p;
    across[i] = (up - up.dot(along) * along).normalized();
    forward[i] = a < b;
    loose[i] = opposite[next_corner(c)] < 0 && opposite[previous_corner(c)] < 0;
  }
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      pairs.push_back({loose[i] || loose[j], forward[i] == forward[j], across[i].dot(across[j]), i, j});
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.loose, x.against, x.bend, x.i, x.j) < std::tie(y.loose, y.against, y.bend, y.i, y.j);
  });
  std::vector<bool> taken(count);
  for (const Pair& p : pairs) {
    if (taken[p.i] || taken[p.j]) continue;
    taken[p.i] = taken[p.j] = true;
    s.opposite[corner[p.i]] = corner[p.j];
    s.opposite[corner[p.j]] = corner[p.i];
  }
  if (std::find(taken.begin(), taken.end(), false) != taken.end()) s.closed = false;
}

// Fills Surface::opposite.
void link_corners(Surface& s, const Context& context) {
  struct Edge {
    int low, high, corner;
  };
  // Grouped by the lower vertex first: the few edges of each are sorted in no time.
  const auto edge_of = [&](int c) -> Edge {
    const auto [low, high] = std::minmax(s.triangle[next_corner(c)], s.triangle[previous_corner(c)]);
    return {low, high, c};
  };
  std::vector<Edge> edges(s.triangle.size());
  std::vector<int> first(s.mesh_vertex.size() + 1, 0);
  for (int c = 0; c < static_cast<int>(edges.size()); ++c) ++first[edge_of(c).low + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> at = first;
  for (int c = 0; c < static_cast<int>(edges.size()); ++c) {
    stop_at(c, context);
    const Edge edge = edge_of(c);
    edges[at[edge.low]++] = edge;
  }
  for (std::size_t v = 0; v < s.mesh_vertex.size(); ++v) {
    stop_at(v, context);
    std::sort(edges.begin() + first[v], edges.begin() + first[v + 1],
              [](const Edge& x, const Edge& y) { return x.high != y.high ? x.high < y.high : x.corner < y.corner; });
  }
  s.opposite.assign(s.triangle.size(), -1);
  std::vector<int> sheets, first_sheet;  // corners at edges of more than two faces; where those of each edge begin
  for (std::size_t i = 0, j; i < edges.size(); i = j) {
    for (j = i + 1; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high;) ++j;
    if (j - i > 2) {
      first_sheet.push_back(static_cast<int>(sheets.size()));
      for (std::size_t k = i; k < j; ++k) sheets.push_back(edges[k].corner);
    } else if (j - i == 2) {
      s.opposite[edges[i].corner] = edges[i + 1].corner;
      s.opposite[edges[i + 1].corner] = edges[i].corner;
    } else {
      s.closed = false;
    }
  }
  // Only now it is known what else a face hangs on.
  s.branching = static_cast<int>(first_sheet.size());
  first_sheet.push_back(static_cast<int>(sheets.size()));
  const std::vector<int> linked = s.branching > 0 ? s.opposite : std::vector<int>();
  for (int e = 0; e < s.branching; ++e)
    pair_sheets(s, linked, &sheets[first_sheet[e]], first_sheet[e + 1] - first_sheet[e]);
}

void group_corners(Surface& s, int n) {
  s.first_corner.assign(n + 1, 0);
  for (int v : s.triangle) ++s.first_corner[v + 1];
  std::partial_sum(s.first_corner.begin(), s.first_corner.end(), s.first_corner.begin());
  s.corner_at.resize(s.triangle.size());
  std::vector<int> at(s.first_corner.begin(), s.first_corner.end() - 1);
  for (int c = 0; c < static_cast<int>(s.triangle.size()); ++c) s.corner_at[at[s.triangle[c]]++] = c;
}

// Orients faces alike, starting from the first face of each part; a conflict means a one-sided surface.
void orient_faces(Surface& s, const Context& context) {
  const int m = s.triangles();
  std::vector<char> flip(m, -1);
  std::vector<int> stack;
  for (int start = 0; start < m; ++start) {
    if (flip[start] >= 0) continue;
    flip[start] = 0;
    stack.push_back(start);
    while (!stack.empty()) {
      const int f = stack.back();
      stop_at(f, context);
      stack.pop_back();
      for (int c = 3 * f; c < 3 * f + 3; ++c) {
        const int o = s.opposite[c];
        if (o < 0) continue;
        const bool alike = s.triangle[next_corner(c)] == s.triangle[previous_corner(o)];
        const char wanted = alike ? flip[f] : static_cast<char>(1 - flip[f]);
        if (flip[o / 3] < 0) {
          flip[o / 3] = wanted;
          stack.push_back(o / 3);
        } else if (flip[o / 3] != wanted) {
          s.orientable = false;
        }
      }
    }
  }
  if (!s.orientable) {
    return;
  }
  if (std::find(flip.begin(), flip.end(), 1) == flip.end()) return;
  // A flipped face's second and third corner change places, and what is across them.
  const auto moved = [&](int c) { return c < 0 || !flip[c / 3] || c % 3 == 0 ? c : c % 3 == 1 ? c + 1 : c - 1; };
  const std::vector<int> opposite = s.opposite;
  for (int c = 0; c < 3 * m; ++c) s.opposite[moved(c)] = moved(opposite[c]);
  for (int f = 0; f < m; ++f)
    if (flip[f]) std::swap(s.triangle[3 * f + 1], s.triangle[3 * f + 2]), ++s.flipped;
}

// Everything that follows from the positions and triangles.
void connect(Surface& s, const Context& context) {
  const int n = static_cast<int>(s.position.size() / 3);
  link_corners(s, context);
  orient_faces(s, context);
  stop_at(0, context);
  group_corners(s, n);
  s.vertex_area.assign(n, 0.0);
  for (int f = 0; f < s.triangles(); ++f) {
    const double a = s.face_area(f);
    s.area += a;
    for (int k = 0; k < 3; ++k) s.vertex_area[s.triangle[3 * static_cast<std::size_t>(f) + k]] += a / 3;
  }
}

}  // namespace

double Surface::unit() const { return std::sqrt(area); }
double Surface::edge_length(int a, int b) const { return std::sqrt(squared_distance(point(a), point(b))); }

double Surface::face_area(int f) const {
  const int* t = &triangle[3 * static_cast<std::size_t>(f)];
  return triangle_area(point(t[0]), point(t[1]), point(t[2]));
}

Surface surface_of(std::vector<double> position, std::vector<int> triangle, const Context& context) {
  Surface s;
  s.position = std::move(position);
  s.triangle = std::move(triangle);
  s.mesh_vertices = static_cast<int>(s.position.size() / 3);
  s.mesh_vertex.resize(s.mesh_vertices);
  std::iota(s.mesh_vertex.begin(), s.mesh_vertex.end(), 0);
  s.surface_vertex = s.mesh_vertex;
  connect(s, context);
  return s;
}

Surface make_surface(const TriangleMesh& mesh, bool largest_component, const Context& context) {
  WeldedMesh welded = weld(mesh, context);
  if (largest_component) keep_largest(welded);
  Surface s;
  s.mesh_vertices = mesh.vertices();
  s.position = std::move(welded.position);
  s.triangle = std::move(welded.triangle);
  s.mesh_vertex = std::move(welded.vertex);
  s.surface_vertex = std::move(welded.place);
  connect(s, context);
  s.notes = std::move(welded.notes);
  if (s.branching) s.notes.push_back("cut " + count_of(s.branching, "edge") + " of more than two faces");
  if (s.flipped) s.notes.push_back("turned " + count_of(s.flipped, "face") + " to face their neighbours' way");
  if (!s.orientable) s.notes.push_back("a part has only one side, so orientation is not used");
  return s;
}

}  // namespace ga_symmetry
