// A small surface of the same shape to search on, and the way back to every vertex of the large one.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

struct Proxy {
  Surface surface;
  std::vector<SurfacePoint> place;  ///< per vertex of the large surface: where it stands on the proxy
  std::vector<int> vertex;          ///< per vertex of the proxy: a vertex of the large surface that stands next to it

  /// The proxy's vertex nearest to a vertex of the large surface.
  int nearest(int v) const;
};

/// Simplifies by quadric edge collapse (Garland & Heckbert 1997, vcglib's) to about `vertices`; no hole is closed and
/// no two parts are joined. Places are found by walking over edges, so parts that touch in space are not confused.
/// @throws InvalidMesh  if what is left is no surface to work on
/// @throws Cancelled
Proxy make_proxy(const Surface& surface, int vertices, const Context& context = {});

/// Values per vertex of the proxy, interpolated at the vertices of the large surface.
template <class Value>
std::vector<Value> interpolate(const Proxy& proxy, const std::vector<Value>& values) {
  std::vector<Value> out;
  out.reserve(proxy.place.size());
  for (const SurfacePoint& p : proxy.place) {
    Value sum = 0;
    for (int k = 0; k < 3; ++k) sum += static_cast<Value>(p.weight[k]) * values[p.vertex[k]];
    out.push_back(sum);
  }
  return out;
}

/// The partners of all vertices of the large surface, from the proxy's.
struct CarriedMap {
  std::vector<int> partner;
  std::vector<SurfacePoint> point;  ///< the partner on a face
};
/// A vertex's partner is where the partners of the proxy's vertices around it, interpolated, lie: each vertex has its
/// own, not its neighbour's.
/// @param point  per vertex of the proxy: its partner on a face of the proxy
CarriedMap carry_to(const Surface& surface, const Proxy& proxy, const std::vector<SurfacePoint>& point, int threads,
                    const Context& context = {});

}  // namespace ga_symmetry
