// SPDX-License-Identifier: GPL-3.0-or-later
// The first population: coherent whole maps.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/anchors.h"
#include "search/map_cost.h"
#include "search/polar_map.h"
#include "search/sample_map.h"

namespace ga_symmetry {

/// The sample nearest to each anchor, and the site nearest to its image; ties: the lower one.
std::vector<SitePair> anchor_pairs(const Sites& sites, const Anchors& anchors);

/// Pairs for polar maps: the anchors, then tips of the surface that are about as far from everything, then what looks
/// most alike. Sites are samples.
std::vector<SitePair> seed_pairs(const MapCost& cost, const std::vector<SitePair>& anchors);

struct Seeds {
  std::vector<SitePair> pairs;  ///< for polar maps, at all angles; as from `seed_pairs`
  std::vector<SampleMap> maps;  ///< further whole maps, which compete with the polar ones
};

/// Distinct seeds, lowest score first. They compete over the first samples alone, where improving a map costs a
/// fraction; the best of them are carried to all samples and improved there.
/// @param limit  maps, at most, >= 1
/// @param outlier_z  as for `improve`
/// @throws Cancelled
Population<SampleMap> seed_population(const MapCost& cost, const Seeds& seeds, int limit, double outlier_z, int threads,
                                      const Context& context = {});

}  // namespace ga_symmetry
