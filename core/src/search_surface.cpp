#include "search_surface.h"

#include <set>
#include <utility>

#include "ga_symmetry/errors.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

constexpr double kWorthProxy = 1.3;  // a surface so many times larger than its proxy is searched on it

}  // namespace

SearchSurface::SearchSurface(Surface of_mesh, const Options& options, const Context& context)
    : surface_(std::move(of_mesh)), warnings_(surface_.warnings) {
  const bool large =
      options.method == Method::joint && options.proxy > 0 && surface_.vertices() > kWorthProxy * options.proxy;
  if (!large) return;
  try {
    proxy_ = make_proxy(surface_, options.proxy, context);
  } catch (const InvalidMesh&) {
    warnings_.push_back("the mesh could not be simplified, so all its vertices were searched: that takes long");
  }
}

SurfaceReferences SearchSurface::locate(const References& references) const {
  const std::vector<int> on_surface = surface_vertices(surface_);
  std::set<int> used;
  const auto find = [&](int v) {
    if (v < 0 || v >= surface_.mesh_vertices)
      throw InvalidOption("reference vertex " + std::to_string(v) + " does not exist: the mesh has vertices 0 to " +
                          std::to_string(surface_.mesh_vertices - 1));
    if (on_surface[v] < 0)
      throw InvalidOption("reference vertex " + std::to_string(v) +
                          " is not on the surface that is worked on: choose a vertex of its faces");
    if (!used.insert(v).second)
      throw InvalidOption("reference vertex " + std::to_string(v) + " is given twice: choose different vertices");
    return proxy_ ? proxy_->nearest(on_surface[v]) : on_surface[v];
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
