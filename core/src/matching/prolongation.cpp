// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/prolongation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <numeric>

#include "ga_symmetry/errors.h"
#include "matching/local_motion.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

std::vector<LocalMotion> local_motions(const Surface& s, const std::vector<SurfacePoint>& point, bool reflection,
                                       int threads) {
  const int n = s.vertices();
  std::vector<Vector> image(n);
  for (int v = 0; v < n; ++v) image[v] = position(s, point[v]);
  std::vector<LocalMotion> out(n);
  parallel_for(n, threads, [&](int v, int) { out[v] = local_motion(s, image, v, reflection); });
  return out;
}

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// The places of one part, to be found by position.
class Finder {
 public:
  Finder(const Surface& mesh, std::vector<int> places)
      : place_(std::move(places)), points_(static_cast<Eigen::Index>(place_.size()), 3) {
    for (std::size_t i = 0; i < place_.size(); ++i)
      points_.row(static_cast<Eigen::Index>(i)) = Vector(mesh.point(place_[i])).transpose();
    tree_ = std::make_unique<Tree>(3, std::cref(points_));
  }
  /// The nearest place; of those about as near, within `slack`, the one whose normal agrees best.
  int nearest(const Vector& p, const Vector& normal, const std::vector<Vector>& normals, double slack,
              double& distance) const {
    constexpr int kNear = 8;
    std::array<Eigen::Index, kNear> near{};
    std::array<double, kNear> squared{};
    const auto found = tree_->index->knnSearch(p.data(), kNear, near.data(), squared.data());
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < found; ++i) {
      const int place = place_[near[i]];
      const double cost = std::sqrt(squared[i]) + slack * 0.5 * (1 - normal.dot(normals[place]));
      if (cost < least) least = cost, best = place, distance = std::sqrt(squared[i]);
    }
    return best;
  }

 private:
  using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Points, 3>;
  std::vector<int> place_;
  Points points_;
  std::unique_ptr<Tree> tree_;
};

// Values per vertex of the searched surface, at the vertices of the mesh.
template <class Value>
std::vector<Value> interpolated(const std::vector<SurfacePoint>& place, const std::vector<Value>& values) {
  std::vector<Value> out;
  out.reserve(place.size());
  for (const SurfacePoint& p : place) {
    Value sum = 0;
    for (int k = 0; k < 3; ++k) sum += static_cast<Value>(p.weight[k]) * values[p.vertex[k]];
    out.push_back(sum);
  }
  return out;
}

double mean_edge(const Surface& s) { return std::sqrt(2 * s.area / s.triangles()); }

template <class Body>
void for_each_vertex(int n, int threads, const Context& context, const Body& body) {
  constexpr int kBlock = 1024;
  parallel_blocks(n, kBlock, threads, [&](int begin, int end, int) {
    if (context.cancelled()) throw Cancelled();
    for (int v = begin; v < end; ++v) body(v);
  });
}

// Moves images to where the mirror takes their vertices, wherever the searched surface is there, and the map agrees or
// nearly all of the surface is there: then the map is wrong where it does not.
// @return per vertex of the mesh whether it was done
std::vector<char> mirror_images(const MirrorPlane& mirror, const Surface& searched, const Surface& mesh,
                                const std::vector<Vector>& normal, int threads, const Context& context,
                                std::vector<Vector>& image, std::vector<Vector>& image_normal) {
  constexpr double kAgree = 0.15, kThere = 0.8;  // units; edges
  constexpr double kWhole = 0.95;                // of the area
  const Eigen::Map<const Points> vertices(searched.position.data(), searched.vertices(), 3);
  const nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Map<const Points>, 3> tree(3, std::cref(vertices));
  const auto off = [&](const Vector& p) {
    Eigen::Index nearest;
    double squared;
    tree.query(p.data(), 1, &nearest, &squared);
    return std::sqrt(squared);
  };
  const double near = kThere * mean_edge(searched);
  std::vector<char> done(mesh.vertices());
  for_each_vertex(mesh.vertices(), threads, context, [&](int v) {
    const Vector here(mesh.point(v));
    done[v] = off(mirror.mirror(here)) <= off(here) + near;
  });
  double there = 0;
  for (int v = 0; v < mesh.vertices(); ++v)
    if (done[v]) there += mesh.vertex_area[v];
  const double agree = there >= kWhole * mesh.area ? INFINITY : kAgree * searched.unit();
  for_each_vertex(mesh.vertices(), threads, context, [&](int v) {
    const Vector mirrored = mirror.mirror(Vector(mesh.point(v)));
    done[v] = done[v] && (mirrored - image[v]).norm() <= agree;
    if (!done[v]) return;
    image[v] = mirrored;
    image_normal[v] = normal[v] - 2 * mirror.normal.dot(normal[v]) * mirror.normal;
  });
  return done;
}

}  // namespace

void mirror_exactly(SurfaceResult& found, const Surface& s, int threads, const Context& context) {
  const std::vector<Vector> normal = unit_normals(s);
  std::vector<Vector> image(s.vertices()), image_normal = normal;
  for (int v = 0; v < s.vertices(); ++v) image[v] = position(s, found.point[v]);
  const std::vector<char> mirrored = mirror_images(*found.mirror, s, s, normal, threads, context, image, image_normal);
  std::vector<int> all(s.vertices());
  std::iota(all.begin(), all.end(), 0);
  const Finder finder(s, std::move(all));
  for_each_vertex(s.vertices(), threads, context, [&](int v) {
    if (!mirrored[v]) return;
    double off;
    found.partner[v] = finder.nearest(image[v], image_normal[v], normal, mean_edge(s), off);
    found.point[v] = nearest_around(s, found.partner[v], image[v]);
  });
  for (SymmetricPair& pair : found.pairs) pair.partner = found.partner[pair.vertex];
}

