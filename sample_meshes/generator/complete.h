// SPDX-License-Identifier: GPL-3.0-or-later
// One fundamental piece and a symmetry group make the whole mesh, vertex by vertex and face by face.
#pragma once
#include "mesh.h"

namespace samples {

struct Symmetric {
  Mesh mesh;
  std::vector<std::vector<int>> image;  ///< image[g][v]: the vertex to which group element g takes vertex v
};

/// Joins the images of `piece` along its border. Checks what it promises: every group element maps vertices onto
/// vertices at exactly the image position, and faces onto faces.
Symmetric complete(const Mesh& piece, const std::vector<Eigen::Matrix3d>& group);

}  // namespace samples
