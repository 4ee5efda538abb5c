// SPDX-License-Identifier: GPL-3.0-or-later
// What the paper's pair-wise genetic algorithm is measured against: exact searches of its own fitness.
#pragma once
#include <vector>

#include "search/pairs.h"

namespace ga_symmetry::baselines {

/// The candidate of lowest fitness for each reference, ties by index.
/// Source: the paper's "naive approach", table 1: every reference against every candidate.
/// @param references, candidates  distances to the axis points; candidates not empty
/// @return per reference: number of a candidate
std::vector<int> naive_matches(const std::vector<AxisDistances>& references,
                               const std::vector<AxisDistances>& candidates, PairError error);

/// The same answer out of a k-d tree: the fitness is a sum over the axis points of terms that grow on both sides of the
/// reference's own distance, which is all that the bounds of a k-d tree need.
/// Source: Friedman, Bentley & Finkel 1977, in nanoflann.
std::vector<int> tree_matches(const std::vector<AxisDistances>& references,
                              const std::vector<AxisDistances>& candidates, PairError error);

/// Mean fitness of the references with their matches: what the genetic algorithm minimises.
double mean_fitness(const std::vector<AxisDistances>& references, const std::vector<AxisDistances>& candidates,
                    const std::vector<int>& matches, PairError error);

}  // namespace ga_symmetry::baselines
