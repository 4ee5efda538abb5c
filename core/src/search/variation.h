// SPDX-License-Identifier: GPL-3.0-or-later
// New maps out of old ones, and which of them stay.
#pragma once
#include <vector>

#include "search/map_cost.h"
#include "search/sample_map.h"
#include "util/random.h"

namespace ga_symmetry {

/// The samples within `radius` units of a sample.
struct Disc {
  int center = 0;
  float radius = 0;
};
/// Any center; a radius from that of a few samples to that of half a body.
Disc draw_disc(const Sites& sites, Random& random);

/// Genes in the disc come from the mate, so that limbs are exchanged whole.
SampleMap disc_crossover(const Sites& sites, SampleMap map, const SampleMap& mate, const Disc& disc);

/// Genes in the disc become -1, for `recreate` to make anew.
SampleMap ruin(const Sites& sites, SampleMap map, const Disc& disc);

/// Genes in the disc become a polar map (see polar_map.h) around the partner of its center: a head that is turned about
/// its neck is turned back, which no gene can do alone. @param map  the center's gene is known @param angle  radians
SampleMap turn_disc(const MapCost& cost, SampleMap map, const Disc& disc, double angle);

/// The crossover of the paper (Finding Intrinsic Points on 3D Models with Using Genetic Algorithms) for one gene: sites
/// sorted by distance from the reference's image make five regions; the gene's new site, at random, lies one region
/// nearer to that of the sample's own distance from the reference.
/// @param reference  sample; its gene and gene i are known
/// @return the new site of gene i
int region_crossover(const Sites& sites, const SampleMap& map, int i, int reference, Random& random);

struct VariationOptions {
  double turn_probability = 0;      ///< of a child to have a disc turned, [0,1]
  double ruin_probability = 0;      ///< of any other child to be ruined instead of crossed, [0,1]
  double mutation_probability = 0;  ///< per gene, [0,1]
  std::vector<int> references;      ///< samples that region crossover refers to; empty = any
};

/// Each gene, with the mutation probability, takes any site or crosses over to the next region, one as likely as the
/// other. @param map  -1 where not known: such a gene takes any site
void mutate_genes(const Sites& sites, const VariationOptions& options, SampleMap& map, Random& random);

/// One child of each parent with a mate that wins a tournament of two; it differs from its parent, and lacks at most
/// half of its genes, or it is left out.
/// @param z_errors  of the parents' costs
Population<SampleMap> vary(const MapCost& cost, const VariationOptions& options, const Population<SampleMap>& parents,
                           const std::vector<double>& z_errors, Random& random);

/// Restricted tournament (Harik 1995): a child replaces the parent most like it, if it costs less, so that niches
/// survive. Children of infinite cost are dropped. @param parents  not empty; all evaluated, as the children
Population<SampleMap> restricted_tournament(const Sites& sites, Population<SampleMap> parents,
                                            Population<SampleMap> children);

}  // namespace ga_symmetry
