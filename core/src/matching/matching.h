// SPDX-License-Identifier: GPL-3.0-or-later
// What the partners of all vertices are found with, once the samples have theirs.
#pragma once
#include "geodesics/field_cache.h"
#include "geodesics/shortcuts.h"
#include "surface/curvature.h"
#include "surface/mirror_plane.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// A surface, what is measured of it, and the landmarks whose images under one symmetry are looked for or known.
/// What it refers to must outlive it.
struct Matching {
  const Surface& surface;
  const FieldCache& fields;
  const Shortcuts& shortcuts;            ///< through what is missing of the surface
  const CurvatureFeatures& curvature;    ///< of all vertices
  Landmarks landmarks;                   ///< the samples, then the user's references
  int fixed = 0;                         ///< so many landmarks at the end have images that are exact: the references'
  bool reflection = true;                ///< a reflection also takes images to landmarks, and mirrors directions
  const MirrorPlanes* planes = nullptr;  ///< that mirror the surface as it stands; null = not looked for

  int count() const { return static_cast<int>(landmarks.vertex.size()); }
  int movable() const { return count() - fixed; }
  float unit() const { return static_cast<float>(surface.unit()); }
};

/// Where the landmarks go: image i is that of landmark i, with the distance field of each.
using Images = Landmarks;

}  // namespace ga_symmetry
