// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"
#include "geodesics/sampling.h"
#include "search/genetic.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

constexpr int kStallGenerations = 30;  // a tenth of the default number of generations
constexpr int kGrain = 1024;           // a fitness takes nanoseconds
constexpr double kSplitCell = 0.2;     // of the surface's unit; hat functions of that width blur by about half of it
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The nearest of a growing set of samples, along the edges. A new sample visits only the vertices that it wins, so
// thousands of samples cost little more than a few; a distance field each would take minutes on a large mesh.
class Nearest {
 public:
  explicit Nearest(const Surface& surface)
      : surface_(surface), distance_(surface.vertices(), kInfinity), sample_(surface.vertices(), -1) {}

  void add(int vertex, int sample) {
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    distance_[vertex] = 0;
    sample_[vertex] = sample;
    queue.push({0, vertex});
    while (!queue.empty()) {
      const auto [at, v] = queue.top();
      queue.pop();
      if (at > distance_[v]) continue;
      for_each_neighbor(surface_, v, [&, from = v, start = at](int w) {
        const double d = start + surface_.edge_length(from, w);
        if (!(d < distance_[w])) return;
        distance_[w] = d;
        sample_[w] = sample;
        queue.push({d, w});
      });
    }
  }

  const std::vector<double>& distance() const { return distance_; }
  const std::vector<int>& sample() const { return sample_; }

 private:
  const Surface& surface_;
  std::vector<double> distance_;
  std::vector<int> sample_;
};

// The patch of vertices around each of some samples.
struct Patches {
  std::vector<int> of;                    // per surface vertex: its patch
  std::vector<std::vector<int>> members;  // per patch: its vertices on the wanted side
  std::vector<std::vector<int>> around;   // per patch: it and those that touch it
};

Patches make_patches(const Surface& surface, const std::vector<int>& samples, const std::vector<int>& side,
                     int wanted) {
  Nearest nearest(surface);
  for (std::size_t i = 0; i < samples.size(); ++i) nearest.add(samples[i], static_cast<int>(i));
  Patches out{nearest.sample(), std::vector<std::vector<int>>(samples.size()),
              std::vector<std::vector<int>>(samples.size())};
  for (int v = 0; v < surface.vertices(); ++v) {
    if (side[v] == wanted) out.members[out.of[v]].push_back(v);
    for_each_neighbor(surface, v, [&](int w) { out.around[out.of[v]].push_back(out.of[w]); });
  }
  for (std::vector<int>& around : out.around) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }
  return out;
}

std::vector<int> vertices_of(const std::vector<int>& side, int wanted) {
  std::vector<int> out;
  for (int v = 0; v < static_cast<int>(side.size()); ++v)
    if (side[v] == wanted) out.push_back(v);
  return out;
}

// Evenly spaced samples of one side; the first is that side's reference vertex.
std::vector<int> spread_samples(const Surface& surface, const std::vector<int>& vertices, int first, int count,
                                const Context& context) {
  Nearest nearest(surface);
  return farthest_points(
      vertices, first, count, [&](int v) { return nearest.distance()[v]; },
      [&](int v) {
        if (context.cancelled()) throw Cancelled();
        nearest.add(v, 0);
      });
}

// Per left sample: its best individual.
std::vector<int> best_pairs(const Population<Pair>& population, std::size_t samples) {
  std::vector<int> best(samples, -1);
  for (int i = 0; i < static_cast<int>(population.size()); ++i) {
    int& b = best[population[i].genome.left];
    if (b < 0 || population[i].cost < population[b].cost) b = i;
  }
  return best;
}

struct PairsProblem {
  const PairsOptions& options;
  const std::vector<AxisDistances>&left, &right;
  RegionTable table;

  double evaluate(const Pair& pair, int /*worker*/) const {
    return pair_fitness(left[pair.left], right[pair.right], options.error);
  }

  double best(const Population<Pair>& population) const {
    double sum = 0;
    for (int i : best_pairs(population, left.size())) sum += population[i].cost;
    return sum / static_cast<double>(left.size());
  }

