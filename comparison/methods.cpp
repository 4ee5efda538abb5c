// SPDX-License-Identifier: GPL-3.0-or-later
#include "methods.h"

#include <algorithm>

#include "baselines/features.h"
#include "baselines/pair_search.h"
#include "baselines/reversing.h"
#include "baselines/spectral.h"
#include "baselines/spectrum.h"
#include "ga_symmetry/errors.h"
#include "search/pairs.h"

namespace ga_symmetry::comparison {
namespace {

using namespace baselines;

// A surface and the references on it.
struct Scene {
  Surface surface;
  GeodesicSolver solver;
  References references;

  explicit Scene(const MethodInput& in) : surface(make_surface(in.mesh, true)), solver(surface) {
    std::vector<int> index(surface.mesh_vertices, -1);
    for (int v = 0; v < surface.vertices(); ++v) index[surface.mesh_vertex[v]] = v;
    const auto at = [&](int v) {
      if (v < 0 || v >= surface.mesh_vertices || index[v] < 0)
        throw InvalidOption("reference vertex " + std::to_string(v) + " is not on the surface: choose another");
      return index[v];
    };
    for (int v : in.references.axis) references.axis.push_back(at(v));
    for (const auto& [l, r] : in.references.pairs) {
      const int left = at(l);
      references.pairs.push_back({left, at(r)});
    }
  }

  MethodOutput output(const std::vector<int>& partner) const {
    MethodOutput out;
    out.partner.assign(surface.mesh_vertices, -1);
    for (int v = 0; v < surface.vertices(); ++v)
      if (partner[v] >= 0) out.partner[surface.mesh_vertex[v]] = surface.mesh_vertex[partner[v]];
    return out;
  }

