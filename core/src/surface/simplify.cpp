// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/simplify.h"

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

// A first, cheap thinning in linear time, where quadrics would spend theirs on detail that is far below the proxy's
// resolution: edges much shorter than `length` are collapsed onto one of their ends, so no vertex leaves the surface.
// Nothing folds over, no border is touched, and the surface stays a manifold.
void thin_out(SimplifiedMesh& mesh, double length, int vertices, const Context& context) {
  using Ring = vcg::face::VFIterator<SimplifiedFace>;
  const auto keeps_manifold = [&](SimplifiedVertex* gone, SimplifiedVertex* kept) {  // exactly two common neighbours
    vcg::tri::UnMarkAll(mesh);
    for (Ring r(gone); !r.End(); ++r) {
      vcg::tri::Mark(mesh, r.V1());
      vcg::tri::Mark(mesh, r.V2());
    }
    int common = 0;
    for (Ring r(kept); !r.End(); ++r)
      for (SimplifiedVertex* w : {r.V1(), r.V2()})
        if (vcg::tri::IsMarked(mesh, w)) ++common, w->IMark() = mesh.imark - 1;
    return common == 2;
  };
  const auto folds = [](SimplifiedVertex* gone, SimplifiedVertex* kept) {
    constexpr double kLeastCosine = 0.5;
    for (Ring r(gone); !r.End(); ++r) {
      if (r.V1() == kept || r.V2() == kept) continue;
      const vcg::Point3d &a = r.V1()->cP(), edge = r.V2()->cP() - a;
      const vcg::Point3d before = edge ^ (gone->cP() - a), after = edge ^ (kept->cP() - a);
      if (before * after <= kLeastCosine * before.Norm() * after.Norm()) return true;
      if (after.Norm() < 0.05 * edge.SquaredNorm()) return true;  // a needle
    }
    return false;
  };
  const int start = mesh.vn;
  for (int before = mesh.vn + 1; mesh.vn > vertices && mesh.vn < before;) {
    before = static_cast<int>(0.98 * mesh.vn);  // the next round is not worth it if this one takes less away
    for (std::size_t f = 0; f < mesh.face.size() && mesh.vn > vertices; ++f) {
      if (f % 65536 == 0) context.report(static_cast<double>(start - mesh.vn) / (start - vertices), "simplifying");
      for (int k = 0; k < 3 && !mesh.face[f].IsD(); ++k) {
        SimplifiedVertex *gone = mesh.face[f].V(k), *kept = mesh.face[f].V((k + 1) % 3);
        if (gone->IsB() || !gone->IsW() || !kept->IsW() ||
            vcg::SquaredDistance(gone->cP(), kept->cP()) > length * length)
          continue;
        if (!keeps_manifold(gone, kept) || folds(gone, kept)) continue;
        VertexPair pair(gone, kept);
        vcg::tri::EdgeCollapser<SimplifiedMesh, VertexPair>::Do(mesh, pair, kept->P());
      }
    }
  }
  vcg::tri::Allocator<SimplifiedMesh>::CompactEveryVector(mesh);
}

}  // namespace

Surface simplified(const Surface& s, int vertices, const Context& context) {
  context.report(0, "simplifying");
  SimplifiedMesh mesh;
  vcg::tri::Allocator<SimplifiedMesh>::AddVertices(mesh, s.vertices());
  vcg::tri::Allocator<SimplifiedMesh>::AddFaces(mesh, s.triangles());
  context.report(0, "simplifying");
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
  constexpr int kThinned = 5;  // times the wanted vertices are left to the quadrics
  const int thinned = kThinned * vertices;
  constexpr double kBegun = 0.5;  // progress, of a mesh that is thinned first
  const Context rest = context.part(mesh.vn > thinned ? kBegun : 0, 1);
  if (mesh.vn > thinned) {
    thin_out(mesh, std::sqrt(s.area / thinned), thinned, context.part(0, kBegun));
    vcg::tri::UpdateTopology<SimplifiedMesh>::VertexFace(mesh);
  }
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
