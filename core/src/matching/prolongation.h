// SPDX-License-Identifier: GPL-3.0-or-later
// From the partners on the searched surface to a partner for every vertex of the mesh.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "surface/mirror_plane.h"
#include "surface/search_surface.h"
#include "surface_result.h"

namespace ga_symmetry {

/// What was found on the searched surface, at every vertex of the mesh's own (prolongation, as between the levels of
/// multigrid). Around each of its vertices the map is close to a rigid motion with (reflections) or without a mirror;
/// that takes along every vertex of the mesh near by, on the surface or below it. Its partner is the nearest vertex to
/// where it comes, in the part that is its own part's counterpart.
/// @param reflection  false for a rotation
/// @throws Cancelled
SurfaceResult prolongate(SurfaceResult found, const SearchSurface& search, bool reflection, int threads,
                         const Context& context = {});

/// The same for a mesh that was searched itself: where `found.mirror` takes its vertices, partners are there exactly,
/// wherever the surface is there, and the map agrees or nearly all of the surface is there.
/// @throws Cancelled
void mirror_exactly(SurfaceResult& found, const Surface& surface, int threads, const Context& context = {});

}  // namespace ga_symmetry
