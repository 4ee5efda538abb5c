// SPDX-License-Identifier: GPL-3.0-or-later
// Where the two sides of a shape differ.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"

namespace ga_symmetry {

/// What is compared between the disc around a vertex and what the symmetry lays onto it from the other side.
enum class AsymmetryMeasure {
  area,       ///< difference of their areas over the mean of both, [-2,2]: 0.1 = own side 10 % larger
  length,     ///< the same of the distances from their centres to points that are partners
  curvature,  ///< difference of their mean curvatures times sqrt(area); convex counts as more
};

/// What can be chosen of asymmetry().
struct AsymmetryOptions {
  AsymmetryMeasure measure = AsymmetryMeasure::area;  ///< what is compared
  double radius = 0.1;  ///< of the discs, over sqrt(area), (0,1]; the time grows with its square
  int threads = 0;      ///< 0 = all cores, [0, 256]; speed only
};

/// Per vertex: positive where its own side has more, negative where its partner's has, 0 where it has no partner.
/// Distances are geodesic, so the pose does not matter. All measures are integrals over discs, so the triangulation
/// matters only where its edges are not small against the radius.
/// @throws InvalidOption  as check_partners, or if an option is out of range
/// @throws InvalidMesh    as make_surface with the largest component
/// @throws Cancelled
std::vector<double> asymmetry(const TriangleMesh& mesh, const Partners& partners, const AsymmetryOptions& options = {},
                              const Context& context = {});

}  // namespace ga_symmetry
