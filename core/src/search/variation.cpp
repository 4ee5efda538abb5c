// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/variation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "search/polar_map.h"

namespace ga_symmetry {
namespace {

constexpr int kRegions = 5;  // of distance, as in the paper

}  // namespace

Disc draw_disc(const Sites& sites, Random& random) {
  constexpr double kSmallest = 0.15, kLargest = 1;  // units: a sample and its nearest; a limb and more
  const int center = static_cast<int>(draw_below(random, sites.samples));
  return {center, static_cast<float>(kSmallest + (kLargest - kSmallest) * draw_unit(random))};
}

SampleMap disc_crossover(const Sites& sites, SampleMap map, const SampleMap& mate, const Disc& disc) {
  for (int i = 0; i < sites.samples; ++i)
    if (sites.distance(disc.center, i) <= disc.radius) map[i] = mate[i];
  return map;
}

SampleMap ruin(const Sites& sites, SampleMap map, const Disc& disc) {
  return disc_crossover(sites, std::move(map), SampleMap(sites.samples, -1), disc);
}

SampleMap turn_disc(const MapCost& cost, SampleMap map, const Disc& disc, double angle) {
  const Sites& sites = cost.sites();
  const SampleMap turned = polar_map(cost, {disc.center, sites.nearest_sample[map[disc.center]]}, angle);
  return disc_crossover(sites, std::move(map), turned, disc);
}

int region_crossover(const Sites& sites, const SampleMap& map, int i, int reference, Random& random) {
  const int count = sites.count(), image = map[reference];
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  const auto nearer = [&](int a, int b) { return sites.distance(image, a) < sites.distance(image, b); };
  std::stable_sort(order.begin(), order.end(), nearer);
  const auto region = [&](std::ptrdiff_t rank) {
    return static_cast<int>(std::min<std::ptrdiff_t>(rank, count - 1) * kRegions / count);
  };
  const int present = region(std::find(order.begin(), order.end(), map[i]) - order.begin());
  const auto wanted_rank =
      std::partition_point(order.begin(), order.end(),
                           [&](int k) { return sites.distance(image, k) < sites.distance(reference, i); }) -
      order.begin();
  const int wanted = region(wanted_rank), next = present + (wanted > present) - (wanted < present);
  const int first = (next * count + kRegions - 1) / kRegions, last = ((next + 1) * count + kRegions - 1) / kRegions;
  return order[first + static_cast<int>(draw_below(random, last - first))];
}

void mutate_genes(const Sites& sites, const VariationOptions& options, SampleMap& map, Random& random) {
  for (int i = 0; i < sites.samples; ++i) {
    if (draw_unit(random) >= options.mutation_probability) continue;
    const std::vector<int>& references = options.references;
    const int reference = references.empty() ? static_cast<int>(draw_below(random, sites.samples))
                                             : references[draw_below(random, references.size())];
    const bool region = draw_unit(random) < 0.5 && map[i] >= 0 && map[reference] >= 0;
    map[i] = region ? region_crossover(sites, map, i, reference, random)
                    : static_cast<int>(draw_below(random, sites.count()));
  }
}

Population<SampleMap> vary(const MapCost& cost, const VariationOptions& options, const Population<SampleMap>& parents,
                           const std::vector<double>& z_errors, Random& random) {
  const Sites& sites = cost.sites();
  Population<SampleMap> children;
  for (const auto& parent : parents) {
    const SampleMap& mate = parents[tournament(z_errors, 2, random)].genome;
    const Disc disc = draw_disc(sites, random);
    SampleMap child = draw_unit(random) < options.turn_probability
                          ? turn_disc(cost, parent.genome, disc, 2 * M_PI * draw_unit(random))
                      : draw_unit(random) < options.ruin_probability ? ruin(sites, parent.genome, disc)
                                                                     : disc_crossover(sites, parent.genome, mate, disc);
    if (std::count(child.begin(), child.end(), -1) > sites.samples / 2) continue;
    mutate_genes(sites, options, child, random);
    if (child != parent.genome) children.push_back({std::move(child)});
  }
  return children;
}

Population<SampleMap> restricted_tournament(const Sites& sites, Population<SampleMap> parents,
                                            Population<SampleMap> children) {
  for (auto& child : children) {
    if (!std::isfinite(child.cost)) continue;
    std::size_t rival = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < parents.size(); ++i) {
      const double d = map_distance(sites, parents[i].genome, child.genome);
      if (d < nearest) nearest = d, rival = i;
    }
    if (child.cost < parents[rival].cost) parents[rival] = std::move(child);
  }
  return parents;
}

}  // namespace ga_symmetry
