// SPDX-License-Identifier: GPL-3.0-or-later
#include "damage_kit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "surface/welded_mesh.h"

namespace ga_symmetry::damage {
namespace {

using Vector = Eigen::Vector3d;

Vector point(const TriangleMesh& mesh, int v) { return Vector(&mesh.position[3 * static_cast<std::size_t>(v)]); }

void move(TriangleMesh& mesh, int v, const Vector& by) {
  for (int k = 0; k < 3; ++k) mesh.position[3 * static_cast<std::size_t>(v) + k] += by[k];
}

int add_vertex(Damaged& d, const Vector& p, int origin, int nearest, int partner) {
  d.mesh.position.insert(d.mesh.position.end(), p.data(), p.data() + 3);
  d.origin.push_back(origin);
  d.nearest.push_back(nearest);
  d.partner.push_back(partner);
  return d.mesh.vertices() - 1;
}

int add_copy(Damaged& d, int v) { return add_vertex(d, point(d.mesh, v), d.origin[v], d.nearest[v], d.partner[v]); }

void add_face(Damaged& d, int a, int b, int c) { d.mesh.triangle.insert(d.mesh.triangle.end(), {a, b, c}); }

// Corner c as the edge from its vertex to the next corner's.
int tail(const TriangleMesh& mesh, int c) { return mesh.triangle[c]; }
int head(const TriangleMesh& mesh, int c) { return mesh.triangle[c % 3 == 2 ? c - 2 : c + 1]; }
int tip(const TriangleMesh& mesh, int c) { return mesh.triangle[c % 3 == 0 ? c + 2 : c - 1]; }

// Per corner: the corner of the other face at its edge; -1 where there is not exactly one.
std::vector<int> across(const TriangleMesh& mesh) {
  const int corners = 3 * mesh.triangles();
  std::vector<std::array<int, 3>> edges;
  for (int c = 0; c < corners; ++c) {
    const int a = tail(mesh, c), b = head(mesh, c);
    edges.push_back({std::min(a, b), std::max(a, b), c});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<int> out(corners, -1);
  for (std::size_t i = 0, j; i < edges.size(); i = j) {
    for (j = i; j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1];) ++j;
    if (j - i == 2) out[edges[i][2]] = edges[i + 1][2], out[edges[i + 1][2]] = edges[i][2];
  }
  return out;
}

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (int c = 0; c < 3 * mesh.triangles(); ++c)
    sum += (point(mesh, tail(mesh, c)) - point(mesh, head(mesh, c))).norm();
  return sum / (3 * mesh.triangles());
}

Eigen::AlignedBox3d box(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d out;
  for (const int v : mesh.triangle) out.extend(point(mesh, v));
  return out;
}

double draw(Random& random, double low, double high) { return low + (high - low) * draw_unit(random); }

Vector draw_vector(Random& random) {
  Vector out;
  for (int k = 0; k < 3; ++k) out[k] = draw(random, -1, 1);
  return out;
}

Vector draw_direction(Random& random) {
  Vector out;
  do out = draw_vector(random);
  while (out.norm() > 1 || out.norm() < 0.1);
  return out.normalized();
}

std::vector<int> permutation(int n, Random& random) {
  std::vector<int> out(n);
  std::iota(out.begin(), out.end(), 0);
  for (int i = n; i > 1; --i) std::swap(out[i - 1], out[draw_below(random, i)]);
  return out;
}

struct Plane {
  Vector normal, point;
  bool above(const Vector& p) const { return normal.dot(p - point) > 0; }
};

// Through random vertices, with a twentieth of the vertices on either side.
std::vector<Plane> draw_planes(const TriangleMesh& mesh, int count, Random& random) {
  constexpr double kSide = 0.05;
  constexpr int kMostTries = 1000;
  std::vector<Plane> out;
  for (int i = 0; i < kMostTries && static_cast<int>(out.size()) < count; ++i) {
    const Plane plane{draw_direction(random), point(mesh, static_cast<int>(draw_below(random, mesh.vertices())))};
    double above = 0;
    for (int v = 0; v < mesh.vertices(); ++v) above += plane.above(point(mesh, v));
    above /= mesh.vertices();
    if (above > kSide && above < 1 - kSide) out.push_back(plane);
  }
  return out;
}

// Gives every piece its own copies of the vertices on its border. @return per vertex: its piece, -1 = was not doubled
std::vector<int> split(Damaged& d, const std::vector<int>& piece_of_face) {
  const int n = d.mesh.vertices();
  std::vector<std::vector<std::pair<int, int>>> copies(n);  // piece, vertex
  for (std::size_t c = 0; c < d.mesh.triangle.size(); ++c) {
    const int v = d.mesh.triangle[c], piece = piece_of_face[c / 3];
    auto& mine = copies[v];
    auto at = std::find_if(mine.begin(), mine.end(), [&](const auto& copy) { return copy.first == piece; });
    if (at == mine.end()) at = mine.insert(mine.end(), {piece, mine.empty() ? v : add_copy(d, v)});
    d.mesh.triangle[c] = at->second;
  }
  std::vector<int> out(d.mesh.vertices(), -1);
  for (const auto& mine : copies)
    if (mine.size() > 1)
      for (const auto& [piece, v] : mine) out[v] = piece;
  return out;
}

// What is nearest to each of some random faces, over edges.
std::vector<int> draw_charts(const TriangleMesh& mesh, int charts, Random& random) {
  const std::vector<int> other = across(mesh);
  std::vector<int> chart(mesh.triangles(), -1), reached;
  if (chart.empty()) return chart;
  for (int i = 0; i < charts; ++i) {
    const int f = static_cast<int>(draw_below(random, mesh.triangles()));
    if (chart[f] < 0) chart[f] = i, reached.push_back(f);
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int o = other[3 * reached[i] + k]; o >= 0 && chart[o / 3] < 0)
        chart[o / 3] = chart[reached[i]], reached.push_back(o / 3);
  return chart;
}

// Edges of two faces at random, no two of them of one face.
std::vector<int> draw_edges(const TriangleMesh& mesh, int count, Random& random) {
  const std::vector<int> other = across(mesh);
  std::vector<char> used(mesh.triangles(), 0);
  std::vector<int> out;
  for (const int c : permutation(3 * mesh.triangles(), random)) {
    if (static_cast<int>(out.size()) == count) break;
    if (other[c] < 0 || used[c / 3] || used[other[c] / 3]) continue;
    used[c / 3] = used[other[c] / 3] = 1;
    out.push_back(c);
  }
  return out;
}

// Splits the face at an edge at the edge's middle; the face beyond stays. @return the vertex in the middle
int split_one_side(Damaged& d, int corner) {
  const int a = tail(d.mesh, corner), b = head(d.mesh, corner), c = tip(d.mesh, corner);
  const int middle = add_vertex(d, (point(d.mesh, a) + point(d.mesh, b)) / 2, -1, d.nearest[a], d.partner[a]);
  d.mesh.triangle[corner % 3 == 2 ? corner - 2 : corner + 1] = middle;
  add_face(d, middle, b, c);
  return middle;
}

// Takes away the faces with a vertex that goes, then all but the largest part.
void take_away(Damaged& d, const std::vector<char>& gone) {
  const auto keep = [&](const auto& wanted) {
    std::vector<int> kept;
    for (int f = 0; f < d.mesh.triangles(); ++f) {
      const int* t = &d.mesh.triangle[3 * static_cast<std::size_t>(f)];
      if (wanted(f)) kept.insert(kept.end(), t, t + 3);
    }
    d.mesh.triangle = std::move(kept);
  };
  keep([&](int f) {
    const int* t = &d.mesh.triangle[3 * static_cast<std::size_t>(f)];
    return !gone[t[0]] && !gone[t[1]] && !gone[t[2]];
  });
  int count = 0;
  const std::vector<int> part = face_parts(d.mesh.triangle, d.mesh.vertices(), count);
  std::vector<int> faces(count, 0);
  for (const int p : part) ++faces[p];
  const auto largest = static_cast<int>(std::max_element(faces.begin(), faces.end()) - faces.begin());
  keep([&](int f) { return part[f] == largest; });
}

// Marks the vertices with the greatest values.
void mark(const std::vector<double>& value, double share, std::vector<char>& gone) {
  std::vector<int> order(value.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return value[a] > value[b]; });
  order.resize(static_cast<std::size_t>(share * static_cast<double>(value.size())));
  for (const int v : order) gone[v] = 1;
}

