// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sheets.h"

namespace ga_symmetry {

Sheets::Sheets(const Surface& s) : of_face(s.triangles(), -1) {
  std::vector<int> open;
  for (int first = 0; first < s.triangles(); ++first) {
    if (of_face[first] >= 0) continue;
    of_face[first] = count();
    area.push_back(0);
    open.assign(1, first);
    while (!open.empty()) {
      const int f = open.back();
      open.pop_back();
      area.back() += s.face_area(f);
      for (int k = 0; k < 3; ++k) {
        const int across = s.opposite[3 * f + k];
        if (across < 0 || of_face[across / 3] >= 0) continue;
        of_face[across / 3] = of_face[first];
        open.push_back(across / 3);
      }
    }
  }
}

}  // namespace ga_symmetry