  Population<Pair> vary(const Population<Pair>& parents, const std::vector<double>& z_errors, Random& random) const {
    Population<Pair> children = parents;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Pair& parent = parents[i].genome;
      const PairOperator chosen = choose_operator(z_errors[i], options, random);
      if (chosen == PairOperator::mutation) children[i] = {mutate(parent, static_cast<int>(right.size()), random)};
      if (chosen == PairOperator::crossover) children[i] = {crossover(parent, table, random)};
    }
    return children;
  }

  Population<Pair> replace(const Population<Pair>& parents, Population<Pair> children) const {
    for (int i : best_pairs(parents, left.size()))
      if (parents[i].cost < children[i].cost) children[i] = parents[i];
    return children;
  }
};

void check_references(const Surface& surface, const std::vector<int>& references) {
  for (std::size_t i = 0; i < references.size(); ++i) {
    const std::string name = "reference vertex " + std::to_string(references[i]);
    if (references[i] < 0 || references[i] >= surface.vertices())
      throw InvalidOption(name + " is not one of the " + std::to_string(surface.vertices()) +
                          " vertices of the surface: choose another");
    if (std::count(references.begin(), references.begin() + i, references[i]))
      throw InvalidOption(name + " is given twice: choose four different vertices");
  }
}

}  // namespace

double pair_fitness(const AxisDistances& left, const AxisDistances& right, PairError error) {
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    if (right[k] == 0) return kInfinity;
    const double e = std::abs(static_cast<double>(left[k]) - right[k]) / right[k];
    sum += error == PairError::squared ? e * e : e;
  }
  return sum;
}

std::vector<int> make_regions(const std::vector<float>& distance, int count) {
  std::vector<int> order(distance.size()), region(distance.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return distance[a] < distance[b]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    region[order[rank]] = static_cast<int>(rank * count / order.size());
  return region;
}

RegionTable make_region_table(const std::vector<AxisDistances>& left, const std::vector<AxisDistances>& right,
                              int count) {
  RegionTable table;
  table.count = count;
  table.cells.resize(static_cast<std::size_t>(count) * count);
  for (int k = 0; k < 2; ++k) {
    const auto regions = [&](const std::vector<AxisDistances>& samples) {
      std::vector<float> distance;
      for (const AxisDistances& d : samples) distance.push_back(d[k]);
      return make_regions(distance, count);
    };
    table.left[k] = regions(left);
    table.right[k] = regions(right);
    table.members[k].resize(count);
    for (int j = 0; j < static_cast<int>(right.size()); ++j) table.members[k][table.right[k][j]].push_back(j);
  }
  for (int j = 0; j < static_cast<int>(right.size()); ++j)
    table.cells[static_cast<std::size_t>(table.right[0][j]) * count + table.right[1][j]].push_back(j);
  return table;
}

Pair crossover(const Pair& pair, const RegionTable& table, Random& random) {
  std::array<int, 2> region;
  for (int k = 0; k < 2; ++k) {
    const int candidate = table.right[k][pair.right], reference = table.left[k][pair.left];
    region[k] = candidate + (reference > candidate) - (reference < candidate);
  }
  const std::vector<int>* pool = &table.cells[static_cast<std::size_t>(region[0]) * table.count + region[1]];
  if (pool->empty()) {
    const std::size_t k = draw_below(random, 2);
    pool = &table.members[k][region[k]];
  }
  return {pair.left, (*pool)[draw_below(random, pool->size())]};
}

Pair mutate(const Pair& pair, int candidates, Random& random) {
  return {pair.left, static_cast<int>(draw_below(random, candidates))};
}

PairOperator choose_operator(double z_error, const PairsOptions& options, Random& random) {
  if (z_error > options.outlier_z) return PairOperator::mutation;
  if (z_error < options.mutation_barrier_z) return PairOperator::keep;
  return draw_unit(random) < options.mutation_probability ? PairOperator::mutation : PairOperator::crossover;
}

std::vector<int> split_sides(const Surface& surface, const DistanceFields& fields, const std::array<int, 2>& axis,
                             const std::array<int, 2>& pair) {
  const int n = surface.vertices();
  // On a needle the unit is much shorter than the distances; the grid stays small.
  const double cell = std::max(kSplitCell * surface.unit(), fields.topRows(2).maxCoeff() / 1000.0);
  const auto grid_size = [&](int field) { return static_cast<int>(fields.row(field).maxCoeff() / cell) + 2; };
  const int columns = grid_size(1);
  std::vector<double> sum(static_cast<std::size_t>(grid_size(0)) * columns), area(sum.size());
  // The four grid nodes around the vertex's distances to a0 and a1, with their bilinear weights.
  const auto for_nodes = [&](int v, const auto& f) {
    const double x = fields(0, v) / cell, y = fields(1, v) / cell;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const double wx = i ? x - std::floor(x) : 1 - (x - std::floor(x));
        const double wy = j ? y - std::floor(y) : 1 - (y - std::floor(y));
        f(static_cast<std::size_t>(x + i) * columns + static_cast<std::size_t>(y + j), wx * wy);
      }
  };
  std::vector<double> balance(n);
  for (int v = 0; v < n; ++v) {
    balance[v] = static_cast<double>(fields(3, v)) - fields(2, v);
    for_nodes(v, [&](std::size_t node, double weight) {
      sum[node] += weight * surface.vertex_area[v] * balance[v];
      area[node] += weight * surface.vertex_area[v];
    });
  }
  std::vector<int> side(n);
  for (int v = 0; v < n; ++v) {
    double mean = 0;
    for_nodes(v, [&](std::size_t node, double weight) {
      if (weight > 0) mean += weight * sum[node] / area[node];
    });
    balance[v] -= mean;
    side[v] = (balance[v] > 0) - (balance[v] < 0);
  }
  for (int c = 0; c < static_cast<int>(surface.triangle.size()); ++c) {
    const int a = surface.triangle[next_corner(c)], b = surface.triangle[previous_corner(c)];
    if (balance[a] * balance[b] < 0) side[std::abs(balance[a]) <= std::abs(balance[b]) ? a : b] = 0;
  }
  side[pair[0]] = 1;
  side[pair[1]] = -1;
  side[axis[0]] = side[axis[1]] = 0;
  return side;
}