int share_of(const Damaged& d, double share) {
  return std::max(1, static_cast<int>(std::lround(share * d.mesh.triangles())));
}

}  // namespace

int Damaged::copy_of(int whole_vertex) const {
  const auto at = std::find(origin.begin(), origin.end(), whole_vertex);
  return at == origin.end() ? -1 : static_cast<int>(at - origin.begin());
}

Damaged whole(const TriangleMesh& mesh, const std::vector<int>& truth) {
  Damaged d;
  d.mesh = mesh;
  d.origin.resize(mesh.vertices());
  std::iota(d.origin.begin(), d.origin.end(), 0);
  d.nearest = d.origin;
  d.truth = d.partner = truth;
  return d;
}

void split_seams(Damaged& d, int charts, Random& random) { split(d, draw_charts(d.mesh, charts, random)); }

void split_seams_apart(Damaged& d, int charts, Random& random) {
  const double rounding = 1e-6 * box(d.mesh).sizes().maxCoeff();
  const std::vector<int> piece = split(d, draw_charts(d.mesh, charts, random));
  for (int v = 0; v < d.mesh.vertices(); ++v)
    if (piece[v] >= 0) move(d.mesh, v, rounding * draw_vector(random));
}

void cut(Damaged& d, int planes, double gap, Random& random) {
  const std::vector<Plane> plane = draw_planes(d.mesh, planes, random);
  std::vector<int> side(d.mesh.triangles(), 0);  // a bit for each plane
  for (int f = 0; f < d.mesh.triangles(); ++f) {
    Vector centre = Vector::Zero();
    for (int k = 0; k < 3; ++k) centre += point(d.mesh, d.mesh.triangle[3 * f + k]) / 3;
    for (std::size_t k = 0; k < plane.size(); ++k) side[f] |= plane[k].above(centre) << k;
  }
  const double apart = gap * mean_edge(d.mesh) / 2;
  const std::vector<int> piece = split(d, side);
  if (gap <= 0) return;
  // Sides of all copies of a vertex; what is left in one piece is on one side.
  std::vector<int> met(d.truth.size(), 0), missed(d.truth.size(), 0);
  for (int v = 0; v < d.mesh.vertices(); ++v)
    if (piece[v] >= 0 && d.origin[v] >= 0) met[d.origin[v]] |= piece[v], missed[d.origin[v]] |= ~piece[v];
  for (int v = 0; v < d.mesh.vertices(); ++v)
    for (std::size_t k = 0; k < plane.size(); ++k)
      if (piece[v] >= 0 && d.origin[v] >= 0 && (met[d.origin[v]] & missed[d.origin[v]]) >> k & 1)
        move(d.mesh, v, (piece[v] >> k & 1 ? apart : -apart) * plane[k].normal);
}

