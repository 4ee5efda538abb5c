// SPDX-License-Identifier: GPL-3.0-or-later
// The cotangent Laplacian of a surface and its lowest eigenfunctions.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>

#include "ga_symmetry/context.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// Pinkall and Polthier 1993. Cotangents are clamped to [0, 20]: diffusion keeps to the range of its source, and
/// needles do not dominate what is around them.
struct Laplacian {
  Eigen::SparseMatrix<double> stiffness;  ///< symmetric, rows sum to 0, >= 0
  Eigen::SparseMatrix<double> mass;       ///< diagonal: the area of each vertex's cell
};
Laplacian cotangent_laplacian(const Surface& surface);

/// Calls body(corner, half the cotangent of its angle), that of the edge opposite of the corner; clamped to [-20, 20].
template <class Body>
void for_each_cotangent(const Surface& s, const Body& body) {
  constexpr double kMaxCotangent = 20;
  for (int corner = 0; corner < 3 * s.triangles(); ++corner) {
    const Eigen::Vector3d p(s.point(s.triangle[corner])),
        u = Eigen::Vector3d(s.point(s.triangle[next_corner(corner)])) - p,
        w = Eigen::Vector3d(s.point(s.triangle[previous_corner(corner)])) - p;
    body(corner, 0.5 * std::clamp(u.dot(w) / u.cross(w).norm(), -kMaxCotangent, kMaxCotangent));
  }
}

/// The eigenfunctions of the lowest eigenvalues, lowest first: vertices x count, orthonormal over the area, which
/// counts as 1. By Rayleigh-Ritz on a block Krylov space of the inverse (Golub and Underwood 1977). Of an eigenvalue
/// that is more than fourfold, as a sphere has them, some may be missing.
/// @param count  >= 1; fewer come back where the surface has fewer than twice as many vertices
/// @throws Cancelled
Eigen::MatrixXf eigenfunctions(const Surface& surface, int count, int threads, const Context& context = {});

}  // namespace ga_symmetry
