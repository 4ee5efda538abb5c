// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that lower the cost of one map: what makes the genetic search memetic (Moscato 1989).
#pragma once
#include <limits>

#include "search/map_cost.h"
#include "search/sample_map.h"

namespace ga_symmetry {

/// Radius of `coordinate_descent` that means all samples' own sites.
constexpr float kEverywhere = std::numeric_limits<float>::infinity();

/// Every gene in turn takes the site of the lowest cost given all others: the map's cost never rises.
/// @param radius  look among the sites within this distance of the present partner, [0, kNearRadius]; or kEverywhere
/// @param sweeps  over all genes, at most, >= 1; from the second on only where a gene or one near it has changed
/// @return genes changed
int coordinate_descent(const MapCost& cost, SampleMap& map, float radius, int sweeps = 1);

/// The genes that cost far more than the others, the outliers of the paper (Finding Intrinsic Points on 3D Models with
/// Using Genetic Algorithms), take the best of all sites.
/// @param outlier_z  Z-score of a gene's cost above which it is one, >= 0
/// @return genes changed
int relocate_outliers(const MapCost& cost, SampleMap& map, double outlier_z);

/// Genes that are -1 take, from the rim of their region inwards, the site that is best given the genes known so far:
/// the second half of "ruin and recreate" (Schrimpf et al. 2000). Leaves a map without a known gene as it is.
void recreate(const MapCost& cost, SampleMap& map);

/// All of these, until nothing changes or a few sweeps are done. @param map  at least one gene known
void improve(const MapCost& cost, SampleMap& map, double outlier_z);

}  // namespace ga_symmetry