void remove_strips(Damaged& d, int planes, Random& random) {
  const std::vector<Plane> plane = draw_planes(d.mesh, planes, random);
  std::vector<int> kept;
  for (int f = 0; f < d.mesh.triangles(); ++f) {
    const int* t = &d.mesh.triangle[3 * static_cast<std::size_t>(f)];
    const bool crossed = std::any_of(plane.begin(), plane.end(), [&](const Plane& p) {
      const bool above = p.above(point(d.mesh, t[0]));
      return p.above(point(d.mesh, t[1])) != above || p.above(point(d.mesh, t[2])) != above;
    });
    if (!crossed) kept.insert(kept.end(), t, t + 3);
  }
  d.mesh.triangle = std::move(kept);
}

void add_fins(Damaged& d, int count, Random& random) {
  for (const int c : draw_edges(d.mesh, count, random)) {
    const int a = tail(d.mesh, c), b = head(d.mesh, c);
    const Vector p = point(d.mesh, a), q = point(d.mesh, b);
    const Vector normal = (q - p).cross(point(d.mesh, tip(d.mesh, c)) - p).stableNormalized();
    const double height = draw(random, 1, 3) * (q - p).norm();
    add_face(d, a, b, add_vertex(d, (p + q) / 2 + height * normal, -1, d.nearest[a], -1));
  }
}

