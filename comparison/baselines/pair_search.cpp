// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/pair_search.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>

namespace ga_symmetry::baselines {
namespace {

struct Candidates {
  const std::vector<AxisDistances>& all;
  std::vector<int> usable;  // a distance of 0 makes the fitness infinite
  std::size_t kdtree_get_point_count() const { return usable.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const { return all[usable[i]][k]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// The terms of pair_fitness, with its own arithmetic, so that both searches see the same numbers.
struct FitnessMetric {
  using ElementType = double;
  using DistanceType = double;
  const Candidates& candidates;
  PairError error;

  FitnessMetric(const Candidates& c, PairError e) : candidates(c), error(e) {}
  double accum_dist(double reference, double candidate, std::size_t) const {
    const double e = std::abs(reference - candidate) / candidate;
    return error == PairError::squared ? e * e : e;
  }
  double evalMetric(const double* reference, std::size_t i, std::size_t) const {
    return accum_dist(reference[0], candidates.kdtree_get_pt(i, 0), 0) +
           accum_dist(reference[1], candidates.kdtree_get_pt(i, 1), 1);
  }
};

struct Lowest {
  double fitness = std::numeric_limits<double>::infinity();
  std::uint32_t index = 0;
  bool addPoint(double f, std::uint32_t i) {
    if (f < fitness || (f == fitness && i < index)) fitness = f, index = i;
    return true;
  }
  // A leaf offers only what is below the worst: what is equal must be offered, too.
  double worstDist() const { return std::nextafter(fitness, std::numeric_limits<double>::infinity()); }
  std::size_t size() const { return 1; }
  bool full() const { return true; }
};

}  // namespace

std::vector<int> naive_matches(const std::vector<AxisDistances>& references,
                               const std::vector<AxisDistances>& candidates, PairError error) {
  std::vector<int> out;
  out.reserve(references.size());
  for (const AxisDistances& reference : references) {
    double lowest = std::numeric_limits<double>::infinity();
    int best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double f = pair_fitness(reference, candidates[i], error);
      if (f < lowest) lowest = f, best = static_cast<int>(i);
    }
    out.push_back(best);
  }
  return out;
}

std::vector<int> tree_matches(const std::vector<AxisDistances>& references,
                              const std::vector<AxisDistances>& candidates, PairError error) {
  Candidates usable{candidates, {}};
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i][0] > 0 && candidates[i][1] > 0) usable.usable.push_back(static_cast<int>(i));
  std::vector<int> out(references.size(), 0);
  if (usable.usable.empty()) return out;
  const nanoflann::KDTreeSingleIndexAdaptor<FitnessMetric, Candidates, 2> tree(2, usable, {16}, error);
  // The bounds are sums that are updated on the way: the slack keeps rounding from cutting off the best.
  const nanoflann::SearchParams slack(0, -1e-6f, false);
  for (std::size_t i = 0; i < references.size(); ++i) {
    const double reference[2] = {references[i][0], references[i][1]};
    Lowest lowest;
    tree.findNeighbors(lowest, reference, slack);
    out[i] = usable.usable[lowest.index];
  }
  return out;
}

double mean_fitness(const std::vector<AxisDistances>& references, const std::vector<AxisDistances>& candidates,
                    const std::vector<int>& matches, PairError error) {
  double sum = 0;
  for (std::size_t i = 0; i < references.size(); ++i) sum += pair_fitness(references[i], candidates[matches[i]], error);
  return sum / static_cast<double>(references.size());
}

}  // namespace ga_symmetry::baselines
