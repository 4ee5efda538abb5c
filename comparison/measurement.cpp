// SPDX-License-Identifier: GPL-3.0-or-later
#include "measurement.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "baselines/pair_search.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/version.h"
#include "geodesics/sampling.h"
#include "methods.h"

namespace ga_symmetry::comparison {
namespace {

constexpr std::size_t kPictures = 6;  // meshes that are drawn: more make the page long without saying more

std::string machine() {
  std::ifstream in("/proc/cpuinfo");
  std::string line, model = "unknown processor";
  while (std::getline(in, line))
    if (line.rfind("model name", 0) == 0) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

// Counts steps for the progress bar and stops where the user asks for it.
class Steps {
 public:
  Steps(const Context& context, std::size_t count) : context_(context), count_(static_cast<double>(count)) {}
  void next(const std::string& stage) { context_.report(std::min(1.0, done_++ / count_), stage.c_str()); }
  /// For a step's own work: it can be stopped, but has no say in the whole's progress.
  Context inner() const {
    Context out;
    out.cancel = context_.cancel;
    return out;
  }

 private:
  const Context& context_;
  double count_, done_ = 0;
};

// Per vertex: the error of the measured vertex nearest to it.
std::vector<double> spread_errors(const TriangleMesh& mesh, const Evaluation& evaluation) {
  const Surface surface = make_surface(mesh, true);
  std::vector<int> index(mesh.vertices(), -1), sources, line;
  for (int v = 0; v < surface.vertices(); ++v) index[surface.mesh_vertex[v]] = v;
  for (std::size_t i = 0; i < evaluation.vertex.size(); ++i)
    if (const int v = index[evaluation.vertex[i]]; v >= 0) {
      sources.push_back(v);
      line.push_back(static_cast<int>(i));
    }
  std::vector<double> out(mesh.vertices(), 0.0);
  if (sources.empty()) return out;
  const GeodesicSolver solver(surface);
  std::vector<float> distance(surface.vertices());
  std::vector<int> label(surface.vertices());
  solver.nearest(sources, distance.data(), label.data(), *solver.make_workspace());
  for (int v = 0; v < surface.vertices(); ++v) out[surface.mesh_vertex[v]] = evaluation.error[line[label[v]]];
  return out;
}

void run_methods(const Plan& plan, const Subject& subject, bool pictured, Steps& steps, Comparison& out) {
  const std::size_t first = out.runs.size();
  std::vector<std::vector<int>> maps;
  for (int repeat = 1; repeat <= plan.repeats; ++repeat)
    for (std::uint64_t seed : plan.seeds)
      for (const std::string& name : plan.methods) {
        const Method& tried = method(name);
        if (!tried.random && seed != plan.seeds[0]) continue;
        if (tried.references && subject.known.references.empty()) continue;
        steps.next(subject.name + ": " + name);
        MethodRun run;
        run.mesh = subject.name, run.method = name, run.seed = seed, run.repeat = repeat;
        const auto start = std::chrono::steady_clock::now();
        try {
          MethodOutput found = tried.run({subject.mesh, subject.known.references, seed, plan.threads}, steps.inner());
          run.log = std::move(found.log);
          run.stop = found.stop;
          run.search_seconds = found.search_seconds;
          maps.push_back(std::move(found.partner));
        } catch (const Cancelled&) {
          throw;
        } catch (const Error& error) {  // counts as a map without partners
          run.failure = error.what();
          out.notes.push_back(name + " failed on " + subject.name + ": " + error.what());
          maps.emplace_back(subject.mesh.vertices(), -1);
        }
        run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        out.runs.push_back(std::move(run));
      }
  steps.next(subject.name + ": errors");
  const auto evaluations = evaluate_partners(subject.mesh, subject.known.truth, maps, plan.threads, steps.inner());
  for (std::size_t i = 0; i < maps.size(); ++i) out.runs[first + i].evaluation = evaluations[i];
  if (!pictured) return;

  Picture picture;
  picture.mesh = subject.name;
  picture.shape = subject.mesh;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const MethodRun& run = out.runs[first + i];
    if (run.seed == plan.seeds[0] && run.repeat == 1)
      picture.maps.push_back({run.method, maps[i], spread_errors(subject.mesh, evaluations[i])});
  }
  const Surface surface = make_surface(subject.mesh, true);
  const GeodesicSolver solver(surface);
  const std::vector<int> patch = nearest_source(
      evenly_spaced_samples(surface, solver, std::min(100, surface.vertices()), plan.threads, steps.inner()).field);
  picture.patch.assign(subject.mesh.vertices(), -1);
  for (int v = 0; v < surface.vertices(); ++v) picture.patch[surface.mesh_vertex[v]] = patch[v];
  Options options;  // figure 3, and left and right, are what a user gets
  options.references = subject.known.references;
  options.seed = plan.seeds[0];
  options.threads = plan.threads;
  options.largest_component = true;
  const Result found = find_symmetry(subject.mesh, options, steps.inner());
  picture.side = found.partners.side;
  picture.pairs = spread_pairs(subject.mesh, found.partners, 40, steps.inner());
  out.pictures.push_back(std::move(picture));
}

const std::vector<std::pair<const char*, PairError>> kErrors{{"squared", PairError::squared},
                                                             {"linear", PairError::linear}};
constexpr int kSampleCounts[] = {1000, 20000};  // the default; all vertices of meshes like these
constexpr int kRegions[] = {5, 8};
constexpr double kZ[] = {1.0, 1.96, 3.0};

void run_pairs(const Plan& plan, const Subject& subject, Steps& steps, Comparison& out) {
  for (int count : kSampleCounts) {
    const PairsScene scene =
        make_pairs_scene(subject.mesh, subject.known.references, count, plan.threads, steps.inner());
    const PairSamples& samples = scene.samples;
    for (int repeat = 1; repeat <= plan.repeats; ++repeat)
      for (std::uint64_t seed : plan.seeds) {
        steps.next(subject.name + ": durations");
        for (const auto& [name, error] : kErrors) {
          PairsOptions options;
          options.error = error;
          for (const Duration& d : measure_durations(samples, options, seed, steps.inner()))
            out.durations.push_back({subject.name, name, static_cast<int>(samples.left.size()), seed, repeat, d});
        }
      }
    if (count != kSampleCounts[0]) continue;
    for (const auto& [name, error] : kErrors) {
      const double optimum =
          baselines::mean_fitness(samples.left_distance, samples.right_distance,
                                  baselines::tree_matches(samples.left_distance, samples.right_distance, error), error);
      const double threshold = pair_fitness(scene.reference_pair[0], scene.reference_pair[1], error);
      for (std::uint64_t seed : plan.seeds) {
        steps.next(subject.name + ": generations");
        for (int regions : kRegions)
          for (double z : kZ) {
            PairsOptions options;
            options.error = error;
            options.regions = regions;
            options.outlier_z = z;
            options.mutation_barrier_z = -z;
            out.evolutions.push_back({subject.name, name, regions, z, seed, optimum, threshold,
                                      watch_pairs(samples, options, 0, seed, steps.inner())});
          }
      }
    }
  }
}

}  // namespace

std::vector<Subject> read_subjects(const std::vector<std::string>& paths, const std::string& truth,
                                   const Context& context) {
  namespace fs = std::filesystem;
  std::vector<Subject> out;
  std::set<std::string> names;
  for (const std::string& path : paths) {
    Subject s{fs::path(path).stem().string(), read_mesh(path, context), {}};
    if (!names.insert(s.name).second)
      throw InvalidOption("two meshes have the name " + s.name + ": rename one of them");
    std::string folder = truth;
    if (folder.empty()) folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path().string() : ".";
    s.known = read_known_symmetry(path, folder, s.mesh.vertices());
    make_surface(s.mesh, true);  // refused now rather than after an hour
    out.push_back(std::move(s));
  }
  return out;
}

void check_plan(const Plan& plan) {
  if (plan.repeats < 1) throw InvalidOption("repeats must be at least 1, got " + std::to_string(plan.repeats));
  if (plan.seeds.empty() || std::set<std::uint64_t>(plan.seeds.begin(), plan.seeds.end()).size() != plan.seeds.size())
    throw InvalidOption("seeds must be different numbers, at least one");
  std::set<std::string> names;
  for (const std::string& name : plan.methods)
    if (!names.insert(method(name).name).second) throw InvalidOption("methods name " + name + " twice");
  if (names.empty()) throw InvalidOption("methods must name at least one");
}

Comparison measure(const std::vector<Subject>& subjects, const Plan& plan, const Context& context) {
  check_plan(plan);
  Comparison out;
  out.plan = plan;
  out.version = GA_SYMMETRY_VERSION;
  out.machine = machine();
  for (const std::string& name : plan.methods) out.texts.push_back(method(name).text);
  const std::size_t repeats = static_cast<std::size_t>(plan.repeats);
  Steps steps(context,
              subjects.size() * (repeats * plan.seeds.size() * (plan.methods.size() + 2) + 2 * plan.seeds.size() + 1));
  std::size_t next_picture = 0;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Subject& subject = subjects[i];
    out.meshes.push_back(subject.name);
    // Evenly spread over the list.
    const bool pictured = i * std::min(kPictures, subjects.size()) >= next_picture * subjects.size();
    next_picture += pictured;
    run_methods(plan, subject, pictured, steps, out);
    if (subject.known.references.empty())
      out.notes.push_back(subject.name + " has no references: only methods that end in -auto were run on it");
    else
      run_pairs(plan, subject, steps, out);
  }
  return out;
}

}  // namespace ga_symmetry::comparison
