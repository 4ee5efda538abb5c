// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets: what of a surface hangs together over edges. A fin is one, though it shares vertices with what it stands on.
#pragma once
#include <vector>

#include "surface/surface.h"

namespace ga_symmetry {

struct Sheets {
  explicit Sheets(const Surface& surface);
  int count() const { return static_cast<int>(area.size()); }
  std::vector<int> of_face;  ///< per face: its sheet
  std::vector<double> area;  ///< per sheet
};

}  // namespace ga_symmetry
