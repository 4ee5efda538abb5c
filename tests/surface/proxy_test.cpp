#include "surface/proxy.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <set>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

struct Scene {
  shapes::Symmetric shape = shapes::shuffled(shapes::creature(5), 3);  // 10242 vertices
  Surface surface = make_surface(shape.mesh);
  Proxy proxy = make_proxy(surface, 1500);
};
const Scene& scene() {
  static const Scene s;
  return s;
}

double distance(const Surface& a, int v, const std::array<double, 3>& p) {
  return std::hypot(a.point(v)[0] - p[0], a.point(v)[1] - p[1], a.point(v)[2] - p[2]);
}
std::array<double, 3> position(const Surface& s, const SurfacePoint& p) {
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k)
    for (int x = 0; x < 3; ++x) out[x] += p.weight[k] * s.point(p.vertex[k])[x];
  return out;
}

TEST(Proxy, HasTheSizeAskedForAndTheShape) {
  const Scene& s = scene();
  EXPECT_NEAR(s.proxy.surface.vertices(), 1500, 2);
  EXPECT_TRUE(s.proxy.surface.closed);
  EXPECT_NEAR(s.proxy.surface.area, s.surface.area, 0.02 * s.surface.area);
}

TEST(Proxy, EveryVertexStandsNextToItself) {
  const Scene& s = scene();
  ASSERT_EQ(static_cast<int>(s.proxy.place.size()), s.surface.vertices());
  for (int v = 0; v < s.surface.vertices(); ++v) {
    const SurfacePoint& p = s.proxy.place[v];
    EXPECT_NEAR(p.weight[0] + p.weight[1] + p.weight[2], 1, 1e-12);
    for (double w : p.weight) EXPECT_GE(w, 0);
    EXPECT_LT(distance(s.surface, v, position(s.proxy.surface, p)), 0.02 * s.surface.unit());
  }
}

// Two long sheets so near to each other that the nearest point in space may be on the wrong one.
TEST(Proxy, PartsThatTouchAreNotConfused) {
  constexpr int kColumns = 121, kRows = 30;
  TriangleMesh folded = shapes::grid(kColumns, kRows);
  for (int v = 0; v < folded.vertices(); ++v) {
    double& x = folded.position[3 * v];
    double& z = folded.position[3 * v + 2];
    const double along = 4 * x;  // folded at 2, the sheets 0.004 apart, the upper one wavy
    if (along > 2)
      z = 0.004 + 0.003 * std::sin(40 * along), x = 4 - along;
    else
      x = along;
    if (std::abs(along - 2) < 0.03) z = 0.002 * (1 + (along - 2) / 0.03);
  }
  const Surface s = make_surface(folded);
  const Proxy proxy = make_proxy(s, 1000);
  const GeodesicSolver solver(proxy.surface), fine(s);
  const DistanceFields small = solver.fields({proxy.nearest(0)}, 1), large = fine.fields({0}, 1);
  const std::vector<float> at(small.row(0).data(), small.row(0).data() + small.cols());
  const std::vector<float> carried = interpolate(proxy, at);
  for (int v = 0; v < s.vertices(); ++v) EXPECT_NEAR(carried[v], large(0, v), 0.2);
}

TEST(Proxy, CarriesAMapToEveryVertexWithinTheProxysResolution) {
  const Scene& s = scene();
  // The exact map of the proxy: the mirror image of its vertex, where the proxy is nearest to it.
  std::vector<SurfacePoint> point;
  for (int p = 0; p < s.proxy.surface.vertices(); ++p)
    point.push_back(s.proxy.place[s.shape.partner[s.proxy.vertex[p]]]);
  const CarriedMap map = carry_to(s.surface, s.proxy, point, 1);
  const GeodesicSolver solver(s.surface);
  double sum = 0;
  int count = 0;
  std::set<int> distinct(map.partner.begin(), map.partner.end());
  for (int v = 0; v < s.surface.vertices(); v += 97, ++count)
    sum += solver.fields({s.shape.partner[v]}, 1)(0, map.partner[v]);
  EXPECT_LT(sum / count / s.surface.unit(), 0.02);
  EXPECT_GT(static_cast<int>(distinct.size()), s.surface.vertices() / 2);  // each its own partner, not the proxy's few
}

TEST(Proxy, ThreadsChangeNothing) {
  const Scene& s = scene();
  std::vector<SurfacePoint> point(s.proxy.place.begin(), s.proxy.place.begin() + s.proxy.surface.vertices());
  EXPECT_EQ(carry_to(s.surface, s.proxy, point, 1).partner, carry_to(s.surface, s.proxy, point, 4).partner);
}

TEST(Proxy, Cancels) {
  const std::atomic<bool> stop{true};
  Context context;
  context.cancel = &stop;
  EXPECT_THROW(make_proxy(scene().surface, 1500, context), Cancelled);
}

TEST(Proxy, TheWholeSearchFindsTheSymmetryOfALargeMeshOnIt) {
  const Scene& s = scene();
  Options options;
  options.proxy = 2000;
  options.references.axis = {s.shape.axis[0], s.shape.axis[1]};
  options.references.pairs = {s.shape.pair};
  const Result result = find_symmetry(s.shape.mesh, options);
  EXPECT_EQ(result.matched, s.surface.vertices());
  const GeodesicSolver solver(s.surface);
  double sum = 0;
  int count = 0;
  for (int v = 0; v < s.surface.vertices(); v += 97, ++count)
    sum += solver.fields({s.shape.partner[v]}, 1)(0, result.partner[v]);
  EXPECT_LT(sum / count / s.surface.unit(), 0.03);
  EXPECT_TRUE(result.seconds.at(1).stage == "proxy");
}

TEST(Proxy, SizesOutOfRangeAreRefused) {
  Options options;
  options.proxy = 10;
  EXPECT_THROW(find_symmetry(scene().shape.mesh, options), InvalidOption);
}

}  // namespace
}  // namespace ga_symmetry
