// The surface that is searched for a mesh, and the way back to the mesh's own surface.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/options.h"
#include "geodesics/anchors.h"
#include "surface/proxy.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// The mesh's surface, and where it is large a simplification of it, which is searched in its place.
class SearchSurface {
 public:
  /// @param options  `proxy`, which the method pairs does without
  /// @throws Cancelled
  SearchSurface(Surface of_mesh, const Options& options, const Context& context = {});

  const Surface& of_mesh() const { return surface_; }
  const Surface& searched() const { return proxy_ ? proxy_->surface : surface_; }
  /// The way from the searched surface to that of the mesh; null where they are the same.
  const Proxy* proxy() const { return proxy_ ? &*proxy_ : nullptr; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The vertices of the searched surface that stand for those of the mesh.
  /// @throws InvalidOption  for a vertex that does not exist, is on no face that is worked on, or is given twice
  SurfaceReferences locate(const References& references) const;

 private:
  Surface surface_;
  std::optional<Proxy> proxy_;
  std::vector<std::string> warnings_;
};

}  // namespace ga_symmetry
