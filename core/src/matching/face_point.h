// SPDX-License-Identifier: GPL-3.0-or-later
// The point on faces that matches best, where vertices have rows of numbers that are linear over a face.
#pragma once
#include <algorithm>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// The point on the faces around `c` whose interpolated row is nearest to the wanted one.
/// @param row  row(v) points to the numbers of vertex v  @param wanted, weight  as many
template <class Row>
SurfacePoint nearest_on_faces(const Surface& surface, const Row& row, int dimension, const float* weight,
                              const float* wanted, int c) {
  SurfacePoint best{{c, c, c}, {1, 0, 0}};
  const float* origin = row(c);
  double least = 0;
  for (int k = 0; k < dimension; ++k) {
    const double r = wanted[k] - origin[k];
    least += weight[k] * r * r;
  }
  for (int i = surface.first_corner[c]; i < surface.first_corner[c + 1]; ++i) {
    const int a = surface.triangle[next_corner(surface.corner_at[i])];
    const int b = surface.triangle[previous_corner(surface.corner_at[i])];
    const float *fa = row(a), *fb = row(b);
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0, rr = 0;
    for (int k = 0; k < dimension; ++k) {
      const double w = weight[k], r = wanted[k] - origin[k], x = fa[k] - origin[k], y = fb[k] - origin[k];
      aa += w * x * x, ab += w * x * y, bb += w * y * y, ra += w * r * x, rb += w * r * y, rr += w * r * r;
    }
    const auto consider = [&](double s, double t) {
      if (s < 0 || t < 0 || s + t > 1) return;
      const double e = rr - 2 * (s * ra + t * rb) + s * s * aa + 2 * s * t * ab + t * t * bb;
      if (e < least) least = e, best = {{c, a, b}, {1 - s - t, s, t}};
    };
    const double determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * aa * bb) consider((ra * bb - rb * ab) / determinant, (rb * aa - ra * ab) / determinant);
    if (aa > 0) consider(std::clamp(ra / aa, 0.0, 1.0), 0);
    if (bb > 0) consider(0, std::clamp(rb / bb, 0.0, 1.0));
    const double along = aa - 2 * ab + bb;  // on the edge a-b: origin moved to a
    if (along > 0) {
      const double t = std::clamp(((rb - ra) - (ab - aa)) / along, 0.0, 1.0);
      consider(1 - t, t);
    }
  }
  return best;
}

}  // namespace ga_symmetry
