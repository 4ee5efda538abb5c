// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/polar_map.h"

#include <cmath>

namespace ga_symmetry {

SampleMap polar_map(const MapCost& cost, const SitePair& pair, double angle) {
  constexpr float kTurned = 0.25f;  // the opposite direction costs as much as a distance that is 70 % off
  const Sites& sites = cost.sites();
  const int n = sites.samples, p = pair.sample, q = pair.site;
  const float sign = cost.kind() == SymmetryKind::reflection ? -1.f : 1.f;
  const float turn_re = static_cast<float>(std::cos(angle)), turn_im = static_cast<float>(std::sin(angle));
  SampleMap map(n);
  for (int j = 0; j < n; ++j) {
    if (j == p) {
      map[j] = q;
      continue;
    }
    const float d = sites.distance(p, j), x = sites.cosine(p, j), y = sign * sites.sine(p, j);
    const float re = turn_re * x - turn_im * y, im = turn_re * y + turn_im * x, scale = 1 / (d * d + kNear2);
    const auto agreement = re * sites.cosine.row(q).head(n).array() + im * sites.sine.row(q).head(n).array();
    ((d - sites.distance.row(q).head(n).array()).square() * scale + kTurned * (1 - agreement) +
     cost.unary().row(j).head(n).array())
        .minCoeff(&map[j]);
  }
  return map;
}

}  // namespace ga_symmetry
