// The report of a comparison: CSV files of every number, and a page with tables and plots.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "durations.h"
#include "ga_symmetry/context.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/result.h"

namespace ga_symmetry::tool {

/// One method on one mesh.
struct MethodRun {
  std::string mesh, method;
  std::uint64_t seed = 0;
  int repeat = 1;
  double seconds = 0;
  Evaluation evaluation;
  std::string failure;             ///< why there are no partners; empty = there are
  std::vector<GenerationLog> log;  ///< of genetic searches
  StopReason stop = StopReason::max_generations;
  double search_seconds = 0;
};

/// One search of table 1.
struct DurationRun {
  std::string mesh, error;
  int samples = 0;  ///< on each side
  std::uint64_t seed = 0;
  int repeat = 1;
  bench::Duration duration;
};

/// One curve of figure 2.
struct EvolutionRun {
  std::string mesh, error;
  int regions = 0;
  double z = 0;
  std::uint64_t seed = 0;
  double optimum = 0, success_threshold = 0;
  bench::Evolution evolution;
};

/// What is drawn of one mesh.
struct Picture {
  struct Map {
    std::string method;
    std::vector<int> partner;   ///< per vertex
    std::vector<double> error;  ///< per vertex: of the measured vertex nearest to it
  };
  std::string mesh;
  TriangleMesh shape;
  std::vector<Map> maps;
  std::vector<int> side;             ///< per vertex: +1 left, 0 axis, -1 right
  std::vector<int> patch;            ///< per vertex: its nearest sample, -1 = none
  std::vector<SymmetricPair> pairs;  ///< evenly spread
};

struct Comparison {
  std::string command, version, machine;
  std::vector<std::uint64_t> seeds;
  int repeats = 1, threads = 0;
  std::vector<std::string> meshes, methods;
  std::vector<std::string> texts;  ///< per method: what it is
  std::vector<MethodRun> runs;
  std::vector<DurationRun> durations;
  std::vector<EvolutionRun> evolutions;
  std::vector<Picture> pictures;
  std::vector<std::string> notes;  ///< what was left out, one line each
};

/// A report can be made there. @throws InvalidOption, FileError
void check_report_folder(const std::string& folder);

/// Writes runs.csv, methods.csv, durations.csv, generations.csv, error_curves.csv and report.html. The folder appears
/// whole or not at all. Plots are drawn by comparison_plots.py with matplotlib; without it the page has tables only.
/// @return what the user should know, one line each
/// @throws FileError, Cancelled
std::vector<std::string> write_report(const std::string& folder, const Comparison& comparison, const Context& context);

}  // namespace ga_symmetry::tool
