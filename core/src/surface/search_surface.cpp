// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/search_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <set>
#include <utility>

#include "ga_symmetry/errors.h"
#include "surface/locate.h"
#include "surface/refine.h"
#include "surface/sew.h"
#include "surface/sheets.h"
#include "surface/simplify.h"
#include "surface/welded_mesh.h"
#include "surface/wrap.h"
#include "util/disjoint_sets.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

constexpr double kWorthSimplifying = 1.3;  // times the wanted vertices
// Fewer vertices hardly resolve fingers and ears; a surface of fewer is refined.
constexpr int kEnough = 2000;

// Shortest and longest.
std::pair<double, double> edge_lengths(const Surface& s) {
  double shortest = INFINITY, longest = 0;
  for (int c = 0; c < 3 * s.triangles(); ++c) {
    const double length = s.edge_length(s.triangle[c], s.triangle[next_corner(c)]);
    shortest = std::min(shortest, length), longest = std::max(longest, length);
  }
  return {shortest, longest};
}

// Some of the faces alone. @param wanted  asked of a face
template <class Wanted>
Surface faces_of(const Surface& mesh, const Wanted& wanted, const Context& context) {
  std::vector<double> position;
  std::vector<int> triangle, index(mesh.vertices(), -1);
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c) {
    if (!wanted(c / 3)) continue;
    const int v = mesh.triangle[c];
    if (index[v] < 0) {
      index[v] = static_cast<int>(position.size() / 3);
      position.insert(position.end(), mesh.point(v), mesh.point(v) + 3);
    }
    triangle.push_back(index[v]);
  }
  return surface_of(std::move(position), std::move(triangle), context);
}

// Leaves out sheets of less than a share of the area, as long as they are no great part of the whole together.
// @return how many were left out; 0 leaves `to` alone
int without_scraps(const Surface& from, double scrap, Surface& to, const Context& context) {
  constexpr double kScraps = 0.25;  // of the area
  const Sheets sheets(from);
  int scraps = 0;
  double dropped = 0;
  for (const double a : sheets.area)
    if (a < scrap * from.area) ++scraps, dropped += a;
  if (scraps == 0 || scraps == sheets.count() || dropped > kScraps * from.area) return 0;
  to = faces_of(
      from, [&](std::size_t f) { return sheets.area[sheets.of_face[f]] >= scrap * from.area; }, context);
  return scraps;
}

// Leaves out fins and flaps: as borders of what they stand on they would count as holes. Not where they hold the whole
// together.
// @return how many were left out
int drop_scraps(const Surface& from, Surface& to, const Context& context) {
  constexpr double kScrap = 0.01;
  const int scraps = without_scraps(from, kScrap, to, context);
  if (scraps == 0) return 0;
  int parts = 0;
  face_parts(to.triangle, to.vertices(), parts);
  return parts == 1 ? scraps : 0;
}

// Makes the ends of edges shorter than `least` one, as long as such edges are few and the rest hangs together.
// @return how many vertices went; 0 leaves `to` alone
int without_short_edges(const Surface& from, double least, Surface& to, const Context& context) {
  constexpr double kFew = 0.01;  // of the edges
  DisjointSets merged(from.vertices());
  int found = 0, gone = 0;
  for (int c = 0; c < 3 * from.triangles(); ++c) {
    const int a = from.triangle[c], b = from.triangle[next_corner(c)];
    if (from.edge_length(a, b) >= least) continue;
    ++found;
    gone += merged.join(a, b);
  }
  if (found == 0 || found > kFew * 3 * from.triangles()) return 0;
  Surface shrunk = from;
  for (int& v : shrunk.triangle) v = merged.find(v);
  Surface rest = faces_of(
      shrunk,
      [&](std::size_t f) {
        const int *t = &shrunk.triangle[3 * f], a = t[0], b = t[1], c = t[2];
        return a != b && b != c && c != a;
      },
      context);
  int parts = 0;
  face_parts(rest.triangle, rest.vertices(), parts);
  if (parts != 1) return 0;
  to = std::move(rest);
  return gone;
}

double diagonal_of(const Surface& mesh) {
  Vector low = Vector::Constant(INFINITY), high = -low;
  for (const int v : mesh.triangle)
    low = low.cwiseMin(Vector(mesh.point(v))), high = high.cwiseMax(Vector(mesh.point(v)));
  return (high - low).norm();
}

