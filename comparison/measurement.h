// SPDX-License-Identifier: GPL-3.0-or-later
// Methods on meshes whose symmetry is known: what is measured, and the figures.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dataset.h"
#include "durations.h"
#include "ga_symmetry/context.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/result.h"

namespace ga_symmetry::comparison {

/// A mesh and what is known of its symmetry.
struct Subject {
  std::string name;  ///< the file's, without its ending
  TriangleMesh mesh;
  KnownSymmetry known;
};

/// What is measured.
struct Plan {
  std::vector<std::string> methods;     ///< names as in methods.h, all different
  std::vector<std::uint64_t> seeds{1};  ///< all different; methods without random numbers run with the first only
  int repeats = 1;                      ///< of every method, for the times, >= 1
  int threads = 0;                      ///< 0 = all cores
};

/// One method on one mesh.
struct MethodRun {
  std::string mesh, method;
  std::uint64_t seed = 0;
  int repeat = 1;      ///< counted from 1
  double seconds = 0;  ///< wall clock, from the mesh in memory to its partners
  Evaluation evaluation;
  std::string failure;             ///< why there are no partners; empty = there are
  std::vector<GenerationLog> log;  ///< of genetic searches
  StopReason stop = StopReason::max_generations;
  double search_seconds = 0;  ///< of genetic searches: of all generations together
};

/// One search of pairs, as in table 1 of the paper.
struct DurationRun {
  std::string mesh, error;
  int samples = 0;  ///< on each side
  std::uint64_t seed = 0;
  int repeat = 1;
  Duration duration;
};

/// Fitness against generation, as in figure 2 of the paper: one curve.
struct EvolutionRun {
  std::string mesh, error;
  int regions = 0;
  double z = 0;
  std::uint64_t seed = 0;
  double optimum = 0;            ///< lowest mean fitness that there is
  double success_threshold = 0;  ///< fitness of the reference pair
  Evolution evolution;
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
  Plan plan;
  std::string version;              ///< of this library
  std::string machine;              ///< processor and its threads
  std::vector<std::string> texts;   ///< per method of the plan: what it is
  std::vector<std::string> meshes;  ///< names
  std::vector<MethodRun> runs;
  std::vector<DurationRun> durations;
  std::vector<EvolutionRun> evolutions;
  std::vector<Picture> pictures;
  std::vector<std::string> notes;  ///< what was left out, one line each
};

/// @param paths  of meshes
/// @param truth  folder with what is known of them, see read_known_symmetry; empty = each mesh's own
/// @throws FileError, InvalidMesh  as read_mesh, read_known_symmetry and the search: now rather than after an hour
/// @throws InvalidOption           if two meshes have the same name
/// @throws Cancelled
std::vector<Subject> read_subjects(const std::vector<std::string>& paths, const std::string& truth,
                                   const Context& context);

/// A plan can be measured. @throws InvalidOption  if it is not as described there
void check_plan(const Plan& plan);

/// Runs every method of the plan on every subject, in turn. One that fails counts as a map without partners, with a
/// note. Meshes without references: only methods that need none.
/// @throws InvalidOption  as check_plan
/// @throws Cancelled
Comparison measure(const std::vector<Subject>& subjects, const Plan& plan, const Context& context);

}  // namespace ga_symmetry::comparison
