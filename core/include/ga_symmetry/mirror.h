// SPDX-License-Identifier: GPL-3.0-or-later
// Values at the vertices - a selection, colours, weights - and sculpted shape, carried across a symmetry.
#pragma once
#include <cstddef>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"

namespace ga_symmetry {

/// What becomes of the values of two partners.
enum class Transfer {
  left_to_right,  ///< the right takes the left's
  right_to_left,  ///< the left takes the right's
  swap,           ///< each takes the other's
  average,        ///< both take the mean
};

/// Which vertex takes whose value.
struct TransferPlan {
  std::vector<int> source;  ///< per vertex: the vertex whose value it takes or is averaged with; -1 = stays as it is
  int changed = 0;          ///< vertices with a source
  int without_partner = 0;  ///< that should have one, but their partner is missing or on the side that receives
};

/// Who takes whose value. To one side: every vertex of that side takes its partner's. `swap` and `average`: every
/// vertex.
/// @throws InvalidOption  for left_to_right and right_to_left where no vertex has a side, as after a rotation
TransferPlan plan_transfer(const Partners& partners, Transfer transfer);

/// The values after a transfer.
/// @param values   per vertex
/// @param plan     of as many vertices
/// @param combine  (own, source's) -> new value
template <class Value, class Combine>
std::vector<Value> transferred(const std::vector<Value>& values, const TransferPlan& plan, const Combine& combine) {
  std::vector<Value> out = values;
  for (std::size_t v = 0; v < out.size(); ++v)
    if (plan.source[v] >= 0) out[v] = combine(values[v], values[static_cast<std::size_t>(plan.source[v])]);
  return out;
}

/// Numbers: the source's, or for `average` the mean of both.
std::vector<double> transferred(const std::vector<double>& values, const TransferPlan& plan, Transfer transfer);

/// What was sculpted on one side, on the other, in any pose: every vertex moves as its partner point did, as seen from
/// the surface around it. Vertices that receive nothing stay where they are after sculpting.
/// @param before    the mesh with these partners
/// @param after     the same vertices after sculpting; its faces are not looked at
/// @param partners  of `before`
/// @param transfer  `average` makes what was sculpted symmetric
/// @param threads   0 = all cores; speed only
/// @param context   progress and cancelling
/// @return the positions, x,y,z per vertex
/// @throws InvalidOption  as check_partners and plan_transfer; if `after` has other vertices
/// @throws InvalidMesh    as find_symmetry, of `before`; if a coordinate of `after` is not finite
/// @throws Cancelled
std::vector<double> transferred_shape(const TriangleMesh& before, const TriangleMesh& after, const Partners& partners,
                                      Transfer transfer, int threads = 0, const Context& context = {});

}  // namespace ga_symmetry
