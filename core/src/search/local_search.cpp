// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/local_search.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "search/genetic.h"

namespace ga_symmetry {
namespace {

// A map, and which of its genes may have a better site by now.
class Descent {
 public:
  Descent(const MapCost& cost, SampleMap& map)
      : sites_(cost.sites()), gene_(cost, map), all_(sites_.count()), open_(map.size(), true) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  int sweep(float radius) {
    int changed = 0;
    for (int i = 0; i < sites_.samples; ++i) {
      if (!open_[i]) continue;
      open_[i] = false;
      gene_.look_at(i);
      const int present = gene_.site();
      if (radius == kEverywhere) {
        changed += take_best(all_.data(), all_.data() + sites_.samples);
      } else {
        const std::vector<int>& near = sites_.near[present];
        const auto end = std::partition_point(near.begin(), near.end(),
                                              [&](int k) { return sites_.distance(present, k) <= radius; });
        changed += take_best(near.data(), near.data() + (end - near.begin()));
      }
    }
    return changed;
  }

  int relocate(double outlier_z) {
    std::vector<double> costs(sites_.samples);
    for (int i = 0; i < sites_.samples; ++i) {
      gene_.look_at(i);
      costs[i] = gene_.guess(gene_.site());
    }
    const std::vector<double> z = z_scores(costs);
    int changed = 0;
    for (int i = 0; i < sites_.samples; ++i) {
      if (z[i] <= outlier_z) continue;
      gene_.look_at(i);
      changed += take_best(all_.data(), all_.data() + all_.size());
    }
    return changed;
  }

 private:
  // The gene that is looked at; it stays where nothing is better. A guess proposes, the exact cost decides.
  bool take_best(const int* first, const int* last) {
    const int present = gene_.site();
    int best = present;
    float least = gene_.guess(present);
    for (; first != last; ++first) {
      const float cost = gene_.guess(*first, least);
      if (cost < least) least = cost, best = *first;
    }
    if (best == present || gene_.cost(best) >= gene_.cost(present)) return false;
    gene_.set(best);
    open_[gene_.gene()] = true;
    for (int j : sites_.neighbors[gene_.gene()]) open_[j] = true;
    return true;
  }

  const Sites& sites_;
  GeneCost gene_;
  std::vector<int> all_;
  std::vector<char> open_;  // "don't look bits" (Bentley 1992)
};

}  // namespace

int coordinate_descent(const MapCost& cost, SampleMap& map, float radius, int sweeps) {
  Descent descent(cost, map);
  int changed = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const int now = descent.sweep(radius);
    changed += now;
    if (!now) break;
  }
  return changed;
}

int relocate_outliers(const MapCost& cost, SampleMap& map, double outlier_z) {
  return Descent(cost, map).relocate(outlier_z);
}

void recreate(const MapCost& cost, SampleMap& map) {
  const Sites& sites = cost.sites();
  const int n = sites.samples, count = sites.count();
  std::vector<int> kept, lost;
  for (int i = 0; i < n; ++i) (map[i] < 0 ? lost : kept).push_back(i);
  if (lost.empty() || kept.empty()) return;
  // From the rim inwards, so that each finds neighbours.
  std::vector<float> inside(n, std::numeric_limits<float>::infinity());
  for (int i : lost)
    for (int j : kept) inside[i] = std::min(inside[i], sites.distance(i, j));
  std::stable_sort(lost.begin(), lost.end(), [&](int a, int b) { return inside[a] < inside[b]; });
  const bool slack = sites.slack.size() > 0;
  // A pair of samples counts twice in the cost, once for each; the distances are a mean over the genes known so far.
  const CostWeights& w = cost.weights();
  const float distance_weight = static_cast<float>(2 * w.distance);
  const float orientation_weight = static_cast<float>(2 * w.orientation);
  const float continuity_weight = static_cast<float>(2 * w.continuity);
  std::vector<float> from(n), to(n), slack_from(n), slack_to(n), weight(n);  // to the kept samples and their partners
  Vicinity around;
  for (int i : lost) {
    const int m = static_cast<int>(kept.size());
    for (int j = 0; j < m; ++j) from[j] = sites.distance(i, kept[j]), weight[j] = cost.distance_weight()(i, kept[j]);
    for (int j = 0; slack && j < m; ++j) slack_from[j] = sites.slack(i, kept[j]);
    cost.look_around(map, i, around);
    float least = std::numeric_limits<float>::infinity();
    int best = i;
    for (int k = 0; k < count; ++k) {
      float total = cost.unary()(i, k);
      if (total >= least) continue;
      if (orientation_weight > 0) total += orientation_weight * cost.orientation_error(around, k);
      if (total >= least) continue;
      total += continuity_weight * cost.continuity_error(around, k);
      if (total >= least) continue;
      const float* image = sites.distance.row(k).data();
      for (int j = 0; j < m; ++j) to[j] = image[map[kept[j]]];
      for (int j = 0; slack && j < m; ++j) slack_to[j] = sites.slack(k, map[kept[j]]);
      const float error = distance_error(from.data(), to.data(), slack ? slack_from.data() : nullptr, slack_to.data(),
                                         weight.data(), m);
      total += distance_weight * error / static_cast<float>(m);
      if (total < least) least = total, best = k;
    }
    map[i] = best;
    kept.push_back(i);
  }
}

void improve(const MapCost& cost, SampleMap& map, double outlier_z) {
  constexpr int kSweeps = 6;  // at most; chosen with the seeding: docs/search.md
  recreate(cost, map);
  Descent descent(cost, map);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    if (!descent.sweep(kNearRadius) && !descent.relocate(outlier_z)) break;
}

}  // namespace ga_symmetry
