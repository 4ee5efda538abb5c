// SPDX-License-Identifier: GPL-3.0-or-later
#include "durations.h"

#include <time.h>

#include <algorithm>
#include <numeric>

#include "baselines/pair_search.h"
#include "ga_symmetry/errors.h"

namespace ga_symmetry::comparison {
namespace {

// Of the calling thread's processor time: other programs do not count.
class Stopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

void scan(const PairSamples& samples, PairError error, double optimum, std::uint64_t seed, std::vector<Duration>& out) {
  Random random(seed);
  std::vector<int> order(samples.right_distance.size());
  std::iota(order.begin(), order.end(), 0);
  const Stopwatch watch;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[draw_below(random, i)]);
  const double references = static_cast<double>(samples.left_distance.size());
  std::vector<double> best(samples.left_distance.size(), std::numeric_limits<double>::infinity());
  const double* quality = std::begin(kQualities);
  for (std::size_t k = 0; k < order.size() && quality != std::end(kQualities); ++k) {
    const AxisDistances& candidate = samples.right_distance[order[k]];
    double sum = 0;
    for (std::size_t i = 0; i < best.size(); ++i) {
      const double f = pair_fitness(samples.left_distance[i], candidate, error);
      if (f < best[i]) best[i] = f;
      sum += best[i];
    }
    for (; quality != std::end(kQualities) && sum / references <= optimum * (1 + *quality); ++quality)
      out.push_back(
          {"scan", *quality, true, watch.seconds(), references * static_cast<double>(k + 1), 0, sum / references});
  }
}

void genetic(const PairSamples& samples, PairsOptions options, double optimum, std::uint64_t seed,
             const Context& context, std::vector<Duration>& out) {
  options.max_generations = 1000;
  const Evolution run = watch_pairs(samples, options, optimum * (1 + *std::rbegin(kQualities)), seed, context);
  const double individuals = static_cast<double>(samples.left_distance.size()) * options.individuals;
  for (double quality : kQualities) {
    const auto at = std::find_if(run.log.begin(), run.log.end(),
                                 [&](const GenerationLog& g) { return g.best <= optimum * (1 + quality); });
    const bool reached = at != run.log.end();
    const std::size_t g = reached ? static_cast<std::size_t>(at - run.log.begin()) : run.log.size() - 1;
    out.push_back({"genetic", quality, reached, run.seconds[g], individuals * static_cast<double>(g + 1),
                   run.log[g].generation, run.log[g].best});
  }
}

}  // namespace

PairsScene make_pairs_scene(const TriangleMesh& mesh, const References& references, int count, int threads,
                            const Context& context) {
  const Surface surface = make_surface(mesh, true);
  std::vector<int> sources;
  for (int v : {references.axis.at(0), references.axis.at(1), references.pairs.at(0)[0], references.pairs.at(0)[1]}) {
    const auto at = std::lower_bound(surface.mesh_vertex.begin(), surface.mesh_vertex.end(), v);
    if (at == surface.mesh_vertex.end() || *at != v)
      throw InvalidOption("reference vertex " + std::to_string(v) + " is not on the surface: choose another");
    sources.push_back(static_cast<int>(at - surface.mesh_vertex.begin()));
  }
  const DistanceFields fields = GeodesicSolver(surface).fields(sources, threads, context);
  const std::vector<int> side = split_sides(surface, fields, {sources[0], sources[1]}, {sources[2], sources[3]});
  PairsOptions options;
  options.samples = count;
  Random unused;  // samples are evenly spaced
  PairsScene out{make_pair_samples(surface, fields, side, {sources[2], sources[3]}, options, unused, context), {}};
  for (int k : {0, 1}) out.reference_pair[k] = {fields(0, sources[2 + k]), fields(1, sources[2 + k])};
  return out;
}

Evolution watch_pairs(const PairSamples& samples, const PairsOptions& options, double success_threshold,
                      std::uint64_t seed, const Context& context) {
  Random random(seed);
  Evolution out;
  const Stopwatch watch;
  GeneticRun<Pair> run = evolve_pairs(samples, options, success_threshold, random, 1, context,
                                      [&](const GenerationLog&) { out.seconds.push_back(watch.seconds()); });
  out.log = std::move(run.log);
  out.stop = run.stop;
  return out;
}

int convergence_generation(const std::vector<GenerationLog>& log) {
  const double last = log.back().best, near = last + 0.05 * (log.front().best - last);
  return std::find_if(log.begin(), log.end(), [&](const GenerationLog& g) { return g.best <= near; })->generation;
}

std::vector<Duration> measure_durations(const PairSamples& samples, const PairsOptions& options, std::uint64_t seed,
                                        const Context& context) {
  const std::vector<AxisDistances>&left = samples.left_distance, &right = samples.right_distance;
  const double all = static_cast<double>(left.size()) * static_cast<double>(right.size());
  std::vector<Duration> out;
  const auto exact = [&](const char* name, const auto& search, double evaluations) {
    const Stopwatch watch;
    const std::vector<int> match = search(left, right, options.error);
    const double seconds = watch.seconds();
    out.push_back({name, 0, true, seconds, evaluations, 0, baselines::mean_fitness(left, right, match, options.error)});
  };
  exact("naive", baselines::naive_matches, all);
  exact("kdtree", baselines::tree_matches, 0);
  const double optimum = out[0].fitness;
  scan(samples, options.error, optimum, seed, out);
  genetic(samples, options, optimum, seed, context, out);
  return out;
}

}  // namespace ga_symmetry::comparison