void repeat_faces(Damaged& d, int count, Random& random) {
  std::vector<int> faces = permutation(d.mesh.triangles(), random);
  faces.resize(std::min<std::size_t>(faces.size(), count));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::size_t f = faces[i];
    const int a = d.mesh.triangle[3 * f], b = d.mesh.triangle[3 * f + 1], c = d.mesh.triangle[3 * f + 2];
    i % 2 ? add_face(d, b, a, c) : add_face(d, b, c, a);
  }
}

void add_zero_area(Damaged& d, int count, Random& random) {
  const std::vector<int> edges = draw_edges(d.mesh, count, random);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int a = tail(d.mesh, edges[i]), b = head(d.mesh, edges[i]);
    add_face(d, a, b, i % 2 ? add_copy(d, b) : split_one_side(d, edges[i]));
  }
}

void flip_faces(Damaged& d, double share, Random& random) {
  for (int f = 0; f < d.mesh.triangles(); ++f)
    if (draw_unit(random) < share) std::swap(d.mesh.triangle[3 * f], d.mesh.triangle[3 * f + 1]);
}

void loosen_faces(Damaged& d, double share, Random& random) {
  for (int f = 0; f < d.mesh.triangles(); ++f)
    if (share >= 1 || draw_unit(random) < share)
      for (int k = 0; k < 3; ++k) d.mesh.triangle[3 * f + k] = add_copy(d, d.mesh.triangle[3 * f + k]);
}

void add_debris(Damaged& d, int pieces, Random& random) {
  constexpr double kAround = 0.1;  // of the box
  const Eigen::AlignedBox3d around = box(d.mesh);
  if (around.isEmpty()) return;
  for (int i = 0; i < pieces; ++i) {
    const double size = draw(random, 0.003, 0.015) * around.diagonal().norm();
    const Vector centre = around.center() + (0.5 + kAround) * around.sizes().cwiseProduct(draw_vector(random));
    int v[4];
    for (int& corner : v) corner = add_vertex(d, centre + size / 2 * draw_direction(random), -1, -1, -1);
    add_face(d, v[0], v[1], v[2]);
    add_face(d, v[0], v[2], v[3]);
    if (i % 2) continue;
    add_face(d, v[0], v[3], v[1]);
    add_face(d, v[1], v[3], v[2]);
  }
}

void add_junctions(Damaged& d, int count, Random& random) {
  for (const int c : draw_edges(d.mesh, count, random)) split_one_side(d, c);
}

void add_noise(Damaged& d, double size, Random& random) {
  for (double& x : d.mesh.position) x += draw(random, -size, size);
}

void cut_off(Damaged& d, double share, Random& random) {
  const Vector direction = draw_direction(random);
  std::vector<double> height;
  for (int v = 0; v < d.mesh.vertices(); ++v) height.push_back(point(d.mesh, v).dot(direction));
  std::vector<char> gone(d.mesh.vertices(), 0);
  mark(height, share, gone);
  take_away(d, gone);
}

void bite(Damaged& d, int balls, double share, Random& random) {
  std::vector<char> gone(d.mesh.vertices(), 0);
  for (int i = 0; i < balls; ++i) {
    const Vector centre = point(d.mesh, static_cast<int>(draw_below(random, d.mesh.vertices())));
    std::vector<double> nearness;
    for (int v = 0; v < d.mesh.vertices(); ++v) nearness.push_back(-(point(d.mesh, v) - centre).norm());
    mark(nearness, share, gone);
  }
  take_away(d, gone);
}

void finish(Damaged& d, Random& random) {
  const Damaged old = d;
  std::vector<char> used(old.mesh.vertices(), 0);
  for (const int v : old.mesh.triangle) used[v] = 1;
  d.mesh.position.clear(), d.origin.clear(), d.nearest.clear(), d.partner.clear();
  std::vector<int> to(old.mesh.vertices(), -1), copy(d.truth.size(), -1);
  for (const int v : permutation(old.mesh.vertices(), random)) {
    if (!used[v]) continue;
    to[v] = add_vertex(d, point(old.mesh, v), old.origin[v], old.nearest[v], old.partner[v]);
    if (old.origin[v] >= 0 && copy[old.origin[v]] < 0) copy[old.origin[v]] = to[v];
  }
  for (int& w : d.partner)
    if (w >= 0) w = copy[w];
  const std::vector<int> faces = permutation(old.mesh.triangles(), random);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto turn = static_cast<int>(draw_below(random, 3));
    for (int k = 0; k < 3; ++k) d.mesh.triangle[3 * i + k] = to[old.mesh.triangle[3 * faces[i] + (k + turn) % 3]];
  }
}

