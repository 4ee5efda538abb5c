// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh.h"

#include <vcg/complex/algorithms/clean.h>
#include <vcg/complex/algorithms/isotropic_remeshing.h>
#include <vcg/complex/algorithms/local_optimization.h>
#include <vcg/complex/algorithms/local_optimization/tri_edge_collapse_quadric.h>
#include <vcg/complex/complex.h>
#include <vcg/space/index/kdtree/kdtree.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace samples {
namespace {

class V;
class F;
struct Used : vcg::UsedTypes<vcg::Use<V>::AsVertexType, vcg::Use<F>::AsFaceType> {};
class V : public vcg::Vertex<Used, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::Qualityd,
                             vcg::vertex::VFAdj, vcg::vertex::Color4b, vcg::vertex::Mark, vcg::vertex::BitFlags> {
 public:
  vcg::math::Quadric<double>& Qd() { return quadric_; }

 private:
  vcg::math::Quadric<double> quadric_;
};
class F : public vcg::Face<Used, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::Qualityd, vcg::face::FFAdj,
                           vcg::face::VFAdj, vcg::face::Mark, vcg::face::BitFlags> {};
class M : public vcg::tri::TriMesh<std::vector<V>, std::vector<F>> {};

using Pair = vcg::tri::BasicVertexPair<V>;
class Collapse : public vcg::tri::TriEdgeCollapseQuadric<M, Pair, Collapse, vcg::tri::QInfoStandard<V>> {
 public:
  using Base = vcg::tri::TriEdgeCollapseQuadric<M, Pair, Collapse, vcg::tri::QInfoStandard<V>>;
  Collapse(const Pair& pair, int mark, vcg::BaseParameterClass* parameters) : Base(pair, mark, parameters) {}
};

void fill(M& out, const Mesh& mesh) {
  auto v = vcg::tri::Allocator<M>::AddVertices(out, mesh.point.size());
  for (const Vec3& p : mesh.point) (v++)->P() = vcg::Point3d(p.x(), p.y(), p.z());
  auto f = vcg::tri::Allocator<M>::AddFaces(out, mesh.face.size());
  for (const Face& t : mesh.face) {
    for (int k = 0; k < 3; ++k) f->V(k) = &out.vert[t[k]];
    ++f;
  }
}

Mesh read(const M& m) {
  Mesh out;
  for (const V& v : m.vert) out.point.emplace_back(v.cP()[0], v.cP()[1], v.cP()[2]);
  for (const F& f : m.face)
    out.face.push_back({static_cast<int>(f.cV(0) - m.vert.data()), static_cast<int>(f.cV(1) - m.vert.data()),
                        static_cast<int>(f.cV(2) - m.vert.data())});
  return out;
}

double least_angle(const V& a, const V& b, const V& c) {
  const vcg::Point3d p[3] = {a.cP(), b.cP(), c.cP()};
  double least = M_PI;
  for (int k = 0; k < 3; ++k) least = std::min(least, vcg::Angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]));
  return least;
}

}  // namespace

Mesh isotropic_remesh(const Mesh& mesh, double edge, int rounds) {
  M m;
  fill(m, mesh);
  vcg::tri::IsotropicRemeshing<M>::Params params;
  params.SetTargetLen(edge);
  params.maxSurfDist = edge / 2;
  params.iter = rounds;
  params.userSelectedCreases = true;  // none: all shapes are smooth
  vcg::tri::IsotropicRemeshing<M>::Do(m, params);
  vcg::tri::Clean<M>::RemoveUnreferencedVertex(m);
  vcg::tri::Allocator<M>::CompactEveryVector(m);
  return read(m);
}

Mesh decimated(const Mesh& mesh, int vertices) {
  M m;
  fill(m, mesh);
  vcg::tri::UpdateTopology<M>::VertexFace(m);
  vcg::tri::UpdateFlags<M>::VertexBorderFromNone(m);
  vcg::tri::UpdateNormal<M>::PerVertexNormalizedPerFaceNormalized(m);
  vcg::tri::TriEdgeCollapseQuadricParameter params;
  params.PreserveTopology = true;
  params.NormalCheck = true;
  params.BoundaryQuadricWeight = 10;
  params.QualityQuadric = true;
  vcg::LocalOptimization<M> session(m, &params);
  session.Init<Collapse>();
  session.SetTargetVertices(vertices);
  session.DoOptimization();
  session.Finalize<Collapse>();
  vcg::tri::Allocator<M>::CompactEveryVector(m);
  return read(m);
}

void flip_edges(Mesh& mesh, double share, ga_symmetry::Random& random) {
  constexpr double kFlat = 18 * M_PI / 180, kGoodAngle = 23 * M_PI / 180;
  M m;
  fill(m, mesh);
  vcg::tri::UpdateTopology<M>::FaceFace(m);
  std::vector<int> edges(3 * m.face.size());
  std::iota(edges.begin(), edges.end(), 0);
  for (std::size_t i = edges.size(); i > 1; --i) std::swap(edges[i - 1], edges[ga_symmetry::draw_below(random, i)]);
  auto left = static_cast<long>(share * static_cast<double>(edges.size()) / 2);
  for (int e : edges) {
    if (left == 0) break;
    F& f = m.face[e / 3];
    const int k = e % 3;
    if (!vcg::face::CheckFlipEdge(f, k)) continue;
    const V &a = *f.V0(k), &b = *f.V1(k), &c = *f.V2(k), &d = *f.FFp(k)->V2(f.FFi(k));
    if (std::min(least_angle(a, d, c), least_angle(b, c, d)) < kGoodAngle) continue;
    if (!vcg::face::CheckFlipEdgeNormal(f, k, static_cast<float>(kFlat))) continue;
    vcg::face::FlipEdge(f, k);
    --left;
  }
  mesh = read(m);
}

int self_intersections(const Mesh& mesh) {
  M m;
  fill(m, mesh);
  std::vector<F*> faces;
  vcg::tri::Clean<M>::SelfIntersections(m, faces);
  return static_cast<int>(faces.size());
}

std::vector<int> nearest(const std::vector<Vec3>& points, const std::vector<Vec3>& queries) {
  std::vector<vcg::Point3d> at;
  for (const Vec3& p : points) at.emplace_back(p.x(), p.y(), p.z());
  vcg::KdTree<double> tree(
      vcg::ConstDataWrapper<vcg::Point3d>(at.data(), static_cast<int>(at.size()), sizeof(vcg::Point3d)));
  std::vector<int> out;
  for (const Vec3& q : queries) {
    unsigned index = 0;
    double distance = 0;
    tree.doQueryClosest(vcg::Point3d(q.x(), q.y(), q.z()), index, distance);
    out.push_back(static_cast<int>(index));
  }
  return out;
}

}  // namespace samples