// Share of the mesh's area that lies far from a part, as the crow flies.
double share_beyond(const Surface& mesh, const std::vector<int>& part, int wanted, const Surface& lead, double far) {
  std::vector<double> position = lead.position;
  std::vector<int> triangle = lead.triangle;
  split_long_edges(position, triangle, far);
  const Eigen::Map<const Points> points(position.data(), static_cast<Eigen::Index>(position.size() / 3), 3);
  const nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Map<const Points>, 3> tree(3, std::cref(points));
  double beyond = 0;
  for (int v = 0; v < mesh.vertices(); ++v) {
    if (part[v] < 0 || part[v] == wanted) continue;
    Eigen::Index nearest;
    double squared;
    tree.query(mesh.point(v), 1, &nearest, &squared);
    if (squared > far * far) beyond += mesh.vertex_area[v];
  }
  return beyond / mesh.area;
}

}  // namespace

SearchSurface::SearchSurface(Surface of_mesh, const Options& options, const Context& context)
    : mesh_(std::move(of_mesh)), done_(mesh_.notes) {
  const std::vector<int> part = face_parts(mesh_.triangle, mesh_.vertices(), parts_);
  part_.assign(mesh_.vertices(), -1);
  for (std::size_t c = 0; c < mesh_.triangle.size(); ++c) part_[mesh_.triangle[c]] = part[c / 3];
  if (options.method == Method::pairs && parts_ == 1) {
    direct_ = true;
    return;
  }
  // Without simplifying, a mesh in parts is still wrapped to a surface of the usual size.
  const int vertices = options.proxy > 0 ? options.proxy : std::max(3000, parts_ == 1 ? mesh_.vertices() : 0);
  // Wider gaps are not sewn: hands on hips, or the legs of trousers, are near each other, too.
  constexpr double kGap = 0.05;  // units
  // Fins and debris have rims, too, and nothing to be sewn to.
  constexpr double kDebris = 0.0005;  // of the area
  Surface trimmed, sewn;
  const int debris = parts_ > 1 ? without_scraps(mesh_, kDebris, trimmed, context) : 0;
  const int stitches = parts_ > 1 ? sew(debris > 0 ? trimmed : mesh_, kGap * mesh_.unit(), sewn, context) : 0;
  if (stitches > 0 && debris > 0)
    done_.push_back("left " + std::to_string(debris) + (debris == 1 ? " tiny sheet aside" : " tiny sheets aside"));
  if (stitches > 0) done_.push_back("sewn gaps between parts with " + std::to_string(stitches) + " triangles");
  const Surface& whole = stitches > 0 ? sewn : mesh_;
  if (!lead(whole, vertices, context.part(0, 0.8))) wrap_all(whole, vertices, context.part(0, 0.8));
  if (!direct_) context.report(0.8, "simplifying");
  if (!direct_) place_ = ga_symmetry::locate(mesh_, searched_, options.threads);
}

