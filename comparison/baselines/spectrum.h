// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenfunctions of a surface's Laplacian, and matching of rows in the spaces that they span.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "surface/surface.h"

namespace ga_symmetry::baselines {

struct Spectrum {
  Eigen::VectorXd value;     ///< ascending, times the surface's area; the first is 0
  Eigen::MatrixXd function;  ///< vertices x functions, orthonormal in the mass matrix of a surface of area 1
};

/// The lowest eigenpairs of the cotangent Laplacian with lumped masses, by shift and invert.
/// @param count  >= 1; fewer where the surface has fewer vertices
/// @throws InvalidMesh  if they do not converge
/// Source: Meyer et al. 2003; Spectra's Lanczos method with implicit restarts.
Spectrum laplacian_spectrum(const Surface& surface, int count);

/// Per row of `queries`: the nearest row of `points`, ties by index. Exact, by matrix products.
/// @param threads  0 = all cores; speed only
std::vector<int> nearest_rows(const Eigen::MatrixXd& queries, const Eigen::MatrixXd& points, int threads);

}  // namespace ga_symmetry::baselines
