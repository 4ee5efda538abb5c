// SPDX-License-Identifier: GPL-3.0-or-later
// The user's references on the surface that is searched, with their distances: computed once, for all stages.
#pragma once
#include <array>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "geodesics/geodesics.h"

namespace ga_symmetry {

/// References whose indices are vertices of a surface, not of the mesh.
struct SurfaceReferences {
  std::vector<int> axis;                  ///< on the symmetry axis: the symmetry does not move them
  std::vector<std::array<int, 2>> pairs;  ///< {l, r}: the symmetry takes l to r
};

/// What is known of a symmetry beforehand: it takes vertex from.vertex[i] to image.vertex[i].
struct Anchors {
  Landmarks from, image;
  int count() const { return static_cast<int>(from.vertex.size()); }
};

/// The axis references, each its own image, then the pairs; a reflection takes a pair both ways. Sorted, so that the
/// order in which the user names them changes nothing. The field of each reference is computed once. @throws
/// InvalidOption, Cancelled
Anchors make_anchors(const SurfaceReferences& references, SymmetryKind kind, const GeodesicSolver& solver, int threads,
                     const Context& context = {});

}  // namespace ga_symmetry
