#include "geodesics/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {
namespace {

void check_count(const Surface& surface, int count) {
  if (count < 1 || count > surface.vertices())
    throw InvalidOption("the number of samples must be in [1," + std::to_string(surface.vertices()) +
                        "], the vertices of the surface, got " + std::to_string(count));
}

template <class Values>
int index_of_largest(const Values& values) {
  return static_cast<int>(std::max_element(values.begin(), values.end()) - values.begin());
}

// An end of a long geodesic, with its field: goes from the vertex of the largest area to the farthest vertex, again and
// again, while that grows. Depends on nothing but the surface.
int start_vertex(const Surface& surface, const GeodesicSolver& solver, float* field,
                 GeodesicSolver::Workspace& workspace) {
  int vertex = index_of_largest(surface.vertex_area);
  for (float longest = 0;;) {
    solver.field(vertex, field, workspace);
    const int next = static_cast<int>(std::max_element(field, field + surface.vertices()) - field);
    if (!(field[next] > longest)) return vertex;
    longest = field[next];
    vertex = next;
  }
}

}  // namespace

Samples evenly_spaced_samples(const Surface& surface, const GeodesicSolver& solver, int count, int threads,
                              const Context& context) {
  check_count(surface, count);
  const int n = surface.vertices();
  Samples out;
  std::vector<float> nearest(n), near(n, std::numeric_limits<float>::infinity());
  std::vector<int> reached;
  const auto workspace = solver.make_workspace();
  int vertex = start_vertex(surface, solver, nearest.data(), *workspace);
  // Each depends on the one before, but only as far as it is the nearest to anything: the whole fields come afterwards,
  // side by side.
  const Context choice = context.part(0, 0.3);
  while (out.vertex.push_back(vertex), static_cast<int>(out.vertex.size()) < count) {
    choice.advance(static_cast<double>(out.vertex.size()) / count);
    vertex = index_of_largest(nearest);
    solver.field_within(vertex, nearest[vertex], near.data(), reached, *workspace);
    for (int v : reached) nearest[v] = std::min(nearest[v], near[v]);
  }
  out.distance = solver.fields(out.vertex, threads, context.part(0.3, 1));
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

Samples uniform_samples(const Surface& surface, const GeodesicSolver& solver, int count, Random& random, int threads,
                        const Context& context) {
  Samples out;
  out.vertex = uniform_sample_vertices(surface, count, random);
  out.distance = solver.fields(out.vertex, threads, context);
  return out;
}

Eigen::MatrixXf symmetric_distances(const Samples& samples) {
  const int k = static_cast<int>(samples.vertex.size());
  Eigen::MatrixXf out(k, k);
  for (int i = 0; i < k; ++i)
    for (int j = 0; j <= i; ++j)
      out(i, j) = out(j, i) = 0.5f * (samples.distance(i, samples.vertex[j]) + samples.distance(j, samples.vertex[i]));
  return out;
}

std::vector<int> sample_patches(const Samples& samples) {
  std::vector<int> out(samples.distance.cols(), 0);
  for (int i = 1; i < samples.distance.rows(); ++i)
    for (int v = 0; v < samples.distance.cols(); ++v)
      if (samples.distance(i, v) < samples.distance(out[v], v)) out[v] = i;
  return out;
}

}  // namespace ga_symmetry
