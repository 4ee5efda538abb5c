// ga_symmetry compare: this program's searches and others' side by side, where the truth is known.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "arguments.h"
#include "baselines/pair_search.h"
#include "commands.h"
#include "dataset.h"
#include "durations.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/version.h"
#include "geodesics/sampling.h"
#include "methods.h"
#include "report.h"

namespace ga_symmetry::tool {
namespace {

constexpr std::size_t kPictures = 6;  // meshes that are drawn

struct Arguments {
  std::vector<std::string> meshes;
  std::string truth, output;
  std::vector<std::uint64_t> seeds{1, 2, 3};
  std::vector<std::string> methods{"naive",   "kdtree", "pairs-squared", "pairs-linear",  "features",     "spectral",
                                   "zoomout", "joint",  "joint-zoomout", "spectral-auto", "zoomout-auto", "joint-auto"};
  int repeats = 1, threads = 0;
};

struct Subject {
  std::string name;
  TriangleMesh mesh;
  bench::KnownSymmetry known;
};

std::vector<Subject> read_subjects(const Arguments& a, const Context& context) {
  namespace fs = std::filesystem;
  std::vector<Subject> out;
  std::set<std::string> names;
  for (const std::string& path : a.meshes) {
    Subject s{fs::path(path).stem().string(), read_mesh(path, context), {}};
    if (!names.insert(s.name).second)
      throw InvalidOption("two meshes have the name " + s.name + ": rename one of them");
    std::string folder = a.truth;
    if (folder.empty()) folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path().string() : ".";
    s.known = bench::read_known_symmetry(path, folder, s.mesh.vertices());
    make_surface(s.mesh, true);  // refused now rather than after an hour
    out.push_back(std::move(s));
  }
  return out;
}

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

void run_methods(const Arguments& a, const Subject& subject, bool pictured, Steps& steps, Comparison& out) {
  const std::size_t first = out.runs.size();
  std::vector<std::vector<int>> maps;
  for (int repeat = 1; repeat <= a.repeats; ++repeat)
    for (std::uint64_t seed : a.seeds)
      for (const std::string& name : a.methods) {
        const bench::Method& method = bench::method(name);
        if (!method.random && seed != a.seeds[0]) continue;
        if (method.references && subject.known.references.empty()) continue;
        steps.next(subject.name + ": " + name);
        MethodRun run;
        run.mesh = subject.name, run.method = name, run.seed = seed, run.repeat = repeat;
        const auto start = std::chrono::steady_clock::now();
        try {
          bench::MethodOutput found =
              method.run({subject.mesh, subject.known.references, seed, a.threads}, steps.inner());
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
  const auto evaluations = evaluate_partners(subject.mesh, subject.known.truth, maps, a.threads, steps.inner());
  for (std::size_t i = 0; i < maps.size(); ++i) out.runs[first + i].evaluation = evaluations[i];
  if (!pictured) return;

  Picture picture;
  picture.mesh = subject.name;
  picture.shape = subject.mesh;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const MethodRun& run = out.runs[first + i];
    if (run.seed == a.seeds[0] && run.repeat == 1)
      picture.maps.push_back({run.method, maps[i], spread_errors(subject.mesh, evaluations[i])});
  }
  const Surface surface = make_surface(subject.mesh, true);
  const GeodesicSolver solver(surface);
  const std::vector<int> patch = nearest_source(
      evenly_spaced_samples(surface, solver, std::min(100, surface.vertices()), a.threads, steps.inner()).field);
  picture.patch.assign(subject.mesh.vertices(), -1);
  for (int v = 0; v < surface.vertices(); ++v) picture.patch[surface.mesh_vertex[v]] = patch[v];
  Options options;  // figure 3, and left and right, are what a user gets
  options.references = subject.known.references;
  options.seed = a.seeds[0];
  options.threads = a.threads;
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

void run_pairs(const Arguments& a, const Subject& subject, Steps& steps, Comparison& out) {
  for (int count : kSampleCounts) {
    const bench::PairsScene scene =
        bench::make_pairs_scene(subject.mesh, subject.known.references, count, a.threads, steps.inner());
    const PairSamples& samples = scene.samples;
    for (int repeat = 1; repeat <= a.repeats; ++repeat)
      for (std::uint64_t seed : a.seeds) {
        steps.next(subject.name + ": durations");
        for (const auto& [name, error] : kErrors) {
          PairsOptions options;
          options.error = error;
          for (const bench::Duration& d : bench::measure_durations(samples, options, seed, steps.inner()))
            out.durations.push_back({subject.name, name, static_cast<int>(samples.left.size()), seed, repeat, d});
        }
      }
    if (count != kSampleCounts[0]) continue;
    for (const auto& [name, error] : kErrors) {
      const double optimum =
          baselines::mean_fitness(samples.left_distance, samples.right_distance,
                                  baselines::tree_matches(samples.left_distance, samples.right_distance, error), error);
      const double threshold = pair_fitness(scene.reference_pair[0], scene.reference_pair[1], error);
      for (std::uint64_t seed : a.seeds) {
        steps.next(subject.name + ": generations");
        for (int regions : kRegions)
          for (double z : kZ) {
            PairsOptions options;
            options.error = error;
            options.regions = regions;
            options.outlier_z = z;
            options.mutation_barrier_z = -z;
            out.evolutions.push_back({subject.name, name, regions, z, seed, optimum, threshold,
                                      bench::watch_pairs(samples, options, 0, seed, steps.inner())});
          }
      }
    }
  }
}

std::string join(const std::vector<std::string>& words, const char* between = ",") {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : between) + w;
  return out;
}

// The call with all its defaults, as one would type it.
std::string command_line(const Arguments& a) {
  std::vector<std::string> words{"ga_symmetry", "compare"}, seeds;
  const auto add = [&](std::string word) {
    if (word.find_first_of(" '\"$&;()*?<>|\\") != word.npos) word = "'" + word + "'";
    words.push_back(word);
  };
  for (std::uint64_t seed : a.seeds) seeds.push_back(std::to_string(seed));
  for (const std::string& mesh : a.meshes) add(mesh);
  if (!a.truth.empty()) words.push_back("--truth"), add(a.truth);
  words.push_back("--seeds"), add(join(seeds));
  words.push_back("--methods"), add(join(a.methods));
  words.push_back("--repeats"), add(std::to_string(a.repeats));
  if (a.threads) words.push_back("--threads"), add(std::to_string(a.threads));
  words.push_back("-o"), add(a.output);
  return join(words, " ");
}

void run(const Arguments& a, const Context& interrupt) {
  check_report_folder(a.output);
  if (a.repeats < 1) throw CLI::ValidationError("--repeats", "must be at least 1");
  if (std::set<std::uint64_t>(a.seeds.begin(), a.seeds.end()).size() != a.seeds.size())
    throw CLI::ValidationError("--seeds", "must be different numbers");
  Comparison out;
  for (const std::string& name : a.methods) {
    if (std::count(out.methods.begin(), out.methods.end(), name))
      throw CLI::ValidationError("--methods", "names " + name + " twice");
    out.texts.push_back(bench::method(name).text);
    out.methods.push_back(name);
  }
  out.command = command_line(a);
  out.version = GA_SYMMETRY_VERSION;
  out.machine = machine();
  out.seeds = a.seeds;
  out.repeats = a.repeats;
  out.threads = a.threads;

  ProgressBar bar;
  const Context context = bar.watch(interrupt);
  context.report(0, "reading");
  const std::vector<Subject> subjects = read_subjects(a, interrupt);
  const std::size_t repeats = static_cast<std::size_t>(a.repeats);
  Steps steps(context,
              subjects.size() * (repeats * a.seeds.size() * (a.methods.size() + 2) + 2 * a.seeds.size() + 1) + 1);
  std::size_t next_picture = 0;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Subject& subject = subjects[i];
    out.meshes.push_back(subject.name);
    // Evenly spread over the list.
    const bool pictured = i * std::min(kPictures, subjects.size()) >= next_picture * subjects.size();
    next_picture += pictured;
    run_methods(a, subject, pictured, steps, out);
    if (subject.known.references.empty())
      out.notes.push_back(subject.name + " has no references: only methods that end in -auto were run on it");
    else
      run_pairs(a, subject, steps, out);
  }
  context.report(1, "report");
  const std::vector<std::string> messages = write_report(a.output, out, steps.inner());
  bar.clear();
  for (const std::string& message : messages) std::fprintf(stderr, "ga_symmetry: %s\n", message.c_str());
  std::printf("%s\n", (std::filesystem::path(a.output) / "report.html").string().c_str());
}

}  // namespace

void add_compare(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      *app.add_subcommand("compare", "Compare the searches with other methods, where the truth is known");
  command.add_option("MESH", arguments->meshes, "Triangle meshes: .ply, .off, .obj or .stl")->required()->type_name("");
  command
      .add_option("--truth", arguments->truth,
                  "Folder with NAME.truth and NAME.refs, or NAME.vts and NAME.sym.vts, or NAME.pid and NAME.sym.info; "
                  "without it each mesh's own")
      ->type_name("DIR");
  command.add_option("-o,--output", arguments->output, "Folder for the report, which must not exist")
      ->required()
      ->type_name("DIR");
  command.add_option("--seeds", arguments->seeds, "Of the random numbers [1,2,3]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("N,N");
  std::vector<std::string> names;
  for (const bench::Method& m : bench::methods()) names.push_back(m.name);
  command
      .add_option("--methods", arguments->methods,
                  "Of " + join(names, ", ") + " [all but zoomout-full and joint-zoomout-auto]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,NAME");
  command.add_option("--repeats", arguments->repeats, "Each method so often, for the times")->capture_default_str();
  add_threads(command, arguments->threads);
  command.footer(
      "Writes report.html, which needs no network, and CSV files of every number. Plots take python3-matplotlib.\n\n"
      "Examples:\n"
      "  ga_symmetry compare sample_meshes/person_*.off -o report\n"
      "  ga_symmetry compare scans/*.off --truth landmarks --seeds 1,2,3,4,5 --repeats 3 -o report\n"
      "  ga_symmetry compare body.off --methods joint,zoomout,naive -o report");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
