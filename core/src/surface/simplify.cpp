// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/simplify.h"

#include <meshoptimizer.h>
#include <vcg/complex/algorithms/clean.h>
#include <vcg/complex/algorithms/local_optimization.h>
#include <vcg/complex/algorithms/local_optimization/tri_edge_collapse_quadric.h>
#include <vcg/complex/complex.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

class SimplifiedVertex;
class SimplifiedFace;
struct SimplifiedTypes
    : vcg::UsedTypes<vcg::Use<SimplifiedVertex>::AsVertexType, vcg::Use<SimplifiedFace>::AsFaceType> {};
class SimplifiedVertex : public vcg::Vertex<SimplifiedTypes, vcg::vertex::VFAdj, vcg::vertex::Coord3d,
                                            vcg::vertex::Normal3d, vcg::vertex::Mark, vcg::vertex::BitFlags> {
 public:
  vcg::math::Quadric<double>& Qd() { return quadric_; }

 private:
  vcg::math::Quadric<double> quadric_;
};
class SimplifiedFace : public vcg::Face<SimplifiedTypes, vcg::face::VFAdj, vcg::face::VertexRef, vcg::face::Normal3d,
                                        vcg::face::BitFlags> {};
class SimplifiedMesh : public vcg::tri::TriMesh<std::vector<SimplifiedVertex>, std::vector<SimplifiedFace>> {};
using VertexPair = vcg::tri::BasicVertexPair<SimplifiedVertex>;
class Collapse : public vcg::tri::TriEdgeCollapseQuadric<SimplifiedMesh, VertexPair, Collapse,
                                                         vcg::tri::QInfoStandard<SimplifiedVertex>> {
 public:
  using Base =
      vcg::tri::TriEdgeCollapseQuadric<SimplifiedMesh, VertexPair, Collapse, vcg::tri::QInfoStandard<SimplifiedVertex>>;
  Collapse(const VertexPair& pair, int mark, vcg::BaseParameterClass* parameters) : Base(pair, mark, parameters) {}
};

// A first thinning, fast, by the quadrics of all faces; vertices are left out, none is moved. Its faces may be slivers
// on flat parts, which is why it does not go all the way.
Surface thinned(const Surface& s, int vertices, const Context& context) {
  const std::vector<float> position(s.position.begin(), s.position.end());
  const std::vector<unsigned int> triangle(s.triangle.begin(), s.triangle.end());
  std::vector<unsigned int> left(triangle.size());
  const auto wanted = static_cast<std::size_t>(3.0 * s.triangles() * vertices / s.vertices());
  constexpr float kAnyError = 1;  // of the extent
  left.resize(meshopt_simplify(left.data(), triangle.data(), triangle.size(), position.data(), s.vertices(),
                               3 * sizeof(float), wanted, kAnyError, 0, nullptr));
  if (context.cancelled()) throw Cancelled();
  std::vector<int> index(s.vertices(), -1), corners;
  std::vector<double> places;
  for (const unsigned int v : left) {
    if (index[v] < 0) {
      index[v] = static_cast<int>(places.size() / 3);
      places.insert(places.end(), s.point(static_cast<int>(v)), s.point(static_cast<int>(v)) + 3);
    }
    corners.push_back(index[v]);
  }
  return surface_of(std::move(places), std::move(corners), context);
}

}  // namespace

Surface simplified(const Surface& surface, int vertices, const Context& context) {
  constexpr int kThinned = 2;     // times the wanted vertices are left to vcglib's quadrics, which take longer
  constexpr double kBegun = 0.5;  // progress, of a mesh that is thinned first
  context.report(0, "simplifying");
  const bool thin = surface.vertices() > kThinned * vertices;
  Surface few;
  if (thin) few = thinned(surface, kThinned * vertices, context.part(0, kBegun));
  const Surface& s = thin ? few : surface;
  const Context rest = context.part(thin ? kBegun : 0, 1);
  SimplifiedMesh mesh;
  vcg::tri::Allocator<SimplifiedMesh>::AddVertices(mesh, s.vertices());
  vcg::tri::Allocator<SimplifiedMesh>::AddFaces(mesh, s.triangles());
  for (int v = 0; v < s.vertices(); ++v) mesh.vert[v].P() = {s.point(v)[0], s.point(v)[1], s.point(v)[2]};
  for (std::size_t c = 0; c < s.triangle.size(); ++c) mesh.face[c / 3].V(c % 3) = &mesh.vert[s.triangle[c]];
  for (std::size_t c = 0; c < s.triangle.size(); ++c)
    if (s.opposite[c] < 0) {
      mesh.vert[s.triangle[next_corner(static_cast<int>(c))]].SetB();
      mesh.vert[s.triangle[previous_corner(static_cast<int>(c))]].SetB();
    }
  // Vertices of many faces stay as they are: each collapse beside them would look at all of those faces.
  constexpr int kManyFaces = 64;
  for (int v = 0; v < s.vertices(); ++v)
    if (s.first_corner[v + 1] - s.first_corner[v] > kManyFaces) mesh.vert[v].ClearW();
  vcg::tri::UpdateTopology<SimplifiedMesh>::VertexFace(mesh);
  vcg::tri::UpdateNormal<SimplifiedMesh>::PerVertexNormalizedPerFaceNormalized(mesh);
  vcg::tri::TriEdgeCollapseQuadricParameter parameters;
  parameters.PreserveTopology = true;
  parameters.PreserveBoundary = true;
  parameters.NormalCheck = true;
  parameters.UseArea = false;        // vcglib of 2020.09 weighs faces by the square of the area, 2025.07 by the area
  parameters.QualityQuadric = true;  // distances want triangles of good shape on flat parts too
  parameters.QualityQuadricWeight = 0.02;
  static std::mutex one_at_a_time;  // vcglib keeps the session's state in static variables
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  rest.report(0, "simplifying");
  vcg::LocalOptimization<SimplifiedMesh> session(mesh, &parameters);
  session.Init<Collapse>();
  const int start = mesh.vn;
  session.SetTargetVertices(vertices);
  session.SetTimeBudget(0.2f);
  while (session.DoOptimization() && mesh.vn > vertices)
    rest.report(static_cast<double>(start - mesh.vn) / std::max(1, start - vertices), "simplifying");
  session.Finalize<Collapse>();
  vcg::tri::Allocator<SimplifiedMesh>::CompactEveryVector(mesh);
  std::vector<double> position;
  std::vector<int> triangle;
  for (const SimplifiedVertex& v : mesh.vert) position.insert(position.end(), {v.cP()[0], v.cP()[1], v.cP()[2]});
  for (const SimplifiedFace& f : mesh.face)
    for (int k = 0; k < 3; ++k) triangle.push_back(static_cast<int>(f.cV(k) - mesh.vert.data()));
  return surface_of(std::move(position), std::move(triangle), context);
}

}  // namespace ga_symmetry
