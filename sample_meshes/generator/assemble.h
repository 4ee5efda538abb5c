// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as people have them: characters of several parts with texture seams, few polygons, scans with debris.
#pragma once
#include "sample.h"
#include "shapes.h"

namespace samples {

/// The person with eyes, in clothes, and with a bag on one shoulder, which has no counterpart; parts, seams, and
/// vertices in random order.
Sample dressed(const NamedPose& pose, ga_symmetry::Random& random);

/// A shape of less than 300 vertices.
Sample low_poly(const Shape& shape, const NamedPose& pose, ga_symmetry::Random& random);

/// The noise of a scanner, and pieces that float around, which have no counterpart; vertices in random order.
Sample scanned_with_debris(const Sample& sample, ga_symmetry::Random& random);

/// Vertices and their images, posed, with faces that are not symmetric.
Sample posed(const std::string& name, const Mesh& rest, std::vector<int> partner, const NamedPose& pose,
             ga_symmetry::Random& random);

}  // namespace samples
