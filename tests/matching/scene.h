// SPDX-License-Identifier: GPL-3.0-or-later
// A creature with everything that matching on it needs, and its true partners.
#pragma once
#include <vector>

#include "geodesics/sampling.h"
#include "matching/matching.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {

struct MatchingScene {
  shapes::Symmetric shape;
  Surface surface = make_surface(shape.mesh);
  GeodesicSolver solver{surface};
  FieldCache fields{solver};
  Shortcuts shortcuts;
  HeatDiffusion diffusion{surface};
  CurvatureFeatures curvature = curvature_features(surface, diffusion);

  explicit MatchingScene(shapes::Symmetric of) : shape(std::move(of)) {}

  Matching matching(int landmarks, int fixed = 0) const {
    return {surface, fields, shortcuts, curvature, evenly_spaced_samples(surface, solver, landmarks, 1), fixed, true};
  }
  Images images(const std::vector<int>& vertices) const { return {vertices, solver.fields(vertices, 1)}; }
  /// The true images of landmarks.
  Images truth(const Landmarks& landmarks) const {
    std::vector<int> vertices;
    for (const int v : landmarks.vertex) vertices.push_back(shape.partner[v]);
    return images(vertices);
  }
  /// Mean distance, in units, between a map of all vertices and the truth, over every 7th vertex.
  double error(const std::vector<int>& partner) const {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < surface.vertices(); v += 7, ++count)
      sum += solver.fields({shape.partner[v]}, 1)(0, partner[v]) / surface.unit();
    return sum / count;
  }
};

/// 2562 vertices, in no order.
inline const MatchingScene& creature_scene() {
  static const MatchingScene made(shapes::shuffled(shapes::creature(4), 5));
  return made;
}

}  // namespace ga_symmetry
