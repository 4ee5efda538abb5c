// SPDX-License-Identifier: GPL-3.0-or-later
// The front door: a mesh and options in, partners out.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/options.h"
#include "ga_symmetry/result.h"

/// Intrinsic symmetry of triangle meshes.
namespace ga_symmetry {

/// Finds for every vertex its partner under an intrinsic symmetry.
/// @throws InvalidMesh    if the mesh has no faces, an index out of range or coordinates that are not finite; if no
///                        symmetry is found
/// @throws InvalidOption  as check_options; if a reference is not on the mesh; a rank beyond the symmetries found
/// @throws Cancelled      if the context asked to stop
Result find_symmetry(const TriangleMesh& mesh, const Options& options = {}, const Context& context = {});

/// The distinct symmetries of both kinds that the joint search finds, best first; those whose score is more than twice
/// the best one's are left out; the n-th of its kind here is that of rank n there. Some options do not matter, and say
/// nothing: `idle_options(options, true)`.
/// @throws as find_symmetry
std::vector<FoundSymmetry> list_symmetries(const TriangleMesh& mesh, Options options = {}, const Context& context = {});

}  // namespace ga_symmetry
