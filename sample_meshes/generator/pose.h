// SPDX-License-Identifier: GPL-3.0-or-later
// Bending a shape by joints whose effect fades in smoothly across the joint.
#pragma once
#include <vector>

#include "mesh.h"

namespace samples {

/// 0 behind a plane, 1 in front of it, smooth over `half_width` on both sides.
struct Ramp {
  Vec3 point, direction;  ///< direction: unit length
  double half_width;      ///< > 0
  double at(const Vec3& p) const;
};

/// A turn by `degrees` about `axis` through `centre`. A point turns by the product of the ramps at its rest position,
/// so a limb bends round like a hose, keeps its girth, and stays continuous with the body.
struct Joint {
  Vec3 centre;
  std::vector<Ramp> ramps;
  Vec3 axis = Vec3::UnitX();  ///< unit length
  double degrees = 0;
};

/// Turns by degrees about z, then y, then x, as one turn.
Joint joint(const Vec3& centre, std::vector<Ramp> ramps, const Vec3& degrees_xyz);

/// The same joint seen in the mirror x -> -x.
Joint mirrored(const Joint& joint);

/// The same joint turned about the z axis.
Joint turned(const Joint& joint, double degrees);

using Pose = std::vector<Joint>;  ///< from the tips to the root: a joint carries what was bent before

std::vector<Vec3> bend(const Pose& pose, const std::vector<Vec3>& rest);

}  // namespace samples