PairSamples make_pair_samples(const Surface& surface, const DistanceFields& fields, const std::vector<int>& side,
                              const std::array<int, 2>& pair, const PairsOptions& options, Random& random,
                              const Context& context) {
  const std::vector<int> left = vertices_of(side, 1), right = vertices_of(side, -1);
  const std::size_t count = std::min({static_cast<std::size_t>(options.samples / 2), left.size(), right.size()});
  PairSamples out;
  if (options.sampling == Sampling::evenly_spaced) {
    out.left = spread_samples(surface, left, pair[0], static_cast<int>(count), context);
    out.right = spread_samples(surface, right, pair[1], static_cast<int>(count), context);
  } else {
    for (int v : uniform_sample_vertices(surface, surface.vertices(), random)) {
      std::vector<int>& own = side[v] > 0 ? out.left : out.right;
      if (side[v] != 0 && own.size() < count) own.push_back(v);
    }
  }
  for (int v : out.left) out.left_distance.push_back({fields(0, v), fields(1, v)});
  for (int v : out.right) out.right_distance.push_back({fields(0, v), fields(1, v)});
  return out;
}

GeneticRun<Pair> evolve_pairs(const PairSamples& samples, const PairsOptions& options, double success_threshold,
                              Random& random, int threads, const Context& context,
                              const std::function<void(const GenerationLog&)>& observe) {
  const int count = static_cast<int>(samples.left.size());
  const PairsProblem problem{
      options, samples.left_distance, samples.right_distance,
      make_region_table(samples.left_distance, samples.right_distance, std::min(options.regions, count))};
  Population<Pair> initial;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < options.individuals; ++k) initial.push_back({mutate({i, 0}, count, random)});
  GeneticOptions genetic;
  genetic.max_generations = options.max_generations;
  genetic.stall_generations = kStallGenerations;
  genetic.success_threshold = success_threshold;
  genetic.threads = threads;
  genetic.grain = kGrain;
  return evolve(problem, std::move(initial), genetic, random, context, observe);
}

