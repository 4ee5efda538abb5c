// SPDX-License-Identifier: GPL-3.0-or-later
// The genome of the joint search, and how two of them differ.
#pragma once
#include <vector>

#include "search/genetic.h"
#include "search/sites.h"

namespace ga_symmetry {

/// Gene i is the site that is the partner of sample i; -1 = not known. Functions take whole maps, without -1, unless
/// they say otherwise.
using SampleMap = std::vector<int>;

/// Mean distance between the partners that two maps give, each counted as 1 at most; [0,1] units.
double map_distance(const Sites& sites, const SampleMap& a, const SampleMap& b);

/// Mean over the samples of how far a map moves them, [0,1).
double moved_share(const Sites& sites, const SampleMap& map);

void sort_by_cost(Population<SampleMap>& population);

/// The first `limit` of the maps that are not near a map before them.
/// @param radius  maps nearer than this are one, by map_distance
Population<SampleMap> distinct(const Sites& sites, const Population<SampleMap>& maps, double radius, int limit);

}  // namespace ga_symmetry
