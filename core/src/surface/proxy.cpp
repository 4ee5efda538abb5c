#include "surface/proxy.h"

#include <vcg/complex/algorithms/clean.h>
#include <vcg/complex/algorithms/local_optimization.h>
#include <vcg/complex/algorithms/local_optimization/tri_edge_collapse_quadric.h>
#include <vcg/complex/complex.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

class ProxyVertex;
class ProxyFace;
struct ProxyTypes : vcg::UsedTypes<vcg::Use<ProxyVertex>::AsVertexType, vcg::Use<ProxyFace>::AsFaceType> {};
class ProxyVertex : public vcg::Vertex<ProxyTypes, vcg::vertex::VFAdj, vcg::vertex::Coord3d, vcg::vertex::Normal3d,
                                       vcg::vertex::Mark, vcg::vertex::BitFlags> {
 public:
  vcg::math::Quadric<double>& Qd() { return quadric_; }

 private:
  vcg::math::Quadric<double> quadric_;
};
class ProxyFace
    : public vcg::Face<ProxyTypes, vcg::face::VFAdj, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::BitFlags> {};
class ProxyMesh : public vcg::tri::TriMesh<std::vector<ProxyVertex>, std::vector<ProxyFace>> {};
using VertexPair = vcg::tri::BasicVertexPair<ProxyVertex>;
class Collapse
    : public vcg::tri::TriEdgeCollapseQuadric<ProxyMesh, VertexPair, Collapse, vcg::tri::QInfoStandard<ProxyVertex>> {
 public:
  using Base = vcg::tri::TriEdgeCollapseQuadric<ProxyMesh, VertexPair, Collapse, vcg::tri::QInfoStandard<ProxyVertex>>;
  Collapse(const VertexPair& pair, int mark, vcg::BaseParameterClass* parameters) : Base(pair, mark, parameters) {}
};

// A first, cheap thinning in linear time, where quadrics would spend theirs on detail that is far below the proxy's
// resolution: edges much shorter than `length` are collapsed onto one of their ends, so no vertex leaves the surface.
// Nothing folds over, no border is touched, and the surface stays a manifold.
void thin_out(ProxyMesh& mesh, double length, int vertices, const Context& context) {
  using Ring = vcg::face::VFIterator<ProxyFace>;
  const auto keeps_manifold = [&](ProxyVertex* gone, ProxyVertex* kept) {  // exactly two common neighbours
    vcg::tri::UnMarkAll(mesh);
    for (Ring r(gone); !r.End(); ++r) {
      vcg::tri::Mark(mesh, r.V1());
      vcg::tri::Mark(mesh, r.V2());
    }
    int common = 0;
    for (Ring r(kept); !r.End(); ++r)
      for (ProxyVertex* w : {r.V1(), r.V2()})
        if (vcg::tri::IsMarked(mesh, w)) ++common, w->IMark() = mesh.imark - 1;
    return common == 2;
  };
  const auto folds = [](ProxyVertex* gone, ProxyVertex* kept) {
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
        ProxyVertex *gone = mesh.face[f].V(k), *kept = mesh.face[f].V((k + 1) % 3);
        if (gone->IsB() || !gone->IsW() || !kept->IsW() ||
            vcg::SquaredDistance(gone->cP(), kept->cP()) > length * length)
          continue;
        if (!keeps_manifold(gone, kept) || folds(gone, kept)) continue;
        VertexPair pair(gone, kept);
        vcg::tri::EdgeCollapser<ProxyMesh, VertexPair>::Do(mesh, pair, kept->P());
      }
    }
  }
  vcg::tri::Allocator<ProxyMesh>::CompactEveryVector(mesh);
}

TriangleMesh simplify(const Surface& s, int vertices, const Context& context) {
  context.report(0, "simplifying");
  ProxyMesh mesh;
  vcg::tri::Allocator<ProxyMesh>::AddVertices(mesh, s.vertices());
  vcg::tri::Allocator<ProxyMesh>::AddFaces(mesh, s.triangles());
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
  vcg::tri::UpdateTopology<ProxyMesh>::VertexFace(mesh);
  constexpr int kThinned = 5;  // times the proxy's vertices are left to the quadrics
  const int thinned = kThinned * vertices;
  constexpr double kBegun = 0.5;  // progress, of a mesh that is thinned first
  const Context rest = context.part(mesh.vn > thinned ? kBegun : 0, 1);
  if (mesh.vn > thinned) {
    thin_out(mesh, std::sqrt(s.area / thinned), thinned, context.part(0, kBegun));
    vcg::tri::UpdateTopology<ProxyMesh>::VertexFace(mesh);
  }
  vcg::tri::UpdateNormal<ProxyMesh>::PerVertexNormalizedPerFaceNormalized(mesh);
  vcg::tri::TriEdgeCollapseQuadricParameter parameters;
  parameters.PreserveTopology = true;
  parameters.PreserveBoundary = true;
  parameters.NormalCheck = true;
  parameters.QualityQuadric = true;  // distances want triangles of good shape on flat parts too
  parameters.QualityQuadricWeight = 0.02;
  static std::mutex one_at_a_time;  // vcglib keeps the session's state in static variables
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  rest.report(0, "simplifying");
  vcg::LocalOptimization<ProxyMesh> session(mesh, &parameters);
  session.Init<Collapse>();
  const int start = mesh.vn;
  session.SetTargetVertices(vertices);
  session.SetTimeBudget(0.2f);
  while (session.DoOptimization() && mesh.vn > vertices)
    rest.report(static_cast<double>(start - mesh.vn) / std::max(1, start - vertices), "simplifying");
  session.Finalize<Collapse>();
  vcg::tri::Allocator<ProxyMesh>::CompactEveryVector(mesh);
  TriangleMesh out;
  for (const ProxyVertex& v : mesh.vert) out.position.insert(out.position.end(), {v.cP()[0], v.cP()[1], v.cP()[2]});
  for (const ProxyFace& f : mesh.face)
    for (int k = 0; k < 3; ++k) out.triangle.push_back(static_cast<int>(f.cV(k) - mesh.vert.data()));
  return out;
}

