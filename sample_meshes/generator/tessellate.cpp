// SPDX-License-Identifier: GPL-3.0-or-later
#include "tessellate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>

#include "remesh.h"

namespace samples {
namespace {

// Where a mesh is made: lattice coordinates below 0 are cut off along the first `cut_axes` axes.
struct Domain {
  Eigen::Matrix3d axes;  // columns, unit length
  int cut_axes = 0;
  Vec3 origin = Vec3::Zero();
  std::vector<Vec3> seam;  // inward normals of the cut planes, which pass through 0
};

Domain piece_domain(const Shape& shape) {
  Domain d;
  d.axes = shape.lattice;
  d.cut_axes = shape.half_space ? 1 : 2;
  if (shape.half_space)
    d.seam = {shape.lattice.col(0)};
  else
    d.seam = {shape.lattice.col(2).cross(shape.lattice.col(0)), shape.lattice.col(1).cross(shape.lattice.col(2))};
  return d;
}

// Marching tetrahedra on a lattice of cells with edges `step`. Six tetrahedra a cell share its diagonal, so the faces
// of neighbouring cells match, and so do the two cut faces of a piece.
Mesh polygonize(const Field& field, const Domain& domain, double step) {
  const Eigen::Matrix3d axes = step * domain.axes, inverse = axes.inverse();
  const Eigen::AlignedBox3d box = field.box();
  Eigen::AlignedBox3d range;
  for (int corner = 0; corner < 8; ++corner)
    range.extend(Vec3(inverse * (box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - domain.origin)));
  std::array<std::int64_t, 3> low, size;
  for (int k = 0; k < 3; ++k) {
    low[k] = k < domain.cut_axes ? 0 : static_cast<std::int64_t>(std::floor(range.min()[k])) - 1;
    size[k] = static_cast<std::int64_t>(std::ceil(range.max()[k])) + 2 - low[k];
  }
  const auto id = [&](std::int64_t a, std::int64_t b, std::int64_t c) { return (c * size[1] + b) * size[0] + a; };
  const auto place = [&](std::int64_t i) -> Vec3 {
    const std::int64_t row = i / size[0], layer = row / size[1];
    const Eigen::Matrix<std::int64_t, 3, 1> steps(low[0] + i % size[0], low[1] + row % size[1], low[2] + layer);
    return domain.origin + axes * steps.cast<double>();
  };
  std::vector<double> value(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = field.value(place(static_cast<std::int64_t>(i)));

  Mesh mesh;
  std::unordered_map<std::int64_t, int> on_edge;
  const auto crossing = [&](std::int64_t i, std::int64_t j) {
    if (i > j) std::swap(i, j);
    const auto [at, fresh] = on_edge.try_emplace(i * static_cast<std::int64_t>(value.size()) + j, mesh.points());
    if (fresh) {
      const double t = value[i] / (value[i] - value[j]);
      mesh.point.push_back((1 - t) * place(i) + t * place(j));
    }
    return at->second;
  };
  const auto add = [&](int a, int b, int c, const Vec3& outward) {
    const Vec3 normal = (mesh.point[b] - mesh.point[a]).cross(mesh.point[c] - mesh.point[a]);
    if (normal.dot(outward) > 0)
      mesh.face.push_back({a, b, c});
    else
      mesh.face.push_back({a, c, b});
  };
  constexpr int kPaths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};  // corner bits between 0 and 7
  for (std::int64_t c = 0; c + 1 < size[2]; ++c)
    for (std::int64_t b = 0; b + 1 < size[1]; ++b)
      for (std::int64_t a = 0; a + 1 < size[0]; ++a)
        for (const auto& path : kPaths) {
          std::vector<std::int64_t> in, out;
          for (int bits : {0, path[0], path[1], 7}) {
            const std::int64_t i = id(a + (bits & 1), b + (bits >> 1 & 1), c + (bits >> 2 & 1));
            (value[i] < 0 ? in : out).push_back(i);
          }
          if (in.empty() || out.empty()) continue;
          Vec3 outward = Vec3::Zero();
          for (std::int64_t i : out) outward += place(i) / static_cast<double>(out.size());
          for (std::int64_t i : in) outward -= place(i) / static_cast<double>(in.size());
          if (in.size() == 2) {
            const int p = crossing(in[0], out[0]), q = crossing(in[0], out[1]);
            const int r = crossing(in[1], out[1]), s = crossing(in[1], out[0]);
            add(p, q, r, outward);
            add(p, r, s, outward);
          } else {
            const auto& one = in.size() == 1 ? in : out;
            const auto& three = in.size() == 1 ? out : in;
            add(crossing(one[0], three[0]), crossing(one[0], three[1]), crossing(one[0], three[2]), outward);
          }
        }
  return mesh;
}

// Newton steps onto the surface within the seam planes that hold the point.
Vec3 onto_surface(const Field& field, Vec3 p, const std::vector<Vec3>& planes) {
  const auto within = [&](const Vec3& x) -> Vec3 {
    if (planes.size() == 2) return {0, 0, x.z()};  // two seams meet in the z axis
    return planes.empty() ? x : x - planes[0] * planes[0].dot(x);
  };
  p = within(p);
  for (int i = 0; i < 4; ++i) {
    const double value = field.value(p);
    if (std::abs(value) < 1e-9) break;
    const Vec3 g = within(field.gradient(p));
    if (g.squaredNorm() < 1e-6) break;  // a saddle of the field: stay
    p = within(p - g * (value / g.squaredNorm()));
  }
  return p;
}

struct Border {
  std::vector<std::array<int, 2>> neighbours;  // per vertex, -1 inside
  std::vector<std::vector<Vec3>> planes;       // seam planes that hold the vertex
};

Border find_border(const Mesh& mesh, const std::vector<Vec3>& seam, double edge) {
  std::map<std::pair<int, int>, int> faces;
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) ++faces[std::minmax(f[k], f[(k + 1) % 3])];
  Border border;
  border.neighbours.assign(mesh.point.size(), {-1, -1});
  border.planes.resize(mesh.point.size());
  for (const auto& [ends, count] : faces)
    if (count == 1)
      for (auto [v, w] : {ends, std::pair(ends.second, ends.first)}) {
        auto& n = border.neighbours[v];
        require(n[1] < 0, "the seam of a piece is a simple curve");
        n[n[0] >= 0] = w;
      }
  for (int v = 0; v < mesh.points(); ++v) {
    if (border.neighbours[v][0] < 0) continue;
    require(!seam.empty(), "a whole mesh is closed");
    const auto nearest = std::min_element(seam.begin(), seam.end(), [&](const Vec3& a, const Vec3& b) {
      return std::abs(a.dot(mesh.point[v])) < std::abs(b.dot(mesh.point[v]));
    });
    require(std::abs(nearest->dot(mesh.point[v])) < 0.2 * edge, "the border of a piece lies on its seams");
    border.planes[v] = {*nearest};
    if (seam.size() == 2 && mesh.point[v].head<2>().norm() < 1e-6) border.planes[v] = seam;
  }
  return border;
}

// Evens out the triangles: every vertex moves along the surface towards the mean of its neighbours; seam vertices move
// along the seam.
void relax(Mesh& mesh, const Field& field, const std::vector<Vec3>& seam, double edge, int rounds, bool move_seam) {
  const Border border = find_border(mesh, seam, edge);
  std::vector<std::vector<int>> around(mesh.point.size());
  for (const Face& f : mesh.face)
    for (int k = 0; k < 3; ++k) around[f[k]].insert(around[f[k]].end(), {f[(k + 1) % 3], f[(k + 2) % 3]});
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> next = mesh.point;
    for (int v = 0; v < mesh.points(); ++v) {
      const auto& planes = border.planes[v];
      if (planes.size() == 2 || (planes.size() == 1 && !move_seam)) {
        if (move_seam) next[v] = onto_surface(field, mesh.point[v], planes);
        continue;
      }
      Vec3 mean = Vec3::Zero();
      if (planes.empty()) {
        for (int w : around[v]) mean += mesh.point[w] / static_cast<double>(around[v].size());
      } else {
        for (int w : border.neighbours[v]) mean += mesh.point[w] / 2;
      }
      const Vec3 normal = field.gradient(mesh.point[v]).normalized();
      const Vec3 step = 0.5 * (mean - mesh.point[v]);
      next[v] = onto_surface(field, mesh.point[v] + step - normal * normal.dot(step), planes);
    }
    mesh.point = std::move(next);
  }
}

