// The sides and the axis of a reflection, from how much nearer each vertex is to the left.
#pragma once
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

struct Division {
  std::vector<int> side;                        ///< per vertex: +1 left, 0 on the axis, -1 right
  std::vector<std::vector<SurfacePoint>> axis;  ///< polylines on the faces, longest first; closed ones repeat a point
};

/// @param left_right  per vertex, > 0 nearer to the left, as connect_sides leaves it
Division divide(const Surface& surface, const std::vector<float>& left_right);

}  // namespace ga_symmetry
