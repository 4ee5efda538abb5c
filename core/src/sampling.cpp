#include "ga_symmetry/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/parallel.h"

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

// Guesses beyond so many are rarely right.
constexpr int kMostGuesses = 7;

// Fields computed before they are asked for, so that several threads have work though each sample depends on the one
// before. A guess that is not asked for costs time; it never changes the samples.
class FieldsAhead {
 public:
  FieldsAhead(const Surface& surface, const GeodesicSolver& solver, int threads)
      : surface_(surface), solver_(solver), workspace_(std::min(thread_count(threads), 1 + kMostGuesses)) {}

  GeodesicSolver::Workspace& workspace(int worker) {
    if (!workspace_[worker]) workspace_[worker] = solver_.make_workspace();
    return *workspace_[worker];
  }

  // Writes the field of the next sample. `nearest`: distance of each vertex to the `samples` so far; `more`: samples
  // still to come after this one.
  void take(int vertex, const std::vector<float>& nearest, const Samples& samples, int more, float* field) {
    auto at = find(vertex);
    if (at == ahead_.end()) {
      compute(vertex, nearest, samples, std::min<int>(more, static_cast<int>(workspace_.size()) - 1));
      at = find(vertex);
    }
    std::copy(at->distance.begin(), at->distance.end(), field);
    ahead_.erase(at);
  }

 private:
  struct Field {
    int vertex;
    std::vector<float> distance;
  };

  std::vector<Field>::iterator find(int vertex) {
    return std::find_if(ahead_.begin(), ahead_.end(), [&](const Field& f) { return f.vertex == vertex; });
  }

  void compute(int vertex, const std::vector<float>& nearest, const Samples& samples, int guesses) {
    ahead_.push_back({vertex, {}});
    if (guesses > 0) guess(nearest, samples, guesses);
    const int first = static_cast<int>(find(vertex) - ahead_.begin());
    parallel_for(static_cast<int>(ahead_.size()) - first, static_cast<int>(workspace_.size()), [&](int i, int worker) {
      Field& f = ahead_[first + i];
      f.distance.resize(surface_.vertices());
      solver_.field(f.vertex, f.distance.data(), workspace(worker));
    });
  }

  // Adds up to `count` vertices that are farthest in their surroundings and stay so when the samples ahead are taken.
  // Forgets guesses that are not farthest any more.
  void guess(const std::vector<float>& nearest, const Samples& samples, int count) {
    std::vector<int> peaks;
    for (int v = 0; v < surface_.vertices(); ++v) {
      bool peak = nearest[v] > 0;
      for (int i = surface_.first_corner[v]; peak && i < surface_.first_corner[v + 1]; ++i) {
        const int c = surface_.corner_at[i];
        peak = nearest[surface_.triangle[next_corner(c)]] <= nearest[v] &&
               nearest[surface_.triangle[previous_corner(c)]] <= nearest[v];
      }
      if (peak) peaks.push_back(v);
    }
    const auto is_peak = [&](int v) { return std::binary_search(peaks.begin(), peaks.end(), v); };
    ahead_.erase(std::remove_if(ahead_.begin(), ahead_.end(), [&](const Field& f) { return !is_peak(f.vertex); }),
                 ahead_.end());
    std::sort(peaks.begin(), peaks.end(), [&](int a, int b) { return nearest[a] > nearest[b]; });
    for (const int v : peaks) {
      if (count == 0) return;
      const bool stays = std::all_of(ahead_.begin(), ahead_.end(), [&](const Field& f) {
        return f.vertex != v && (f.distance.empty() ? at_least(f.vertex, v, samples) : f.distance[v]) >= nearest[v];
      });
      if (!stays) continue;
      ahead_.push_back({v, {}});
      --count;
    }
  }

  // Lower bound of a distance, by the triangle inequality.
  static float at_least(int a, int b, const Samples& samples) {
    float bound = 0;
    for (std::size_t i = 0; i < samples.vertex.size(); ++i)
      bound = std::max(bound, std::abs(samples.distance(i, a) - samples.distance(i, b)));
    return bound;
  }

  const Surface& surface_;
  const GeodesicSolver& solver_;
  std::vector<GeodesicSolver::WorkspacePointer> workspace_;
  std::vector<Field> ahead_;
};

}  // namespace

Samples evenly_spaced_samples(const Surface& surface, const GeodesicSolver& solver, int count, int threads,
                              const Context& context) {
  check_count(surface, count);
  const int n = surface.vertices();
  Samples out;
  out.distance.resize(count, n);
  std::vector<float> nearest(n, std::numeric_limits<float>::infinity());
  FieldsAhead ahead(surface, solver, threads);
  for (int i = 0; i < count; ++i) {
    if (context.cancelled()) throw Cancelled();
    float* const field = out.distance.row(i).data();
    int vertex;
    if (i == 0) {
      vertex = start_vertex(surface, solver, field, ahead.workspace(0));
    } else {
      vertex = index_of_largest(nearest);
      ahead.take(vertex, nearest, out, count - 1 - i, field);
    }
    out.vertex.push_back(vertex);
    for (int v = 0; v < n; ++v) nearest[v] = std::min(nearest[v], field[v]);
  }
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