// The only part, or the one that leads. @return false where there is none that would do
bool SearchSurface::lead(const Surface& mesh, int vertices, const Context& context) {
  // A part leads by its share of the area, if little of the others is farther off than a share of the diagonal.
  constexpr double kLeading = 0.5, kFar = 0.04, kFew = 0.02;
  // Time grows with the square of the faces around a vertex.
  constexpr int kMostFacesAround = 2000;
  // Fronts run badly over faces far longer than what the search resolves: CAD, low-poly.
  constexpr double kTooLong = 6, kSplit = 1.6;
  Surface s;
  const Surface* surface = &mesh;
  int parts = 0;
  const std::vector<int> part = face_parts(mesh.triangle, mesh.vertices(), parts);
  if (parts > 1) {
    std::vector<double> area(parts, 0.0);
    std::vector<int> part_of(mesh.vertices(), -1);
    for (int f = 0; f < mesh.triangles(); ++f) {
      area[part[f]] += mesh.face_area(f);
      for (int k = 0; k < 3; ++k) part_of[mesh.triangle[3 * f + k]] = part[f];
    }
    const int largest = static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
    if (area[largest] < kLeading * mesh.area) return false;
    s = faces_of(
        mesh, [&](std::size_t f) { return part[f] == largest; }, context);
    if (!s.orientable) return false;
    if (share_beyond(mesh, part_of, largest, s, kFar * diagonal_of(mesh)) > kFew) return false;
    surface = &s;
  }
  std::vector<std::string> done;
  Surface whole;
  if (const int scraps = drop_scraps(*surface, whole, context); scraps > 0) {
    s = std::move(whole);
    surface = &s;
    done.push_back("left " + std::to_string(scraps) + (scraps == 1 ? " scrap aside" : " scraps aside"));
  }
  for (int v = 0; v < surface->vertices(); ++v)
    if (surface->first_corner[v + 1] - surface->first_corner[v] > kMostFacesAround) return false;
  const double fine = std::sqrt(surface->area / std::clamp(surface->vertices(), kEnough, std::max(kEnough, vertices)));
  // A shape far longer than wide, as one with a spike, would need no end of pieces; it is searched as it is.
  constexpr double kThin = 12;  // its diagonal over its unit; a body's is 2 to 3
  const bool thin = diagonal_of(*surface) > kThin * surface->unit();
  if (!thin && (surface->vertices() < kEnough || edge_lengths(*surface).second > kTooLong * fine)) {
    std::vector<double> position = surface->position;
    std::vector<int> triangle = surface->triangle;
    constexpr double kMostPieces = 8 * kEnough;
    double pieces = 0, length = kSplit * fine;
    for (int c = 0; c < 3 * surface->triangles(); ++c)
      pieces +=
          std::max(0.0, surface->edge_length(surface->triangle[c], surface->triangle[next_corner(c)]) / length - 1);
    length *= std::max(1.0, pieces / kMostPieces);
    split_long_edges(position, triangle, length);
    s = surface_of(std::move(position), std::move(triangle), context);
    surface = &s;
    done.push_back("refined to " + std::to_string(s.vertices()) + " vertices");
  }
  if (surface->vertices() > kWorthSimplifying * vertices) {
    s = simplified(*surface, vertices, context);
    surface = &s;
    // Defects may leave nothing that can be taken away, and a search on all of it would take minutes.
    if (s.vertices() > 2 * vertices) return false;
  }
  // Edges as short as what float coordinates round: a front would go round and round on them.
  constexpr double kRounding = 1e-6;
  Surface shrunk;
  if (const int gone = without_short_edges(*surface, kRounding * surface->unit(), shrunk, context); gone > 0) {
    s = std::move(shrunk);
    surface = &s;
    done.push_back("made points of edges as short as rounding, " + std::to_string(gone));
  }
  if (edge_lengths(*surface).first < kRounding * surface->unit()) return false;
  done_.insert(done_.end(), done.begin(), done.end());
  if (parts > 1) done_.push_back("the largest of " + std::to_string(parts) + " parts leads the others");
  direct_ = surface == &mesh_;
  if (surface == &s)
    searched_ = std::move(s);
  else if (!direct_)
    searched_ = *surface;
  return true;
}

void SearchSurface::wrap_all(const Surface& mesh, int vertices, const Context& context) {
  // Spacing of the grid over the distance of the wanted vertices, so that simplifying has something to choose from.
  constexpr double kFiner = 0.6;
  constexpr double kFinest = 1.0 / 250, kCoarsest = 1.0 / 70;  // of the diagonal
  const double diagonal = diagonal_of(mesh);
  const double spacing = std::clamp(kFiner * std::sqrt(mesh.area / vertices), kFinest * diagonal, kCoarsest * diagonal);
  Wrap w = wrap(mesh.position, mesh.triangle, spacing, context.part(0, 0.6));
  Surface s = surface_of(std::move(w.mesh.position), std::move(w.mesh.triangle), context);
  searched_ =
      s.vertices() > kWorthSimplifying * vertices ? simplified(s, vertices, context.part(0.6, 1)) : std::move(s);
  std::string text = parts_ == 1 ? "wrapped" : "wrapped " + std::to_string(parts_) + " parts in one surface";
  if (w.bridged) text += " over " + std::to_string(w.bridged) + (w.bridged == 1 ? " gap" : " gaps");
  done_.push_back(text);
}

std::string SearchSurface::summary() const {
  std::string out;
  for (const std::string& note : done_) out += (out.empty() ? "" : ", ") + note;
  return out;
}

SurfaceReferences SearchSurface::locate(const References& references) const {
  std::set<int> used;
  const auto find = [&](int v) {
    if (v < 0 || v >= mesh_.mesh_vertices)
      throw InvalidOption("reference vertex " + std::to_string(v) + " does not exist: the mesh has vertices 0 to " +
                          std::to_string(mesh_.mesh_vertices - 1));
    const int at = mesh_.surface_vertex[v];
    if (at < 0)
      throw InvalidOption("reference vertex " + std::to_string(v) +
                          " is not on the surface that is worked on: choose a vertex of its faces");
    if (!used.insert(at).second)
      throw InvalidOption("reference vertex " + std::to_string(v) + " is given twice: choose different vertices");
    if (direct_) return at;
    const SurfacePoint& p = place_[at];
    return p.vertex[std::max_element(p.weight.begin(), p.weight.end()) - p.weight.begin()];
  };
  SurfaceReferences out;
  for (const int a : references.axis) out.axis.push_back(find(a));
  for (const auto& [l, r] : references.pairs) {
    const int left = find(l);
    out.pairs.push_back({left, find(r)});
  }
  return out;
}

}  // namespace ga_symmetry