using Vector = Eigen::Vector3d;
Vector at(const Surface& s, int v) { return Vector(s.point(v)); }

// The point of a face that is nearest to p (Ericson, Real-Time Collision Detection, 5.1.5). @return squared distance
double nearest_on_face(const Surface& s, int face, const Vector& p, SurfacePoint& nearest) {
  const int ia = s.triangle[3 * face], ib = s.triangle[3 * face + 1], ic = s.triangle[3 * face + 2];
  const Vector a = at(s, ia), ab = at(s, ib) - a, ac = at(s, ic) - a, ap = p - a, bp = ap - ab, cp = ap - ac;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  double x = 0, y = 0;  // p = a + x ab + y ac
  if (d1 <= 0 && d2 <= 0) {
  } else if (d3 >= 0 && d4 <= d3) {
    x = 1;
  } else if (d6 >= 0 && d5 <= d6) {
    y = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    x = d1 / (d1 - d3);
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    y = d2 / (d2 - d6);
  } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
    y = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    x = 1 - y;
  } else {
    x = vb / (va + vb + vc);
    y = vc / (va + vb + vc);
  }
  nearest = {{ia, ib, ic}, {std::max(0.0, 1 - x - y), x, y}};
  return (ap - x * ab - y * ac).squaredNorm();
}

Vector face_normal(const Surface& s, int face) {
  const Vector a = at(s, s.triangle[3 * face]);
  return (at(s, s.triangle[3 * face + 1]) - a).cross(at(s, s.triangle[3 * face + 2]) - a);
}

// Finds where the vertices of one surface stand on another.
class Locator {
 public:
  Locator(const Surface& large, const Surface& small) : large_(large), small_(small), normal_(large.vertices()) {
    for (Vector& n : normal_) n.setZero();
    for (std::size_t c = 0; c < large.triangle.size(); ++c)
      normal_[large.triangle[c]] += face_normal(large, static_cast<int>(c / 3));
    for (int f = 0; f < small.triangles(); ++f) face_normal_.push_back(face_normal(small, f));
  }

  /// Among all faces.
  int search(int v, SurfacePoint& place) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < small_.triangles(); ++f) try_face(v, f, least, best, place);
    return best;
  }
  /// Walks over neighbouring faces, from one near by. @return the face
  int walk(int v, int face, SurfacePoint& place) const {
    double least = std::numeric_limits<double>::infinity();
    try_face(v, face, least, face, place);
    for (bool moved = true; moved;) {
      moved = false;
      const std::array<int, 3> corners{small_.triangle[3 * face], small_.triangle[3 * face + 1],
                                       small_.triangle[3 * face + 2]};
      for (int w : corners)
        for (int i = small_.first_corner[w]; i < small_.first_corner[w + 1]; ++i)
          moved |= try_face(v, small_.corner_at[i] / 3, least, face, place);
    }
    return face;
  }

 private:
  bool try_face(int v, int f, double& least, int& best, SurfacePoint& place) const {
    SurfacePoint candidate;
    double d = nearest_on_face(small_, f, at(large_, v), candidate);
    // Where two parts touch, the one that faces the same way.
    if (large_.orientable && normal_[v].dot(face_normal_[f]) < 0) d += large_.area;
    if (d >= least) return false;
    least = d, best = f, place = candidate;
    return true;
  }

  const Surface &large_, &small_;
  std::vector<Vector> normal_, face_normal_;  // per vertex of `large_`, per face of `small_`
};

