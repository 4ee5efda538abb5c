// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the joint search share: a creature with its tables, and random maps over it.
#pragma once
#include "search/map_cost.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {

/// A surface with 40 samples among 120 sites, and its true symmetry where it has one.
struct SearchScene {
  shapes::Symmetric shape;
  Surface surface;
  GeodesicSolver solver;
  Sites sites;

  explicit SearchScene(shapes::Symmetric s)
      : shape(std::move(s)),
        surface(make_surface(shape.mesh)),
        solver(surface),
        sites(make_sites(surface, solver, {40, 120, 6}, 1)) {}

  MapCost cost(const JointOptions& options = {}, SymmetryKind kind = SymmetryKind::reflection,
               const SurfaceReferences& references = {}) const {
    const Anchors anchors = make_anchors(references, kind, solver, 1);
    return MapCost(sites, kind, make_unary_costs(sites, surface.unit(), anchors, options),
                   make_cost_weights(options, kind, surface.orientable));
  }

  SampleMap random_map(Random& random) const {
    SampleMap map(sites.samples);
    for (int& site : map) site = static_cast<int>(draw_below(random, sites.count()));
    return map;
  }
  SampleMap random_map(std::uint64_t seed) const {
    Random random(seed);
    return random_map(random);
  }

  SampleMap identity() const {
    SampleMap map(sites.samples);
    for (int i = 0; i < sites.samples; ++i) map[i] = i;
    return map;
  }

  /// Each sample to the site nearest to its true partner.
  SampleMap truth() const {
    SampleMap map(sites.samples, 0);
    for (int i = 0; i < sites.samples; ++i)
      for (int k = 1; k < sites.count(); ++k) {
        const int partner = shape.partner[sites.vertex[i]];
        if (sites.field(k, partner) < sites.field(map[i], partner)) map[i] = k;
      }
    return map;
  }

  SurfaceReferences references() const { return {{shape.axis[0], shape.axis[1]}, {{shape.pair[0], shape.pair[1]}}}; }
};

/// Bent and renumbered; made once, as tests only read it.
inline const SearchScene& search_scene() {
  static const SearchScene scene(shapes::shuffled(shapes::bent(shapes::creature(3), 0.1), 7));
  return scene;
}

/// The identity fits where orientation does not count.
inline JointOptions without_orientation() {
  JointOptions options;
  options.orientation_weight = 0;
  return options;
}

}  // namespace ga_symmetry
