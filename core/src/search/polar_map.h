// SPDX-License-Identifier: GPL-3.0-or-later
// Whole maps that follow from one pair and one angle.
#pragma once
#include "search/map_cost.h"
#include "search/sample_map.h"

namespace ga_symmetry {

/// A sample and the site that a symmetry may take it to.
struct SitePair {
  int sample = -1;
  int site = -1;
  bool operator==(const SitePair& o) const { return sample == o.sample && site == o.site; }
};

/// The whole map that follows from taking a sample to a site and turning by `angle`: every other sample goes to the
/// sample that is as far from the site, in the mirrored (or, for a rotation, same) direction.
/// @param pair  its site is a sample, too @param angle  radians
/// @return samples' own sites only
SampleMap polar_map(const MapCost& cost, const SitePair& pair, double angle);

}  // namespace ga_symmetry
