#include "axis/divide.h"

#include "axis/sides.h"
#include "axis/zero_set.h"

namespace ga_symmetry {

Division divide(const Surface& surface, const std::vector<float>& left_right) {
  // Of the total length. Lines of a closed surface are all of the axis, however short beside the others; at a border,
  // where stray pieces stay, so short a line is one of theirs.
  constexpr double kShortest = 0.05;
  return {sides(surface, left_right), zero_set(surface, left_right, kShortest)};
}

}  // namespace ga_symmetry