// Splits the inner edges whose two ends are on the border: the mirror image would have the same edge.
void split_chords(Mesh& mesh) {
  for (bool again = true; again;) {
    again = false;
    std::map<std::pair<int, int>, std::vector<int>> faces;
    for (std::size_t f = 0; f < mesh.face.size(); ++f)
      for (int k = 0; k < 3; ++k)
        faces[std::minmax(mesh.face[f][k], mesh.face[f][(k + 1) % 3])].push_back(static_cast<int>(f));
    std::vector<bool> border(mesh.point.size()), split(mesh.face.size());
    for (const auto& [ends, sides] : faces)
      if (sides.size() == 1) border[ends.first] = border[ends.second] = true;
    for (const auto& [ends, sides] : faces) {
      if (sides.size() != 2 || !border[ends.first] || !border[ends.second]) continue;
      again = true;
      if (split[sides[0]] || split[sides[1]]) continue;  // in the next round
      const int middle = mesh.points();
      mesh.point.push_back((mesh.point[ends.first] + mesh.point[ends.second]) / 2);
      for (int f : sides) {
        split[f] = true;
        Face rest = mesh.face[f];
        std::replace(mesh.face[f].begin(), mesh.face[f].end(), ends.first, middle);
        std::replace(rest.begin(), rest.end(), ends.second, middle);
        mesh.face.push_back(rest);
      }
    }
  }
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Face& f : mesh.face)
    sum += (mesh.point[f[1]] - mesh.point[f[0]]).cross(mesh.point[f[2]] - mesh.point[f[0]]).norm() / 2;
  return sum;
}

