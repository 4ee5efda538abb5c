// SPDX-License-Identifier: GPL-3.0-or-later
// A bent creature whose partners and sides are known by construction.
#pragma once
#include "ga_symmetry/partners.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {

constexpr int kLevel = 4;  // 2562 vertices

// The creature is mirrored in x: left is where x > 0 before any bending.
inline Partners partners_of(const shapes::Symmetric& shape) {
  Partners out;
  out.partner = shape.partner;
  out.fitness.assign(shape.partner.size(), 0.0);
  for (std::size_t v = 0; v < shape.partner.size(); ++v)
    out.side.push_back(shape.partner[v] == static_cast<int>(v) ? 0 : shape.mesh.position[3 * v] > 0 ? 1 : -1);
  return out;
}

struct Creature {
  shapes::Symmetric straight = shapes::shuffled(shapes::creature(kLevel), 5);
  TriangleMesh mesh = shapes::bent(straight, 0.3).mesh;
  Partners partners = partners_of(straight);
};

inline const Creature& creature() {
  static const Creature shared;
  return shared;
}

}  // namespace ga_symmetry