  DistanceFields reference_fields(int threads) const {
    return solver.fields({references.axis[0], references.axis[1], references.pairs[0][0], references.pairs[0][1]},
                         threads);
  }
  std::vector<int> sides(const DistanceFields& fields) const {
    return split_sides(surface, fields, {references.axis[0], references.axis[1]}, references.pairs[0]);
  }
};

// Each vertex takes the vertex of the other side that is best by the paper's fitness.
template <class Search>
MethodOutput match_all(const MethodInput& in, const Search& search) {
  const Scene scene(in);
  const DistanceFields fields = scene.reference_fields(in.threads);
  const std::vector<int> side = scene.sides(fields);
  std::vector<int> partner(side.size()), member[2];
  std::vector<AxisDistances> distances[2];
  for (int v = 0; v < scene.surface.vertices(); ++v) {
    partner[v] = v;
    if (side[v] == 0) continue;
    member[side[v] > 0].push_back(v);
    distances[side[v] > 0].push_back({fields(0, v), fields(1, v)});
  }
  for (int from : {0, 1}) {
    if (distances[1 - from].empty()) continue;
    const std::vector<int> match = search(distances[from], distances[1 - from], PairError::squared);
    for (std::size_t i = 0; i < match.size(); ++i) partner[member[from][i]] = member[1 - from][match[i]];
  }
  return scene.output(partner);
}

MethodOutput search(const MethodInput& in, Options options, const Context& context) {
  options.references = in.references;
  options.seed = in.seed;
  options.threads = in.threads;
  options.largest_component = true;
  Result result = find_symmetry(in.mesh, options, context);
  MethodOutput out{std::move(result.partners.partner), std::move(result.log), result.stop, 0};
  for (const StageTime& stage : result.seconds)
    if (stage.stage == "search") out.search_seconds = stage.seconds;
  return out;
}

MethodOutput pairs(const MethodInput& in, PairError error, const Context& context) {
  Options options;
  options.method = ga_symmetry::Method::pairs;
  options.pairs.error = error;
  return search(in, options, context);
}

constexpr int kFunctions = 100;  // eigenfunctions

MethodOutput features(const MethodInput& in) {
  const Scene scene(in);
  const Eigen::MatrixXd all =
      symmetry_features(scene.surface, scene.solver, laplacian_spectrum(scene.surface, kFunctions), in.threads);
  return scene.output(match_across(all, scene.sides(scene.reference_fields(in.threads)), in.threads));
}

MethodOutput spectral(const MethodInput& in) {
  const Scene scene(in);
  const SignOptions options;
  const Spectrum spectrum = laplacian_spectrum(scene.surface, options.functions + 1);
  const auto starts = sign_patterns(scene.surface, spectrum, scene.references, options, in.threads);
  return scene.output(to_partners(spectrum, starts[0], in.threads));
}

MethodOutput refined(const MethodInput& in, int samples, int step, const Context& context) {
  const Scene scene(in);
  const Spectrum spectrum = laplacian_spectrum(scene.surface, kFunctions);
  const auto starts = sign_patterns(scene.surface, spectrum, scene.references, {}, in.threads);
  ZoomOutOptions options;
  options.samples = samples;
  options.step = step;
  return scene.output(zoomout(scene.surface, spectrum, starts, scene.references, options, in.threads, context));
}

MethodOutput reversing(const MethodInput& in, const Context& context) {
  const Scene scene(in);
  if (!scene.surface.orientable) throw InvalidMesh("the surface has one side only: nothing reverses its orientation");
  const Spectrum spectrum = laplacian_spectrum(scene.surface, kFunctions);
  const FunctionalMap start = reversing_map(scene.surface, spectrum, {});
  return scene.output(zoomout(scene.surface, spectrum, {start}, {}, {}, in.threads, context));
}

// Spectral refinement of what the joint search found.
MethodOutput joint_refined(const MethodInput& in, const Context& context) {
  const MethodOutput joint = search(in, {}, context);
  const Scene scene(in);
  const Spectrum spectrum = laplacian_spectrum(scene.surface, kFunctions);
  std::vector<int> index(scene.surface.mesh_vertices, -1), partner;
  for (int v = 0; v < scene.surface.vertices(); ++v) index[scene.surface.mesh_vertex[v]] = v;
  const std::vector<int> vertices = space_samples(scene.surface, 1000);
  for (int v : vertices) partner.push_back(index[joint.partner[scene.surface.mesh_vertex[v]]]);
  const int functions = std::min(30, static_cast<int>(spectrum.value.size()));
  const FunctionalMap start = to_functional_map(spectrum, vertices, partner, functions);
  MethodOutput out = scene.output(zoomout(scene.surface, spectrum, {start}, scene.references, {}, in.threads, context));
  out.log = joint.log;
  out.stop = joint.stop;
  out.search_seconds = joint.search_seconds;
  return out;
}

}  // namespace

const std::vector<Method>& methods() {
  using In = MethodInput;
  static const std::vector<Method> all = [] {
    std::vector<Method> list{
        {"naive", "exhaustive search on the paper's fitness, squared error", true, false,
         [](const In& in, const Context&) { return match_all(in, naive_matches); }},
        {"kdtree", "the same by a k-d tree", true, false,
         [](const In& in, const Context&) { return match_all(in, tree_matches); }},
        {"pairs-squared", "the paper's genetic algorithm, squared error", true, true,
         [](const In& in, const Context& c) { return pairs(in, PairError::squared, c); }},
        {"pairs-linear", "the paper's genetic algorithm, linear error", true, true,
         [](const In& in, const Context& c) { return pairs(in, PairError::linear, c); }},
        {"features", "average geodesic distance and wave kernel signature, matched across the axis", true, false,
         [](const In& in, const Context&) { return features(in); }},
        {"spectral", "signs of Laplacian eigenfunctions", true, false,
         [](const In& in, const Context&) { return spectral(in); }},
        {"zoomout", "ZoomOut of the best sign patterns, on 1000 samples", true, false,
         [](const In& in, const Context& c) { return refined(in, 1000, 5, c); }},
        {"zoomout-full", "ZoomOut of the best sign patterns, on all vertices", true, false,
         [](const In& in, const Context& c) { return refined(in, 0, 1, c); }},
        {"joint", "our genetic algorithm over whole maps", true, true,
         [](const In& in, const Context& c) { return search(in, {}, c); }},
        {"joint-zoomout", "ZoomOut of what joint finds", true, true, joint_refined}};
    for (const char* name : {"spectral", "zoomout", "zoomout-full", "joint", "joint-zoomout"}) {
      Method automatic = *std::find_if(list.begin(), list.end(), [&](const Method& m) { return m.name == name; });
      automatic.name += "-auto";
      automatic.text += ", without references";
      automatic.references = false;
      automatic.run = [run = automatic.run](const In& in, const Context& c) {
        return run({in.mesh, {}, in.seed, in.threads}, c);
      };
      list.push_back(automatic);
    }
    list.push_back(
        {"reversing-zoomout-auto", "ZoomOut of the functional map that reverses orientation", false, false, reversing});
    return list;
  }();
  return all;
}

const Method& method(const std::string& name) {
  std::string names;
  for (const Method& m : methods()) {
    if (m.name == name) return m;
    names += (names.empty() ? "" : ", ") + m.name;
  }
  throw InvalidOption("there is no method " + name + ": choose from " + names);
}

}  // namespace ga_symmetry::comparison
