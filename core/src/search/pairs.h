// SPDX-License-Identifier: GPL-3.0-or-later
// A genetic algorithm over pairs of one left and one right sample, as in "Finding Intrinsic Points on 3D Models with
// Using Genetic Algorithms", called the paper below.
#pragma once
#include <array>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "search/genetic.h"
#include "surface/surface.h"
#include "util/random.h"

namespace ga_symmetry {

/// Geodesic distances of one vertex to the two axis points.
using AxisDistances = std::array<float, 2>;

/// The paper's fitness of a pair, lower is better: the sum over both axis points of |dL - dR| / dR, or of its square.
/// @return >= 0, dimensionless; +inf where a dR is 0
/// Differs from the paper's pseudo-code, which has neither the absolute value nor the square that its text names.
double pair_fitness(const AxisDistances& left, const AxisDistances& right, PairError error);

/// The region of each sample of one side: ranks by distance to one axis point, cut into `count` regions of equal size
/// (they differ by at most 1), 0 = nearest. Ties by index. @param count  [1, samples]
std::vector<int> make_regions(const std::vector<float>& distance, int count);

/// The regions of both sides, for both axis points.
struct RegionTable {
  int count = 0;                                         ///< regions per axis point
  std::array<std::vector<int>, 2> left, right;           ///< per axis point and sample: its region
  std::array<std::vector<std::vector<int>>, 2> members;  ///< per axis point and region: its right samples
  std::vector<std::vector<int>> cells;  ///< at r0 * count + r1: right samples in region r0 of a0 and r1 of a1
};
/// @param left, right  distances per sample, as many on both sides
RegionTable make_region_table(const std::vector<AxisDistances>& left, const std::vector<AxisDistances>& right,
                              int count);

/// One individual: a left sample (the paper's reference vertex) and a right one (its candidate vertex), by number.
struct Pair {
  int left = 0;
  int right = 0;
  bool operator<(const Pair& o) const { return left != o.left ? left < o.left : right < o.right; }
};

/// The candidate's region moves by one towards the reference's, for each axis point, and a random sample of the new
/// region replaces the candidate. The paper does not say how two axis points share one candidate: here it is drawn from
/// the samples that lie in both new regions or, where there are none, from the new region of one axis point, drawn too.
Pair crossover(const Pair& pair, const RegionTable& table, Random& random);

/// A random one of `candidates` right samples replaces the candidate.
Pair mutate(const Pair& pair, int candidates, Random& random);

enum class PairOperator { keep, crossover, mutation };
/// What happens to a pair in one generation: an outlier mutates, a pair below the mutation barrier is kept, all others
/// cross over and, with the mutation probability, mutate then (which makes their crossover void, so it is not done).
PairOperator choose_operator(double z_error, const PairsOptions& options, Random& random);

/// The side of every vertex: +1 left (nearer to l), -1 right (nearer to r), 0 on the axis.
///
/// Two axis points alone do not cut a surface in two. A symmetry that takes l to r keeps the set of points equally far
/// from both: that is the axis. No real surface is that symmetric: at the axis points, d(v,l) - d(v,r) is not 0. But
/// symmetric points have the same distances to a0 and a1, so among the vertices with distances like those of v the
/// differences are to balance: their mean (by area, within about a tenth of the surface's length unit) is subtracted.
/// So the axis goes through both axis points, and both sides are equally large at every distance from them.
/// Of an edge that crosses the axis, the end nearer to it is on the axis.
/// @param fields  distances from a0, a1, l, r
std::vector<int> split_sides(const Surface& surface, const DistanceFields& fields, const std::array<int, 2>& axis,
                             const std::array<int, 2>& pair);

/// What the search works on: as many samples on both sides, and their distances to the axis points.
struct PairSamples {
  std::vector<int> left, right;  ///< surface vertices
  std::vector<AxisDistances> left_distance, right_distance;
};
/// @param fields  as for split_sides @param side  as it returns them
/// @throws Cancelled
PairSamples make_pair_samples(const Surface& surface, const DistanceFields& fields, const std::vector<int>& side,
                              const std::array<int, 2>& pair, const PairsOptions& options, Random& random,
                              const Context& context = {});

/// The genetic search alone; in its log `best` is the mean over the left samples of their best pair's fitness.
/// @param success_threshold  of that mean, >= 0
/// @param observe  called after every generation, the initial one included; may be empty
/// @throws Cancelled
GeneticRun<Pair> evolve_pairs(const PairSamples& samples, const PairsOptions& options, double success_threshold,
                              Random& random, int threads, const Context& context = {},
                              const std::function<void(const GenerationLog&)>& observe = {});

/// Four different vertices of the surface.
struct PairReferences {
  std::array<int, 2> axis{};  ///< a0, a1: the reflection leaves them where they are
  std::array<int, 2> pair{};  ///< l, r: it takes one to the other
};

struct PairsResult {
  std::vector<int> partner;          ///< per surface vertex: its partner; a vertex on the axis is its own
  std::vector<double> fitness;       ///< per surface vertex: fitness with its partner, 0 on the axis
  std::vector<int> side;             ///< per surface vertex: +1 left, 0 on the axis, -1 right
  std::vector<SymmetricPair> pairs;  ///< the best pair of each left sample, without outliers; surface vertices
  DistanceFields fields;             ///< from a0, a1, l, r
  std::vector<int> left_samples, right_samples;  ///< surface vertices, as many on both sides
  std::vector<GenerationLog> log;  ///< `best` is the mean over the left samples of their best pair's fitness
  StopReason stop = StopReason::max_generations;
  double success_threshold = 0;  ///< fitness of the reference pair (l,r)
};

/// Pairs of samples by the paper's algorithm, then a partner for every vertex out of the pairs.
/// @param options  as check_options allows
/// @throws InvalidOption  if a reference is out of range or repeated
/// @throws Cancelled
///
/// Where the paper is silent or contradicts itself:
///  - Population: `individuals` pairs for every left sample, each with a random candidate.
///  - "Replace some individuals": a child takes its parent's place, unless the parent is the best pair of its left
///    sample and the child is worse. In the pseudo-code every candidate is overwritten and nothing good would last:
///    costs are so skewed that hardly any Z-error falls below the mutation barrier.
///  - Success: the mean of the left samples' best fitness reaches the fitness of (l,r). A single pair that is good
///    enough exists from the start, and says nothing about the others.
///  - Convergence: that mean has not improved for 30 generations.
///  - "The fittest individual" is one pair here, so the best pair of every left sample is extracted.
///  - Outlier removal: the extracted pairs whose Z-error is above the outlier threshold are left out.
///  - Local refinement: a vertex takes, by the same fitness, the best vertex of the patches at and next to the partners
///    of its nearest paired sample; left to right and right to left.
PairsResult search_pairs(const Surface& surface, const GeodesicSolver& solver, const PairReferences& references,
                         const PairsOptions& options, Random& random, int threads, const Context& context = {});

}  // namespace ga_symmetry
