// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/mirror.h"

#include <algorithm>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

TransferPlan plan_transfer(const Partners& p, Transfer transfer) {
  const bool one_way = transfer == Transfer::left_to_right || transfer == Transfer::right_to_left;
  const int receiving = transfer == Transfer::left_to_right ? -1 : 1;
  if (one_way && std::all_of(p.side.begin(), p.side.end(), [](int side) { return side == 0; }))
    throw InvalidOption("there is no left and no right, as after a rotation: swap or average instead");
  TransferPlan plan;
  plan.source.assign(p.partner.size(), -1);
  for (std::size_t v = 0; v < p.partner.size(); ++v) {
    if (one_way && p.side[v] != receiving) continue;
    const int partner = p.partner[v];
    if (partner < 0 || (one_way && p.side[static_cast<std::size_t>(partner)] == receiving)) {
      ++plan.without_partner;
    } else {
      plan.source[v] = partner;
      ++plan.changed;
    }
  }
  return plan;
}

std::vector<double> transferred(const std::vector<double>& values, const TransferPlan& plan, Transfer transfer) {
  return transferred(values, plan, [&](double own, double source) {
    return transfer == Transfer::average ? 0.5 * (own + source) : source;
  });
}

}  // namespace ga_symmetry