// Every vertex starts where the one it was reached from stands.
std::vector<SurfacePoint> find_places(const Surface& large, const Surface& small, const Context& context) {
  const Locator locator(large, small);
  const int n = large.vertices();
  std::vector<SurfacePoint> place(n);
  std::vector<int> face(n, -1), order{0};
  order.reserve(n);
  face[0] = locator.search(0, place[0]);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k % 16384 == 0) context.report(static_cast<double>(k) / n, "simplifying");
    const int v = order[k];
    for (int i = large.first_corner[v]; i < large.first_corner[v + 1]; ++i)
      for (int w :
           {large.triangle[next_corner(large.corner_at[i])], large.triangle[previous_corner(large.corner_at[i])]})
        if (face[w] < 0) {
          face[w] = locator.walk(w, face[v], place[w]);
          order.push_back(w);
        }
  }
  return place;
}

int heaviest(const SurfacePoint& p) {
  return static_cast<int>(std::max_element(p.weight.begin(), p.weight.end()) - p.weight.begin());
}

Vector position(const Surface& s, const SurfacePoint& p) {
  return p.weight[0] * at(s, p.vertex[0]) + p.weight[1] * at(s, p.vertex[1]) + p.weight[2] * at(s, p.vertex[2]);
}

}  // namespace

int Proxy::nearest(int v) const { return place[v].vertex[heaviest(place[v])]; }

Proxy make_proxy(const Surface& surface, int vertices, const Context& context) {
  constexpr double kSimplified = 0.6;  // progress
  Proxy out;
  out.surface = make_surface(simplify(surface, vertices, context.part(0, kSimplified)), false, context);
  const Surface& small = out.surface;
  out.place = find_places(surface, small, context.part(kSimplified, 1));
  out.vertex.assign(small.vertices(), -1);
  std::vector<double> least(small.vertices(), std::numeric_limits<double>::infinity());
  for (int v = 0; v < surface.vertices(); ++v)
    for (int p : out.place[v].vertex) {
      const double d = (at(surface, v) - at(small, p)).squaredNorm();
      if (d < least[p]) least[p] = d, out.vertex[p] = v;
    }
  // A vertex whose faces hold no vertex of the large surface: what stands next to its neighbour is near enough.
  for (int p = 0; p < small.vertices(); ++p)
    for (int i = small.first_corner[p]; out.vertex[p] < 0 && i < small.first_corner[p + 1]; ++i)
      out.vertex[p] = out.vertex[small.triangle[next_corner(small.corner_at[i])]];
  for (int& v : out.vertex) v = std::max(v, 0);
  return out;
}

CarriedMap carry_to(const Surface& surface, const Proxy& proxy, const std::vector<SurfacePoint>& point, int threads,
                    const Context& context) {
  constexpr int kBlock = 4096;
  constexpr double kTorn = 4;  // partners of a face's corners so many edges apart have nothing between them
  const Surface& small = proxy.surface;
  const int n = surface.vertices();
  CarriedMap out{std::vector<int>(n), std::vector<SurfacePoint>(n)};
  std::vector<Vector> image(small.vertices());
  for (int p = 0; p < small.vertices(); ++p) image[p] = position(small, point[p]);
  const int blocks = (n + kBlock - 1) / kBlock;
  parallel_for(blocks, threads, [&](int block, int worker) {
    if (worker == 0) context.report(static_cast<double>(block) / blocks, "all vertices");  // the calling thread
    if (context.cancelled()) throw Cancelled();
    for (int v = block * kBlock; v < std::min(n, (block + 1) * kBlock); ++v) {
      const SurfacePoint& place = proxy.place[v];
      const auto& [a, b, c] = place.vertex;
      const int k = heaviest(place), main = place.vertex[k];
      const double longest = std::max({small.edge_length(a, b), small.edge_length(b, c), small.edge_length(c, a)});
      const double spread =
          std::max({(image[a] - image[b]).norm(), (image[b] - image[c]).norm(), (image[c] - image[a]).norm()});
      const Vector target =
          spread > kTorn * longest
              ? image[main]
              : Vector(place.weight[0] * image[a] + place.weight[1] * image[b] + place.weight[2] * image[c]);
      // Downhill over the large surface's edges, from what stands next to the partner of the nearest corner.
      const SurfacePoint& start = point[main];
      int best = proxy.vertex[start.vertex[heaviest(start)]];
      double least = (at(surface, best) - target).squaredNorm();
      for (bool moved = true; moved;) {
        moved = false;
        const int center = best;
        for (int i = surface.first_corner[center]; i < surface.first_corner[center + 1]; ++i)
          for (int w : {surface.triangle[next_corner(surface.corner_at[i])],
                        surface.triangle[previous_corner(surface.corner_at[i])]}) {
            const double d = (at(surface, w) - target).squaredNorm();
            if (d < least) least = d, best = w, moved = true;
          }
      }
      out.partner[v] = best;
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = surface.first_corner[best]; i < surface.first_corner[best + 1]; ++i) {
        SurfacePoint candidate;
        const double d = nearest_on_face(surface, surface.corner_at[i] / 3, target, candidate);
        if (d < nearest) nearest = d, out.point[v] = candidate;
      }
    }
  });
  return out;
}

}  // namespace ga_symmetry