PairsResult search_pairs(const Surface& surface, const GeodesicSolver& solver, const PairReferences& references,
                         const PairsOptions& options, Random& random, int threads, const Context& context) {
  const auto& [axis, pair] = references;
  const std::vector<int> sources{axis[0], axis[1], pair[0], pair[1]};
  check_references(surface, sources);
  context.report(0, "geodesics");
  DistanceFields fields = solver.fields(sources, threads, context);
  const auto distances = [&](int v) { return AxisDistances{fields(0, v), fields(1, v)}; };

  PairsResult result;
  result.success_threshold = pair_fitness(distances(pair[0]), distances(pair[1]), options.error);
  result.side = split_sides(surface, fields, axis, pair);

  context.report(0.1, "samples");
  PairSamples both = make_pair_samples(surface, fields, result.side, pair, options, random, context);
  const int samples = static_cast<int>(both.left.size());
  GeneticRun<Pair> run = evolve_pairs(
      both, options, result.success_threshold, random, threads, context, [&](const GenerationLog& generation) {
        context.report(0.2 + 0.6 * generation.generation / options.max_generations, "search");
      });
  result.left_samples = std::move(both.left);
  result.right_samples = std::move(both.right);
  result.log = std::move(run.log);
  result.stop = run.stop;

  context.report(0.8, "partners");
  std::vector<Individual<Pair>> best;
  for (int i : best_pairs(run.population, both.left_distance.size())) best.push_back(run.population[i]);
  const std::vector<double> z_errors = z_scores(costs_of(best));
  // Both ways: the samples that have a pair, and the numbers of their partners on the other side.
  std::vector<int> paired_left, paired_right, number(samples, -1);
  std::vector<std::vector<int>> to_right, to_left;
  for (int i = 0; i < samples; ++i) {
    if (z_errors[i] > options.outlier_z) continue;
    const Pair& p = best[i].genome;
    const int l = result.left_samples[p.left], r = result.right_samples[p.right];
    result.pairs.push_back({l, r, best[i].cost});
    paired_left.push_back(l);
    to_right.push_back({p.right});
    if (number[p.right] < 0) {
      number[p.right] = static_cast<int>(paired_right.size());
      paired_right.push_back(r);
      to_left.emplace_back();
    }
    to_left[number[p.right]].push_back(p.left);
  }

  result.partner.resize(surface.vertices());
  std::iota(result.partner.begin(), result.partner.end(), 0);
  result.fitness.assign(surface.vertices(), 0);
  const auto extract = [&](const std::vector<int>& from, const std::vector<int>& from_samples,
                           const std::vector<std::vector<int>>& partners, const std::vector<int>& to_samples) {
    const int mine = result.side[from[0]];
    const Patches here = make_patches(surface, from_samples, result.side, mine);
    const Patches there = make_patches(surface, to_samples, result.side, -mine);
    parallel_for(static_cast<int>(from.size()), threads, [&](int i, int) {
      if (context.cancelled()) throw Cancelled();
      const int v = from[i];
      double lowest = kInfinity;
      for (int partner : partners[here.of[v]])
        for (int patch : there.around[partner])
          for (int w : there.members[patch]) {
            const double f = mine > 0 ? pair_fitness(distances(v), distances(w), options.error)
                                      : pair_fitness(distances(w), distances(v), options.error);
            if (f < lowest) lowest = f, result.partner[v] = w;
          }
      result.fitness[v] = lowest;
    });
  };
  extract(vertices_of(result.side, 1), paired_left, to_right, result.right_samples);
  extract(vertices_of(result.side, -1), paired_right, to_left, result.left_samples);
  result.fields = std::move(fields);
  context.report(1, "partners");
  return result;
}

}  // namespace ga_symmetry
