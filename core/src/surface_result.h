// SPDX-License-Identifier: GPL-3.0-or-later
// What was found on a surface, and how it becomes the result of the mesh.
#pragma once
#include <optional>
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/mirror_plane.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// All vertices are those of one surface, not of the mesh.
struct SurfaceResult {
  std::vector<int> partner;         ///< per vertex, -1 = none
  std::vector<double> fitness;      ///< per vertex, >= 0
  std::vector<SurfacePoint> point;  ///< per vertex: the partner on a face
  std::vector<int> side;            ///< per vertex where the method tells them; else empty, and `left_right` tells them
  std::vector<float> left_right;    ///< per vertex: how much nearer to the left than to the right; empty for a rotation
  std::vector<SymmetricPair> pairs;       ///< the samples and their partners
  std::vector<FoundSymmetry> symmetries;  ///< distinct ones, best first
  SymmetryKind kind = SymmetryKind::reflection;
  int order = 2;          ///< of the one taken
  double confidence = 1;  ///< as Result::confidence
  std::vector<GenerationLog> log;
  StopReason stop = StopReason::max_generations;
  std::optional<MirrorPlane> mirror;  ///< mirrors the surface as it stands, with the same partners
  std::vector<std::string> warnings;
};

/// What was found on the mesh's surface, in the mesh's own vertices, with what follows from it: means, counts.
/// @param axis         of the surface
/// @param max_fitness  a vertex above has no partner; 0 = keep all
Result to_mesh(SurfaceResult found, std::vector<std::vector<SurfacePoint>> axis, const Surface& surface,
               double max_fitness);

}  // namespace ga_symmetry