const std::vector<Kind>& kinds() {
  constexpr int kCharts = 12, kPlanes = 3, kDebris = 20;
  constexpr double kNarrow = 0.1, kFins = 0.01, kRepeated = 0.05, kZeroArea = 0.02, kFlipped = 0.2, kJunctions = 0.02;
  static const std::vector<Kind> all{
      {"seams", [](Damaged& d, Random& random) { split_seams(d, kCharts, random); }},
      {"seams_apart", [](Damaged& d, Random& random) { split_seams_apart(d, kCharts, random); }},
      {"cut", [](Damaged& d, Random& random) { cut(d, kPlanes, 0, random); }},
      {"narrow_gaps", [](Damaged& d, Random& random) { cut(d, kPlanes, kNarrow, random); }},
      {"gaps", [](Damaged& d, Random& random) { remove_strips(d, kPlanes, random); }},
      {"fins", [](Damaged& d, Random& random) { add_fins(d, share_of(d, kFins), random); }},
      {"repeated_faces", [](Damaged& d, Random& random) { repeat_faces(d, share_of(d, kRepeated), random); }},
      {"zero_area", [](Damaged& d, Random& random) { add_zero_area(d, share_of(d, kZeroArea), random); }},
      {"flipped_faces", [](Damaged& d, Random& random) { flip_faces(d, kFlipped, random); }},
      {"soup", [](Damaged& d, Random& random) { loosen_faces(d, 1, random); }},
      {"debris", [](Damaged& d, Random& random) { add_debris(d, kDebris, random); }},
      {"junctions", [](Damaged& d, Random& random) { add_junctions(d, share_of(d, kJunctions), random); }},
      {"all", [](Damaged& d, Random& random) {
         const std::size_t last = kinds().size() - 1;
         // New vertices on edges and fins first: they want edges of two faces. The soup is of some faces only, or
         // nothing would be left of the seams.
         for (const char* name : {"zero_area", "junctions", "fins", "gaps", "narrow_gaps", "seams_apart",
                                  "repeated_faces", "flipped_faces", "debris"})
           for (std::size_t i = 0; i < last; ++i)
             if (kinds()[i].name == name) kinds()[i].apply(d, random);
         loosen_faces(d, kFlipped, random);
       }}};
  return all;
}

const std::vector<Kind>& partial_kinds() {
  static const std::vector<Kind> both{
      {"cut_off", [](Damaged& d, Random& random) { cut_off(d, draw(random, 0.1, 0.25), random); }},
      {"bitten", [](Damaged& d, Random& random) { bite(d, 3, 0.05, random); }}};
  return both;
}

Damaged damaged(const TriangleMesh& mesh, const std::vector<int>& truth, const Kind& kind, std::uint64_t seed) {
  Random random(seed);
  Damaged d = whole(mesh, truth);
  kind.apply(d, random);
  finish(d, random);
  return d;
}

std::vector<int> map_of_whole(const Damaged& d, const std::vector<int>& partner) {
  std::vector<int> out(d.truth.size(), -1);
  for (int v = d.mesh.vertices() - 1; v >= 0; --v)
    if (d.origin[v] >= 0) out[d.origin[v]] = partner[v] < 0 ? -1 : d.nearest[partner[v]];
  return out;
}

Truth truth_of_whole(const Damaged& d) {
  std::vector<char> there(d.truth.size(), 0);
  for (int v = 0; v < d.mesh.vertices(); ++v)
    if (d.origin[v] >= 0 && d.partner[v] >= 0) there[d.origin[v]] = 1;
  Truth out;
  for (int v = 0; v < static_cast<int>(there.size()); ++v)
    if (there[v]) out.push_back({v, d.truth[v]});
  return out;
}

double coverage(const Damaged& d, const std::vector<int>& partner) {
  double covered = 0, all = 0;
  for (int v = 0; v < d.mesh.vertices(); ++v)
    if (d.partner[v] >= 0) ++all, covered += partner[v] >= 0;
  return covered / all;
}

}  // namespace ga_symmetry::damage
