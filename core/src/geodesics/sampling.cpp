// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void check_count(const Surface& surface, int count) {
  if (count < 1 || count > surface.vertices())
    throw InvalidOption("the number of samples must be in [1," + std::to_string(surface.vertices()) +
                        "], the vertices of the surface, got " + std::to_string(count));
}

template <class Values>
int index_of_largest(const Values& values) {
  return static_cast<int>(std::max_element(values.begin(), values.end()) - values.begin());
}

// An end of a long geodesic: goes from the vertex of the largest area to the farthest vertex, again and again, while
// that grows. Depends on nothing but the surface.
int start_vertex(const Surface& surface, const GeodesicSolver& solver) {
  std::vector<float> field(surface.vertices());
  const auto workspace = solver.make_workspace();
  int vertex = index_of_largest(surface.vertex_area);
  for (float longest = 0;;) {
    solver.field(vertex, field.data(), *workspace);
    const int next = index_of_largest(field);
    if (!(field[next] > longest)) return vertex;
    longest = field[next];
    vertex = next;
  }
}

// Distance to the nearest of a growing set of samples. A new one visits only what it may be the nearest to, if every
// vertex that matters is no farther from the samples than it is itself.
class NearestSample {
 public:
  NearestSample(const Surface& surface, const GeodesicSolver& solver)
      : solver_(solver),
        workspace_(solver.make_workspace()),
        nearest_(surface.vertices(), kInfinity),
        near_(nearest_) {}
  void add(int v) {
    solver_.field_within(v, nearest_[v], near_.data(), reached_, *workspace_);
    for (const int w : reached_) nearest_[w] = std::min(nearest_[w], near_[w]);
  }
  float distance(int v) const { return nearest_[v]; }

 private:
  const GeodesicSolver& solver_;
  GeodesicSolver::WorkspacePointer workspace_;
  std::vector<float> nearest_, near_;
  std::vector<int> reached_;
};

}  // namespace

std::vector<int> farthest_points(const Surface& surface, const GeodesicSolver& solver, const std::vector<int>& allowed,
                                 int count, const Context& context) {
  if (allowed.empty()) return {};
  const auto largest = [&](const auto& values) {
    return *std::max_element(allowed.begin(), allowed.end(), [&](int a, int b) { return values[a] < values[b]; });
  };
  std::vector<float> field(surface.vertices());
  solver.field(largest(surface.vertex_area), field.data(), *solver.make_workspace());
  NearestSample nearest(surface, solver);
  return farthest_points(
      allowed, largest(field), count, [&](int v) { return nearest.distance(v); },
      [&](int v) {
        if (context.cancelled()) throw Cancelled();
        nearest.add(v);
      });
}

Landmarks evenly_spaced_samples(const Surface& surface, const GeodesicSolver& solver, int count, int threads,
                                const Context& context) {
  check_count(surface, count);
  std::vector<int> all(surface.vertices());
  std::iota(all.begin(), all.end(), 0);
  const int first = start_vertex(surface, solver);
  // Choosing is serial, as each sample depends on those before it, so no more of each field is computed than it needs.
  // The whole fields come afterwards, on all threads.
  const Context choice = context.part(0, 0.3);
  NearestSample nearest(surface, solver);
  int chosen = 0;
  Landmarks out;
  out.vertex = farthest_points(
      all, first, count, [&](int v) { return nearest.distance(v); },
      [&](int v) {
        choice.advance(static_cast<double>(++chosen) / count);
        nearest.add(v);
      });
  out.field = solver.fields(out.vertex, threads, context.part(0.3, 1));
  return out;
}

std::vector<int> uniform_sample_vertices(const Surface& surface, int count, Random& random) {
  check_count(surface, count);
  std::vector<std::pair<double, int>> key;
  for (int v = 0; v < surface.vertices(); ++v)
    key.emplace_back(-std::log1p(-draw_unit(random)) / surface.vertex_area[v], v);
  std::partial_sort(key.begin(), key.begin() + count, key.end());
  std::vector<int> out;
  for (int i = 0; i < count; ++i) out.push_back(key[i].second);
  return out;
}

Eigen::MatrixXf symmetric_distances(const Landmarks& samples) {
  const int k = static_cast<int>(samples.vertex.size());
  Eigen::MatrixXf out(k, k);
  for (int i = 0; i < k; ++i)
    for (int j = 0; j <= i; ++j)
      out(i, j) = out(j, i) = 0.5f * (samples.field(i, samples.vertex[j]) + samples.field(j, samples.vertex[i]));
  return out;
}

std::vector<int> nearest_source(const DistanceFields& fields) {
  std::vector<int> out(fields.cols(), 0);
  for (int i = 1; i < fields.rows(); ++i)
    for (int v = 0; v < fields.cols(); ++v)
      if (fields(i, v) < fields(out[v], v)) out[v] = i;
  return out;
}

}  // namespace ga_symmetry
