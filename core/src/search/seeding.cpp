// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/seeding.h"

#include <algorithm>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "search/local_search.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

constexpr double kPi = 3.14159265358979323846;

// How seeds are made was chosen by how often the right map survived on meshes of known truth: docs/search.md.
constexpr int kCoarseSamples = 60;       // seeds compete over so many of the samples first
constexpr std::size_t kSeedPairs = 120;  // at least; pairs of tips may be more
constexpr int kAngles = 24;              // polar maps per pair, 15 degrees apart
constexpr int kMapsPerPair = 6;          // distinct ones kept of those
constexpr int kTried = 160;              // so many of the best distinct maps of all pairs are improved
constexpr int kCoarseSweeps = 6;         // of coordinate descent, at most
constexpr double kDistinctTurns = 0.1;   // maps nearer than this are one, before they are improved
constexpr double kDistinctSeeds = 0.08;  // and once they are
constexpr double kSame = 0.02;           // and once they are whole: what is nearer differs by a step between sites

}  // namespace

std::vector<SitePair> anchor_pairs(const Sites& sites, const Anchors& anchors) {
  const auto nearest = [&](const Landmarks& ends, int t, int count) {
    int best = 0;
    for (int k = 1; k < count; ++k)
      if (ends.field(t, sites.vertex[k]) < ends.field(t, sites.vertex[best])) best = k;
    return best;
  };
  std::vector<SitePair> out;
  for (int t = 0; t < anchors.count(); ++t)
    out.push_back({nearest(anchors.from, t, sites.samples), nearest(anchors.image, t, sites.count())});
  return out;
}

std::vector<SitePair> seed_pairs(const MapCost& cost, const std::vector<SitePair>& anchors) {
  const Sites& sites = cost.sites();
  const bool both_ways = cost.kind() == SymmetryKind::rotation;  // a reflection that takes a to b takes b to a
  std::vector<SitePair> out;
  for (const SitePair& a : anchors) out.push_back({a.sample, sites.nearest_sample[a.site]});
  // A symmetry takes tips to tips of about the same average distance. Poses change it, and so does what is missing.
  constexpr float kAlike = 0.15f;  // units, well above both
  const std::vector<int>& tips = sites.extremal;
  for (std::size_t a = 0; a < tips.size(); ++a)
    for (std::size_t b = a; b < tips.size(); ++b) {
      if (std::abs(sites.average_distance[tips[a]] - sites.average_distance[tips[b]]) > kAlike) continue;
      out.push_back({tips[a], tips[b]});
      if (both_ways && a != b) out.push_back({tips[b], tips[a]});
    }
  // Where tips are few, pairs that look most alike.
  struct Alike {
    float unlike;
    int a, b;
  };
  std::vector<Alike> alike;
  for (int a = 0; a < std::min(kCoarseSamples, sites.samples); ++a)
    for (int b = 0; b < a; ++b) alike.push_back({cost.unary()(a, b), a, b});
  std::stable_sort(alike.begin(), alike.end(), [](const Alike& x, const Alike& y) { return x.unlike < y.unlike; });
  for (const Alike& pair : alike) {
    if (out.size() >= kSeedPairs) break;
    out.push_back({pair.a, pair.b});
    if (both_ways) out.push_back({pair.b, pair.a});
  }
  return out;
}

Population<SampleMap> seed_population(const MapCost& cost, const Seeds& seeds, int limit, double outlier_z, int threads,
                                      const Context& context) {
  const Sites& all = cost.sites();
  const Sites few = coarsened(all, kCoarseSamples, all.samples);
  const MapCost coarse(cost, few);
  std::vector<Population<SampleMap>> of_pair(seeds.pairs.size());
  // Tells how far one of the three steps is; `worker` 0 is the calling thread.
  const auto tell = [&](int step, int done, std::size_t of, int worker) {
    if (worker == 0) context.report((step + static_cast<double>(done) / static_cast<double>(of)) / 3, "search");
    if (context.cancelled()) throw Cancelled();
  };
  parallel_for(static_cast<int>(seeds.pairs.size()), threads, [&](int s, int worker) {
    tell(0, s, seeds.pairs.size(), worker);
    Population<SampleMap> turned;
    for (int a = 0; a < kAngles; ++a) {
      SampleMap map = polar_map(coarse, seeds.pairs[s], 2 * kPi * a / kAngles);
      const double least = coarse.cost(map);
      turned.push_back({std::move(map), least, true});
    }
    sort_by_cost(turned);
    of_pair[s] = distinct(few, turned, kDistinctTurns, kMapsPerPair);
  });
  Population<SampleMap> tried;
  for (auto& population : of_pair)
    for (auto& individual : population) tried.push_back(std::move(individual));
  for (const SampleMap& map : seeds.maps) {
    SampleMap start(few.samples);
    for (int i = 0; i < few.samples; ++i) start[i] = all.nearest_sample[map[i]];
    const double least = coarse.cost(start);
    tried.push_back({std::move(start), least, true});
  }
  sort_by_cost(tried);
  tried = distinct(few, tried, kDistinctTurns, kTried);
  parallel_for(static_cast<int>(tried.size()), threads, [&](int t, int worker) {
    tell(1, t, tried.size(), worker);
    coordinate_descent(coarse, tried[t].genome, kEverywhere, kCoarseSweeps);
    tried[t].cost = coarse.score(tried[t].genome);
  });
  sort_by_cost(tried);
  Population<SampleMap> out = distinct(few, tried, kDistinctSeeds, limit);
  parallel_for(static_cast<int>(out.size()), threads, [&](int i, int worker) {
    tell(2, i, out.size(), worker);
    out[i].genome.resize(all.samples, -1);
    improve(cost, out[i].genome, outlier_z);
    out[i].cost = cost.score(out[i].genome);
    out[i].evaluated = true;
  });
  sort_by_cost(out);
  return distinct(all, out, kSame, limit);
}

}  // namespace ga_symmetry