SurfaceResult prolongate(SurfaceResult found, const SearchSurface& search, bool reflection, int threads,
                         const Context& context) {
  const Surface &s = search.searched(), &mesh = search.of_mesh();
  const int n = mesh.vertices();
  const std::vector<LocalMotion> motion = local_motions(s, found.point, reflection, threads);
  const double edge = mean_edge(s);

  const std::vector<Vector> normal = unit_normals(mesh);
  std::vector<Vector> image(n), image_normal(n);
  const auto for_each_place = [&](const auto& body) { for_each_vertex(n, threads, context, body); };
  for_each_place([&](int p) {
    constexpr double kTorn = 4;  // images of a face's corners so many edges apart have nothing between them
    const SurfacePoint& at = search.place()[p];
    const Vector here(mesh.point(p));
    Vector to[3];
    for (int k = 0; k < 3; ++k) to[k] = motion[at.vertex[k]](here);
    int main = static_cast<int>(std::max_element(at.weight.begin(), at.weight.end()) - at.weight.begin());
    const double spread = std::max({(to[0] - to[1]).norm(), (to[1] - to[2]).norm(), (to[2] - to[0]).norm()});
    image[p] = to[main];
    if (spread <= kTorn * edge) image[p] = at.weight[0] * to[0] + at.weight[1] * to[1] + at.weight[2] * to[2];
    image_normal[p] = motion[at.vertex[main]].turn * normal[p];
  });

  if (found.mirror) mirror_images(*found.mirror, s, mesh, normal, threads, context, image, image_normal);

  // Which part is whose counterpart: where its places come to, as a share of both.
  std::vector<std::vector<int>> places(search.parts());
  std::vector<int> used;
  for (int p = 0; p < n; ++p)
    if (search.part()[p] >= 0) places[search.part()[p]].push_back(p), used.push_back(p);
  const Finder all(mesh, used);
  std::vector<int> partner(n, -1);
  std::vector<double> off(n, 0.0);
  for_each_place([&](int p) { partner[p] = all.nearest(image[p], image_normal[p], normal, edge, off[p]); });
  if (search.parts() > 1) {
    std::vector<std::unique_ptr<Finder>> finder(search.parts());
    const auto find = [&](int part) -> const Finder& {
      if (!finder[part]) finder[part] = std::make_unique<Finder>(mesh, places[part]);
      return *finder[part];
    };
    std::vector<int> counterpart(search.parts(), -1);
    std::vector<double> votes(search.parts(), 0.0);
    for (int a = 0; a < search.parts(); ++a) {
      // Candidates are the parts that are met, and those whose size is alike near by.
      std::vector<int> met;
      for (int p : places[a]) {
        const int b = search.part()[partner[p]];
        if (votes[b] == 0) met.push_back(b);
        ++votes[b];
      }
      double best = 0;
      for (int b : met) {
        const double size = static_cast<double>(places[b].size()), own = static_cast<double>(places[a].size());
        const double score = votes[b] / own * std::sqrt(std::min(size, own) / std::max(size, own));
        if (score > best) best = score, counterpart[a] = b;
        votes[b] = 0;
      }
    }
    // Both ways: a part that has no other claim takes the one that claims it.
    for (int a = 0; a < search.parts(); ++a)
      if (counterpart[a] >= 0) find(counterpart[a]);
    for_each_place([&](int p) {
      if (search.part()[p] < 0 || counterpart[search.part()[p]] < 0) return;
      const int wanted = counterpart[search.part()[p]];
      if (search.part()[partner[p]] == wanted) return;
      constexpr double kReach = 3;  // edges beyond the nearest place of all parts
      double d;
      const int q = finder[wanted]->nearest(image[p], image_normal[p], normal, edge, d);
      if (q >= 0 && d <= off[p] + kReach * edge) partner[p] = q, off[p] = d;
    });
  }

  found.partner = partner;
  found.point.assign(n, {});
  for_each_place([&](int p) {
    const int q = partner[p];
    if (q >= 0) found.point[p] = nearest_around(mesh, q, image[p]);
  });
  found.fitness = interpolated(search.place(), found.fitness);
  if (!found.left_right.empty()) found.left_right = interpolated(search.place(), found.left_right);
  // The samples, by the vertex of the mesh that stands nearest to each.
  std::vector<int> near(s.vertices(), -1);
  std::vector<double> least(s.vertices(), std::numeric_limits<double>::infinity());
  for (int p = 0; p < n; ++p)
    for (const int v : search.place()[p].vertex)
      if (const double d = (Vector(mesh.point(p)) - Vector(s.point(v))).squaredNorm(); d < least[v])
        least[v] = d, near[v] = p;
  std::vector<SymmetricPair> pairs;
  for (const SymmetricPair& pair : found.pairs)
    if (const int v = near[pair.vertex]; v >= 0 && partner[v] >= 0) pairs.push_back({v, partner[v], pair.fitness});
  found.pairs = std::move(pairs);
  return found;
}

}  // namespace ga_symmetry
