#include "surface/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {
namespace {

constexpr int kMinVertices = 20;
// Each step over the surface looks at all neighbours of a vertex: the time grows with the square of this.
constexpr int kMostFacesAround = 20000;
// A face is degenerate when its area is below rounding in float coordinates, relative to its longest edge squared.
constexpr double kZeroArea = 1e-9;

double squared(const double* a, const double* b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

double triangle_area(const double* a, const double* b, const double* c) {
  const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

std::string count_of(long n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

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

// Scale to the unit box before anything is squared, so that 1e-30 and 1e+30 neither vanish nor overflow.
std::vector<double> normalized(const TriangleMesh& mesh) {
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = INFINITY, high[k] = -INFINITY;
  for (int v : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const double x = mesh.position[3 * static_cast<std::size_t>(v) + k];
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
    }
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  if (!(size > 0) || !std::isfinite(size))
    throw InvalidMesh("the mesh has no extent that can be measured: check the scale of its coordinates");
  std::vector<double> out(mesh.position.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (mesh.position[i] - low[i % 3]) / size;
  return out;
}

void check_areas(const std::vector<double>& position, const std::vector<int>& triangle) {
  long zero = 0, first = -1;
  for (std::size_t f = 0; f < triangle.size() / 3; ++f) {
    const double* p[3];
    for (int k = 0; k < 3; ++k) p[k] = &position[3 * static_cast<std::size_t>(triangle[3 * f + k])];
    const double longest = std::max({squared(p[0], p[1]), squared(p[1], p[2]), squared(p[2], p[0])});
    if (triangle_area(p[0], p[1], p[2]) > kZeroArea * longest) continue;
    if (!zero++) first = static_cast<long>(f);
  }
  if (zero)
    throw InvalidMesh(count_of(zero, "face") + " with zero area (first: face " + std::to_string(first) +
                      "): merge close vertices and remove zero area faces, then close the holes");
}

void stop_at(std::size_t i, const Context& context) {
  if (i % 65536 == 0 && context.cancelled()) throw Cancelled();
}

// Fills Surface::opposite. @throws InvalidMesh on an edge with more than two faces
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
  long bad = 0;
  int bad_a = 0, bad_b = 0;
  for (std::size_t i = 0, j; i < edges.size(); i = j) {
    for (j = i + 1; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high;) ++j;
    if (j - i > 2) {
      if (!bad++) bad_a = s.mesh_vertex[edges[i].low], bad_b = s.mesh_vertex[edges[i].high];
    } else if (j - i == 2) {
      s.opposite[edges[i].corner] = edges[i + 1].corner;
      s.opposite[edges[i + 1].corner] = edges[i].corner;
    } else {
      s.closed = false;
    }
  }
  if (bad)
    throw InvalidMesh(count_of(bad, "edge") + " shared by more than two faces (first: vertices " +
                      std::to_string(bad_a) + " and " + std::to_string(bad_b) +
                      "): repair the non-manifold edges first");
}

// Component of each face, connected through vertices.
std::vector<int> face_components(const std::vector<int>& triangle, int n, int& count) {
  std::vector<int> root(n);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::size_t i = 0; i < triangle.size(); i += 3)
    for (int k = 1; k < 3; ++k) {
      const int a = find(triangle[i]), b = find(triangle[i + k]);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> label(n, -1), component(triangle.size() / 3);
  count = 0;
  for (std::size_t f = 0; f < component.size(); ++f) {
    int& mine = label[find(triangle[3 * f])];
    if (mine < 0) mine = count++;
    component[f] = mine;
  }
  return component;
}

// Keeps one component, or refuses several. Works on mesh indices.
std::vector<int> one_component(const std::vector<double>& position, std::vector<int> triangle, bool largest,
                               std::vector<std::string>& warnings) {
  int count = 0;
  const std::vector<int> component = face_components(triangle, static_cast<int>(position.size() / 3), count);
  if (count == 1) return triangle;
  if (!largest)
    throw InvalidMesh("the mesh has " + std::to_string(count) +
                      " components: merge close vertices if they only look joined, remove the small ones, or choose to "
                      "use the largest component");
  std::vector<double> area(count, 0.0);
  for (std::size_t f = 0; f < component.size(); ++f) {
    const double* p[3];
    for (int k = 0; k < 3; ++k) p[k] = &position[3 * static_cast<std::size_t>(triangle[3 * f + k])];
    area[component[f]] += triangle_area(p[0], p[1], p[2]);
  }
  const int keep = static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
  std::vector<int> out;
  for (std::size_t f = 0; f < component.size(); ++f)
    if (component[f] == keep) out.insert(out.end(), &triangle[3 * f], &triangle[3 * f] + 3);
  warnings.push_back("used the largest of " + std::to_string(count) + " components: " + std::to_string(out.size() / 3) +
                     " of " + std::to_string(component.size()) + " faces");
  return out;
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
    s.warnings.push_back("the surface has only one side (not orientable): orientation is not used");
    return;
  }
  if (std::find(flip.begin(), flip.end(), 1) == flip.end()) return;
  for (int f = 0; f < m; ++f)
    if (flip[f]) std::swap(s.triangle[3 * f + 1], s.triangle[3 * f + 2]);
  link_corners(s, context);
}

}  // namespace

double Surface::unit() const { return std::sqrt(area); }
double Surface::edge_length(int a, int b) const { return std::sqrt(squared(point(a), point(b))); }

Surface make_surface(const TriangleMesh& mesh, bool largest_component, const Context& context) {
  check_input(mesh);
  const std::vector<double> position = normalized(mesh);
  stop_at(0, context);
  check_areas(position, mesh.triangle);
  stop_at(0, context);
  Surface s;
  s.mesh_vertices = mesh.vertices();
  s.triangle = one_component(position, mesh.triangle, largest_component, s.warnings);
  stop_at(0, context);

  std::vector<int> index(mesh.vertices(), -1);
  for (int v : mesh.triangle) index[v] = 0;
  const long unused = std::count(index.begin(), index.end(), -1);
  if (unused) s.warnings.push_back("left out " + count_of(unused, "point") + " that no face uses");
  index.assign(mesh.vertices(), -1);
  for (int v : s.triangle) index[v] = 0;
  for (int v = 0; v < mesh.vertices(); ++v) {
    if (index[v] < 0) continue;
    index[v] = static_cast<int>(s.mesh_vertex.size());
    s.mesh_vertex.push_back(v);
    s.position.insert(s.position.end(), &position[3 * static_cast<std::size_t>(v)],
                      &position[3 * static_cast<std::size_t>(v)] + 3);
  }
  for (int& v : s.triangle) v = index[v];
  const int n = static_cast<int>(s.mesh_vertex.size());
  if (n < kMinVertices)
    throw InvalidMesh("the mesh has only " + std::to_string(n) + " connected vertices" + "; at least " +
                      std::to_string(kMinVertices) +
                      " are needed: merge close vertices, subdivide it or open a finer one");
  link_corners(s, context);
  orient_faces(s, context);
  stop_at(0, context);
  group_corners(s, n);
  for (int v = 0; v < n; ++v)
    if (const int faces = s.first_corner[v + 1] - s.first_corner[v]; faces > kMostFacesAround)
      throw InvalidMesh("vertex " + std::to_string(s.mesh_vertex[v]) + " has " + std::to_string(faces) +
                        " faces around it, more than " + std::to_string(kMostFacesAround) +
                        ": remesh the surface around it");
  s.vertex_area.assign(n, 0.0);
  for (int f = 0; f < s.triangles(); ++f) {
    const int* t = &s.triangle[3 * static_cast<std::size_t>(f)];
    const double a = triangle_area(s.point(t[0]), s.point(t[1]), s.point(t[2]));
    s.area += a;
    for (int k = 0; k < 3; ++k) s.vertex_area[t[k]] += a / 3;
  }
  return s;
}

}  // namespace ga_symmetry