// Edge length at which equilateral triangles would give the wanted number of vertices. Real ones are less regular and
// a little smaller: the factor is the vertex count that the remesher makes, over the one wanted.
double edge_length(const Shape& shape, const Domain& domain, double share_of_shape) {
  const double step = shape.field.box().diagonal().norm() / 70;
  constexpr double kRemesherExcess = 0.94;
  return std::sqrt(area(polygonize(shape.field, domain, step)) / share_of_shape * kRemesherExcess /
                   (std::sqrt(0.75) * shape.vertices));
}

double seam_spacing(const Mesh& mesh, const std::vector<Vec3>& seam, double edge) {
  const Border border = find_border(mesh, seam, edge);
  double sum = 0, count = 0;
  for (int v = 0; v < mesh.points(); ++v)
    for (int w : border.neighbours[v])
      if (w >= 0) sum += (mesh.point[v] - mesh.point[w]).norm(), ++count;
  return sum / count;
}

constexpr int kRemeshRounds = 12, kRelaxRounds = 6;

}  // namespace

Mesh fundamental_piece(const Shape& shape) {
  const Domain domain = piece_domain(shape);
  double edge = edge_length(shape, domain, 1.0 / static_cast<double>(shape.group.size()));
  // Cells finer than the wanted triangles keep small features. Where the seams must stay as they are, cells so large
  // that the seam has the wanted spacing from the start.
  const double step = shape.seam_is_mirror ? 0.7 * edge : 2.2 * edge;
  Mesh mesh = polygonize(shape.field, domain, step);
  relax(mesh, shape.field, domain.seam, step, shape.seam_is_mirror ? 5 : 40, true);
  if (!shape.seam_is_mirror) edge = seam_spacing(mesh, domain.seam, step);
  mesh = isotropic_remesh(mesh, edge, kRemeshRounds);
  split_chords(mesh);
  relax(mesh, shape.field, domain.seam, edge, kRelaxRounds, shape.seam_is_mirror);
  if (shape.low_poly > 0) {
    edge *= std::sqrt(static_cast<double>(shape.vertices) / shape.low_poly);
    mesh = decimated(mesh, shape.low_poly / static_cast<int>(shape.group.size()));
    split_chords(mesh);
  }

  const Border border = find_border(mesh, domain.seam, edge);
  for (int v = 0; v < mesh.points(); ++v)
    if (!border.planes[v].empty()) mesh.point[v] = onto_surface(shape.field, mesh.point[v], border.planes[v]);
  if (shape.seam_is_mirror) return mesh;
  // The second seam is the image of the first, to the last bit.
  for (int v = 0; v < mesh.points(); ++v) {
    if (border.planes[v].size() != 1 || border.planes[v][0] != domain.seam[1]) continue;
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 image = Vec3::Zero();
    for (int w = 0; w < mesh.points(); ++w) {
      if (border.planes[w].size() != 1 || border.planes[w][0] != domain.seam[0]) continue;
      const Vec3 candidate = shape.group[shape.generator] * mesh.point[w];
      const double d = (candidate - mesh.point[v]).norm();
      if (d < nearest) nearest = d, image = candidate;
    }
    require(nearest < 0.01 * edge, "the second seam is the image of the first");
    mesh.point[v] = image;
  }
  return mesh;
}

Mesh whole(const Shape& shape) {
  Domain domain;
  domain.axes = Eigen::Matrix3d::Identity();
  const double edge = edge_length(shape, domain, 1);
  domain.origin = edge * Vec3(0.271, 0.414, 0.137);  // off every symmetry plane
  Mesh mesh = polygonize(shape.field, domain, 0.7 * edge);
  relax(mesh, shape.field, {}, edge, 5, true);
  mesh = isotropic_remesh(mesh, edge, kRemeshRounds);
  relax(mesh, shape.field, {}, edge, kRelaxRounds, true);
  return mesh;
}

}  // namespace samples
