// SPDX-License-Identifier: GPL-3.0-or-later
// Matching by what a vertex looks like: the feature-based symmetry detection that the paper compares itself with.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "baselines/spectrum.h"
#include "geodesics/geodesics.h"
#include "surface/surface.h"

namespace ga_symmetry::baselines {

/// Wave kernel signatures: vertices x energies. Energies and their width are those of Aubry, Schlickewei & Cremers
/// 2011: evenly spaced in the logarithm of the eigenvalues. @param energies  >= 2
Eigen::MatrixXd wave_kernel_signature(const Spectrum& spectrum, int energies);

/// vertices x features: the average geodesic distance, and the wave kernel signature at 100 energies. Each feature has
/// mean 0 and the whole of the signature counts as much as the distance.
/// Source: Kim, Lipman, Chen & Funkhouser 2010 (average geodesic distance); Aubry, Schlickewei & Cremers 2011 (wave
/// kernel signature). Differs: the average is taken over the patches of 100 evenly spaced samples.
/// @param spectrum  of the surface
Eigen::MatrixXd symmetry_features(const Surface& surface, const GeodesicSolver& solver, const Spectrum& spectrum,
                                  int threads);

/// Each vertex's nearest neighbour by features on the other side; a vertex on the axis is its own partner.
/// @param side  +1, 0, -1 per vertex, as split_sides returns it
std::vector<int> match_across(const Eigen::MatrixXd& features, const std::vector<int>& side, int threads);

}  // namespace ga_symmetry::baselines
