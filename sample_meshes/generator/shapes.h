// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes: what they look like at rest, which symmetries they have, and how they are posed.
#pragma once
#include <string>
#include <vector>

#include "field.h"
#include "pose.h"

namespace samples {

struct NamedPose {
  std::string name;
  Pose joints;
};

/// A solid with a finite symmetry group and no other symmetry.
struct Shape {
  std::string name;
  Field field;
  std::vector<Eigen::Matrix3d> group;  ///< all symmetries; group[0] is the identity
  int generator = 1;                   ///< the element whose partners are the truth: the mirror, or the third of a turn
  Eigen::Matrix3d lattice;             ///< columns: axes of the fundamental piece, which is where both first two
                                       ///< coordinates are >= 0 (only the first where `half_space`)
  bool half_space = true;
  bool seam_is_mirror = true;    ///< false: the two cut faces of the piece are images of each other
  int vertices = 4000;           ///< wanted, whole shape
  int low_poly = 0;              ///< > 0: so many vertices are left of those, whole shape
  std::vector<NamedPose> poses;  ///< the last one is remeshed
};

Shape person();
/// What a person wears: parts of their own, which the body goes through.
struct Garment {
  Shape shape;
  bool pair = false;   ///< the shape is the left one of two
  bool worn = true;    ///< what of it is inside the body is left out
  bool alone = false;  ///< it has no counterpart
};
std::vector<Garment> garments();
std::vector<NamedPose> dressed_poses();
Shape animal();
/// Three arms on a hub; a third of a turn and three mirrors.
Shape trefoil();
/// Three arms on a hub, bent one way and with a thumb each; a third of a turn only.
Shape pinwheel();

}  // namespace samples
