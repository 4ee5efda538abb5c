// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/sample_map.h"

#include <algorithm>

namespace ga_symmetry {

double map_distance(const Sites& sites, const SampleMap& a, const SampleMap& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::min(1.f, sites.distance(a[i], b[i]));
  return sum / static_cast<double>(a.size());
}

double moved_share(const Sites& sites, const SampleMap& map) {
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double d = sites.distance(static_cast<int>(i), map[i]);
    sum += moved_share(d * d);
  }
  return sum / static_cast<double>(map.size());
}

void sort_by_cost(Population<SampleMap>& population) {
  std::stable_sort(population.begin(), population.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
}

Population<SampleMap> distinct(const Sites& sites, const Population<SampleMap>& maps, double radius, int limit) {
  Population<SampleMap> out;
  for (const auto& individual : maps) {
    if (static_cast<int>(out.size()) >= limit) break;
    const bool known = std::any_of(out.begin(), out.end(), [&](const auto& kept) {
      return map_distance(sites, kept.genome, individual.genome) < radius;
    });
    if (!known) out.push_back(individual);
  }
  return out;
}

}  // namespace ga_symmetry
