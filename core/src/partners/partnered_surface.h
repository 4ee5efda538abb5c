// SPDX-License-Identifier: GPL-3.0-or-later
// A checked surface together with the partners of its vertices; private to the core.
#pragma once
#include <vector>

#include "ga_symmetry/partners.h"
#include "surface/surface.h"

namespace ga_symmetry {

struct PartneredSurface {
  /// @throws InvalidOption  as check_partners  @throws InvalidMesh  as make_surface
  PartneredSurface(const TriangleMesh& mesh, const Partners& given)
      : surface((check_partners(given, mesh), make_surface(mesh))) {
    const std::vector<int>& index = surface.surface_vertex;
    for (const int m : surface.mesh_vertex) {
      partners.partner.push_back(given.partner[m] < 0 ? -1 : index[given.partner[m]]);
      partners.fitness.push_back(given.fitness[m]);
      partners.side.push_back(given.side[m]);
      if (given.side[m] != 0) has_sides = true;
    }
  }
  Surface surface;
  Partners partners;  ///< as the surface numbers its vertices
  bool has_sides = false;
};

}  // namespace ga_symmetry
