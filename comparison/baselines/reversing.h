// SPDX-License-Identifier: GPL-3.0-or-later
// A symmetry as the functional map that keeps descriptors and reverses orientation.
#pragma once
#include "baselines/spectral.h"

namespace ga_symmetry::baselines {

struct ReversingOptions {
  int functions = 10;       ///< of the map, [2, those of the spectrum]
  int energies = 100;       ///< of the wave kernel signature
  int every = 10;           ///< one in so many is a descriptor
  double descriptors = 1;   ///< weight of keeping them
  double products = 1;      ///< of commuting with the multiplication by each
  double laplacian = 1e-3;  ///< of commuting with the Laplacian
  double orientation = 1;   ///< of anticommuting with the derivative along each one's level lines
};

/// The orthogonal map nearest to the least squares solution of all of these; nothing else is told, so it needs no
/// references and finds one map.
/// @param surface  orientable
/// @return orthogonal map of options.functions
/// Source: Ren, Poulenard, Wonka & Ovsjanikov, Continuous and orientation-preserving correspondences via functional
/// maps, 2018: the operator and its sign; multiplication: Nogneng & Ovsjanikov 2017. Differs: the orthogonal map
/// and ten functions, with which ZoomOut is right on more of 8 of the meshes of docs/comparison.md than with 20 and the
/// solution as it is.
FunctionalMap reversing_map(const Surface& surface, const Spectrum& spectrum, const ReversingOptions& options);

}  // namespace ga_symmetry::baselines
