// SPDX-License-Identifier: GPL-3.0-or-later
// The named baseline: vcglib's own geodesic distance.
#pragma once
// In this order: the other headers of vcglib need the first.
#include <vcg/complex/complex.h>
//
#include <vcg/complex/algorithms/geodesic.h>
#include <vcg/complex/algorithms/update/topology.h>

#include <vector>

#include "surface/surface.h"

namespace ga_symmetry::baseline {

class Vertex;
class Face;
struct Types : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
class Vertex : public vcg::Vertex<Types, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::Qualityf,
                                  vcg::vertex::VFAdj, vcg::vertex::BitFlags> {};
class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::VFAdj, vcg::face::BitFlags> {};
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

/// vcg::tri::Geodesic on a surface of ours. Not thread-safe.
class VcgGeodesic {
 public:
  explicit VcgGeodesic(const Surface& s) {
    using Add = vcg::tri::Allocator<Mesh>;
    Add::AddVertices(mesh_, s.vertices());
    for (int v = 0; v < s.vertices(); ++v)
      for (int k = 0; k < 3; ++k) mesh_.vert[v].P()[k] = static_cast<float>(s.point(v)[k]);
    Add::AddFaces(mesh_, s.triangles());
    for (int c = 0; c < 3 * s.triangles(); ++c) mesh_.face[c / 3].V(c % 3) = &mesh_.vert[s.triangle[c]];
    vcg::tri::UpdateTopology<Mesh>::VertexFace(mesh_);
  }

  /// Distance from `source` to every vertex, written to out[0 .. vertices).
  void field(int source, float* out) {
    vcg::tri::EuclideanDistance<Mesh> metric;
    vcg::tri::Geodesic<Mesh>::Compute(mesh_, {&mesh_.vert[source]}, metric);
    for (std::size_t v = 0; v < mesh_.vert.size(); ++v) out[v] = mesh_.vert[v].Q();
  }

 private:
  Mesh mesh_;
};

}  // namespace ga_symmetry::baseline
