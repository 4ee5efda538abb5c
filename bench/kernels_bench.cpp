// SPDX-License-Identifier: GPL-3.0-or-later
// The hot paths alone, each on spheres of some sizes, one thread; see geodesics_bench for accuracy and scaling_bench
// for the whole.
//
//   kernels_bench [--benchmark_filter=...]
#include <benchmark/benchmark.h>

#include <numeric>
#include <vector>

#include "matching/dense_map.h"
#include "matching/ranking.h"
#include "search/joint.h"
#include "spheres.h"
#include "surface/simplify.h"

namespace {

using namespace ga_symmetry;

// Uneven enough that no vertex is like another.
Surface sphere(int parts) { return make_surface(spheres::icosphere(parts, 0.2 / parts)); }

void distance_field(benchmark::State& state) {
  const Surface surface = sphere(static_cast<int>(state.range(0)));
  const GeodesicSolver solver(surface);
  const auto workspace = solver.make_workspace();
  std::vector<float> field(surface.vertices());
  for ([[maybe_unused]] auto _ : state) {
    solver.field(0, field.data(), *workspace);
    benchmark::DoNotOptimize(field.data());
  }
  state.counters["vertices"] = surface.vertices();
}
BENCHMARK(distance_field)->Arg(24)->Arg(35)->Arg(100)->Unit(benchmark::kMillisecond);

void simplification(benchmark::State& state) {
  const Surface surface = sphere(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(simplified(surface, 6000));
  state.counters["vertices"] = surface.vertices();
}
BENCHMARK(simplification)->Arg(35)->Arg(100)->Unit(benchmark::kMillisecond);

// A surface as small as those that are searched, with the sites of the default options.
struct Scene {
  Surface surface = sphere(24);
  GeodesicSolver solver{surface};
  JointOptions options;
  Sites sites = make_sites(surface, solver, {options.samples, options.sites, 8}, 1);
  SampleMap itself = SampleMap(sites.samples);
  Scene() { std::iota(itself.begin(), itself.end(), 0); }
};
const Scene& scene() {
  static const Scene made;
  return made;
}

void joint_cost(benchmark::State& state) {
  const Scene& s = scene();
  const JointProblem problem(s.sites, s.surface, SymmetryKind::reflection, {}, s.options);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(problem.cost().cost(s.itself));
}
BENCHMARK(joint_cost)->Unit(benchmark::kMicrosecond);

void joint_evaluation(benchmark::State& state) {
  const Scene& s = scene();
  const JointProblem problem(s.sites, s.surface, SymmetryKind::reflection, {}, s.options);
  for ([[maybe_unused]] auto _ : state) {
    SampleMap map = polar_map(problem.cost(), {0, 1}, 0);
    benchmark::DoNotOptimize(problem.evaluate(map, 0));
  }
}
BENCHMARK(joint_evaluation)->Unit(benchmark::kMicrosecond);

void dense_map(benchmark::State& state) {
  const Scene& s = scene();
  HeatDiffusion diffusion(s.surface);
  const CurvatureFeatures curvature = curvature_features(s.surface, diffusion);
  const Shortcuts none;
  const FieldCache fields(s.solver);
  const Matching matching{s.surface, fields, none, curvature, images_of(s.itself, s.sites, {}), 0, true};
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(make_dense_map(matching, matching.landmarks, {true, true, false}, 1));
  state.counters["vertices"] = s.surface.vertices();
}
BENCHMARK(dense_map)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
