// SPDX-License-Identifier: GPL-3.0-or-later
// Every method of the comparison behind one call: a mesh in, partners out.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ga_symmetry/symmetry.h"

namespace ga_symmetry::comparison {

struct MethodInput {
  const TriangleMesh& mesh;
  References references;  ///< of the mesh; empty = none known
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = all cores
};

struct MethodOutput {
  std::vector<int> partner;        ///< per vertex of the mesh, -1 = none
  std::vector<GenerationLog> log;  ///< of genetic searches
  StopReason stop = StopReason::max_generations;
  double search_seconds = 0;  ///< of genetic searches: of all generations together
};

struct Method {
  std::string name;
  std::string text;  ///< what it is, for tables
  bool references;   ///< given the references; cannot do without two axis vertices and a pair
  bool random;       ///< the seed matters
  /// Everything from the mesh in memory to its partners. Works on the largest component.
  /// @throws InvalidMesh, Cancelled
  std::function<MethodOutput(const MethodInput&, const Context&)> run;
};

/// All of them. A name ends in -auto where a method that could use references goes without.
const std::vector<Method>& methods();
/// By name. @throws InvalidOption  that lists the names
const Method& method(const std::string& name);

}  // namespace ga_symmetry::comparison
