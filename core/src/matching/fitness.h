// SPDX-License-Identifier: GPL-3.0-or-later
// How far a partner may be off, where the truth is not known.
#pragma once
#include <vector>

#include "matching/dense_map.h"
#include "matching/matching.h"

namespace ga_symmetry {

/// Per vertex, in units, >= 0: how far the partner's partner is from the vertex (reflections), how far apart distances
/// and eigenfunctions see the partner, how much the map stretches the edges around it, and what the residual says;
/// averaged over the neighbourhood, because errors are smooth. Distances between partners are those of the landmarks'
/// fields, a lower bound that is tight where landmarks are dense.
std::vector<double> vertex_fitness(const Matching& matching, const DenseMap& map, HeatDiffusion& diffusion);

}  // namespace ga_symmetry
