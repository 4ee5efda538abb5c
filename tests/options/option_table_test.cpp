// SPDX-License-Identifier: GPL-3.0-or-later
// Options by name: one table, and what is made of it.
#include "ga_symmetry/option_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ga_symmetry/symmetry.h"
#include "shapes.h"

namespace ga_symmetry {
namespace {

template <class Body>
std::string refusal(const Body& body) {
  try {
    body();
  } catch (const InvalidOption& error) {
    return error.what();
  }
  return "";
}
std::string refusal_of_line(const std::string& line) {
  return refusal([&] {
    Options options;
    set_expert_options(options, line);
  });
}
std::string refusal_of(const std::string& name, const std::string& value) {
  return refusal([&] {
    Options options;
    set_option(options, name, value);
  });
}
std::string refusal_of(const Options& options) {
  return refusal([&] { check_options(options); });
}

// Every field, in the order of the table. A field that is added to an options struct does not compile here before it
// is named, and then lacks its row.
std::vector<double> state(const Options& o) {
  const auto& [method, symmetry, references, seed, threads, proxy, rank, refinement, filter, spectral, fitness,
               component, p, j] = o;
  const auto& [error, samples, sampling, individuals, regions, outlier, barrier, mutation, generations] = p;
  const auto& [j_samples, sites, population, j_generations, j_mutation, turn, ruin, j_outlier, distance, orientation,
               continuity, descriptor, bijectivity, reference] = j;
  return {double(references.axis.size()),
          double(symmetry),
          double(component),
          double(method),
          double(seed),
          double(threads),
          double(proxy),
          double(rank),
          fitness,
          double(j_samples),
          double(sites),
          double(population),
          double(j_generations),
          j_mutation,
          turn,
          ruin,
          j_outlier,
          distance,
          orientation,
          continuity,
          descriptor,
          bijectivity,
          reference,
          double(refinement),
          double(filter),
          double(spectral),
          double(error),
          double(samples),
          double(sampling),
          double(individuals),
          double(regions),
          outlier,
          barrier,
          mutation,
          double(generations)};
}

// A value that is not the default.
std::string other_value(const OptionInfo& info) {
  switch (info.kind) {
    case OptionKind::flag:
      return info.default_value == "true" ? "false" : "true";
    case OptionKind::choice:
      return info.choices[0] == info.default_value ? info.choices[1] : info.choices[0];
    case OptionKind::references:
      return "12";
    case OptionKind::integer:
      return info.name == "joint_sites" || info.name == "proxy" ? "2000" : info.name == "rank" ? "2" : "25";
    case OptionKind::real:
      return info.name == "pairs_barrier" ? "-0.5" : "0.5";
  }
  return "";
}

TEST(OptionTable, EveryOptionTakesItsOwnDefaultAndSetsItsOwnField) {
  const std::vector<double> defaults = state({});
  ASSERT_EQ(option_table().size(), defaults.size());
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    const OptionInfo& info = option_table()[i];
    Options o;
    set_option(o, info.name, info.default_value);
    EXPECT_EQ(state(o), defaults) << info.name;
    set_option(o, info.name, other_value(info));
    const std::vector<double> changed = state(o);
    for (std::size_t k = 0; k < defaults.size(); ++k) EXPECT_EQ(changed[k] != defaults[k], k == i) << info.name;
    EXPECT_EQ(&option_info(info.name), &info);
  }
}

// The comments in options.h name the ranges for who reads the code: [20, 1000].
TEST(OptionTable, HasTheRangesOfTheHeader) {
  std::ifstream in(GA_SYMMETRY_OPTIONS_HEADER);
  ASSERT_TRUE(in);
  const std::regex range(R"(\[(-?[0-9.e]+|-inf), ([0-9.e]+|inf)\])"), begin(R"(struct (\w+))");
  std::map<std::string, std::vector<std::string>> header;
  std::string name;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, begin)) name = match[1];
    if (!std::regex_search(line, match, range)) continue;
    std::ostringstream text;
    text << std::fixed << std::setprecision(0);
    const double low = std::stod(match[1]), high = std::stod(match[2]);
    if (std::isinf(low))
      text << "at most " << high;
    else if (std::isinf(high))
      text << "at least " << low;
    else
      text << low << " to " << high;
    if (line.find("0 = never") != line.npos) text << ", 0 = off";
    header[name].push_back(text.str());
  }
  std::map<std::string, std::vector<std::string>> table;
  for (const OptionInfo& info : option_table())
    if (!info.range.empty() && info.name != "seed")
      table[info.name.rfind("joint_", 0) == 0   ? "JointOptions"
            : info.name.rfind("pairs_", 0) == 0 ? "PairsOptions"
                                                : "Options"]
          .push_back(info.range);
  EXPECT_EQ(header, table);
}

TEST(OptionTable, TooltipsFitTheSmallestDialog) {
  for (const OptionInfo& info : option_table()) {
    EXPECT_EQ(info.label.empty(), info.level == OptionLevel::expert) << info.name;
    EXPECT_FALSE(info.help.empty() || info.help.back() == '.') << info.name;
    const std::size_t method = info.method ? 7 : 0, range = info.range.empty() ? 0 : 2 + info.range.size();
    if (!info.label.empty()) {
      EXPECT_LE(method + info.help.size() + range + 1, 84u) << info.name;
    }
  }
}

TEST(SetOption, RefusesWhatIsNoValueAndChangesNothing) {
  EXPECT_EQ(refusal_of("rank", "31"), "rank must be a whole number, 1 to 30, got \"31\"");
  EXPECT_EQ(refusal_of("rank", "1.5"), "rank must be a whole number, 1 to 30, got \"1.5\"");
  EXPECT_EQ(refusal_of("seed", "-1"), "seed must be a whole number, at least 0, got \"-1\"");
  EXPECT_EQ(refusal_of("joint_ruin", "nan"), "joint_ruin must be a number, 0 to 1, got \"nan\"");
  EXPECT_EQ(refusal_of("noise_filter", "1"), "noise_filter must be true or false, got \"1\"");
  EXPECT_EQ(refusal_of("fitness", "cubic"), "fitness must be squared or linear, got \"cubic\"");
  EXPECT_EQ(refusal_of("proxy", "999"), "proxy must be a whole number, 1000 to 1000000, 0 = off, got \"999\"");
  EXPECT_EQ(refusal_of("rank", "1\n2").find('\n'), std::string::npos);
  EXPECT_NE(refusal_of("rank", "off"), "");
  EXPECT_NE(refusal_of("references", "1,1"), "");
  EXPECT_NE(refusal_of("ranks", "1").find("no option \"ranks\""), std::string::npos);
  EXPECT_THROW(option_info("ranks"), InvalidOption);
  for (const OptionInfo& info : option_table()) {
    Options o;
    for (const char* value : {"", "x", "-1e300", "1e300", "nan", "true false", "1,1"}) {
      try {
        set_option(o, info.name, value);
      } catch (const InvalidOption& error) {
        EXPECT_EQ(std::string(error.what()).rfind(info.name + " ", 0), 0u) << error.what();
        EXPECT_EQ(state(o), state({})) << info.name << " = " << value;
      }
      o = {};
    }
  }
  Options o;
  for (const char* off : {"off", "0"}) {
    o.proxy = 3000;
    set_option(o, "proxy", off);
    EXPECT_EQ(o.proxy, 0);
  }
}

TEST(SetExpertOptions, SetsWhatIsNamedAndNothingElse) {
  Options o;
  set_expert_options(
      o, " joint_sites=400,\tjoint_distance_weight=2.5 fitness=linear,,local_refinement=false pairs_barrier=-3");
  Options wanted;
  wanted.joint.sites = 400;
  wanted.joint.distance_weight = 2.5;
  wanted.pairs.error = PairError::linear;
  wanted.local_refinement = false;
  wanted.pairs.mutation_barrier_z = -3;
  EXPECT_EQ(state(o), state(wanted));
  set_expert_options(o, "");
  EXPECT_EQ(state(o), state(wanted));
}

TEST(SetExpertOptions, RefusesTheRestAndNamesTheKeys) {
  for (const char* text : {"?", "sites=3", "joint_sites", "=3", "joint_sites = 3", "Joint_sites=3", "rank=2"}) {
    EXPECT_NE(refusal_of_line(text).find("joint_sites, joint_population"), std::string::npos) << text;
    EXPECT_NE(refusal_of_line(text).find("pairs_generations"), std::string::npos) << text;
  }
  EXPECT_NE(refusal_of_line("joint_sites=30 joint_sites=30").find("only once"), std::string::npos);
  EXPECT_EQ(refusal_of_line("joint_sites=30.5"), "joint_sites must be a whole number, 20 to 5000, got \"30.5\"");
  for (const char* text : {"joint_sites=", "joint_sites=30=40"}) EXPECT_NE(refusal_of_line(text), "") << text;
  Options o;
  EXPECT_THROW(set_expert_options(o, "joint_sites=400 joint_ruin=2"), InvalidOption);
  EXPECT_EQ(state(o), state({}));
}

TEST(CheckOptions, EveryRangeIsChecked) {
  EXPECT_NO_THROW(check_options({}));
  const auto refuses = [](const char* name, const auto& change) {
    Options o;
    change(o);
    EXPECT_EQ(refusal_of(o).rfind(std::string(name) + " must be ", 0), 0u) << name << ": " << refusal_of(o);
  };
  const double nan = std::nan("");
  refuses("method", [](Options& o) { o.method = static_cast<Method>(2); });
  refuses("symmetry", [](Options& o) { o.symmetry = static_cast<SymmetryKind>(-1); });
  refuses("threads", [](Options& o) { o.threads = -1; });
  refuses("threads", [](Options& o) { o.threads = 257; });
  refuses("proxy", [](Options& o) { o.proxy = 999; });
  refuses("rank", [](Options& o) { o.rank = 0; });
  refuses("max_fitness", [&](Options& o) { o.max_fitness = nan; });
  refuses("joint_samples", [](Options& o) { o.joint.samples = 19; });
  refuses("joint_sites", [](Options& o) { o.joint.sites = 5001; });
  refuses("joint_sites", [](Options& o) { o.joint.sites = o.joint.samples - 1; });
  refuses("joint_population", [](Options& o) { o.joint.population = 3; });
  refuses("joint_generations", [](Options& o) { o.joint.max_generations = -1; });
  refuses("joint_mutation", [&](Options& o) { o.joint.mutation_probability = nan; });
  refuses("joint_turn", [](Options& o) { o.joint.turn_probability = 1.01; });
  refuses("joint_ruin", [](Options& o) { o.joint.ruin_probability = 1.01; });
  refuses("joint_outlier", [](Options& o) { o.joint.outlier_z = -0.1; });
  refuses("joint_distance_weight", [](Options& o) { o.joint.distance_weight = -1; });
  refuses("joint_reference_weight", [](Options& o) { o.joint.reference_weight = 1e7; });
  refuses("pairs_samples", [](Options& o) { o.pairs.samples = 19; });
  refuses("pairs_samples", [](Options& o) { o.pairs.samples = 20001; });
  refuses("pairs_sampling", [](Options& o) { o.pairs.sampling = static_cast<Sampling>(2); });
  refuses("pairs_individuals", [](Options& o) { o.pairs.individuals = 0; });
  refuses("pairs_regions", [](Options& o) { o.pairs.regions = 1; });
  refuses("pairs_outlier", [&](Options& o) { o.pairs.outlier_z = nan; });
  refuses("pairs_barrier", [](Options& o) { o.pairs.mutation_barrier_z = 0.1; });
  refuses("pairs_mutation", [&](Options& o) { o.pairs.mutation_probability = nan; });
  refuses("pairs_generations", [](Options& o) { o.pairs.max_generations = 0; });
  Options o;
  o.proxy = 0;
  EXPECT_NO_THROW(check_options(o));
}

TEST(CheckOptions, ContradictionsAreRefusedBeforeTheMesh) {
  Options o;
  o.method = Method::pairs;
  EXPECT_NE(refusal_of(o).find("four references"), std::string::npos);
  o.references = {{0, 1}, {{2, 3}}};
  EXPECT_NO_THROW(check_options(o));
  o.symmetry = SymmetryKind::rotation;
  EXPECT_NE(refusal_of(o).find("reflections only"), std::string::npos);
  EXPECT_THROW(find_symmetry({}, o), InvalidOption);
}

std::set<std::string> idle_names(const Options& o, bool listing, bool changed_only = false) {
  std::set<std::string> out;
  for (const IdleOption& idle : idle_options(o, listing))
    if (idle.changed || !changed_only) out.insert(idle.name);
  return out;
}

TEST(IdleOptions, AreThoseOfTheOtherMethod) {
  Options o;
  o.references = {{0, 1}, {{2, 3}}};
  for (const Method method : {Method::joint, Method::pairs}) {
    o.method = method;
    std::set<std::string> others;
    for (const OptionInfo& info : option_table())
      if (info.method && *info.method != method) others.insert(info.name);
    EXPECT_EQ(idle_names(o, false), others);
  }
  const std::set<std::string> idle = idle_names(o, false);
  for (const char* name : {"rank", "proxy", "noise_filter", "local_refinement", "joint_sites"})
    EXPECT_TRUE(idle.count(name)) << name;
  EXPECT_TRUE(idle_names(o, false, true).empty());
  o.rank = 2;
  EXPECT_EQ(idle_names(o, false, true), std::set<std::string>{"rank"});
}

TEST(IdleOptions, AReferenceWeightNeedsReferences) {
  Options o;
  EXPECT_TRUE(idle_names(o, false).count("joint_reference_weight"));
  EXPECT_TRUE(idle_names(o, true).count("joint_reference_weight"));
  o.references.axis = {3};
  EXPECT_FALSE(idle_names(o, false).count("joint_reference_weight"));
}

TEST(IdleOptions, AListHasBothKindsAndAllRanks) {
  const std::set<std::string> idle = idle_names({}, true);
  for (const char* name : {"symmetry", "rank", "method", "max_fitness", "noise_filter", "fitness", "pairs_samples"})
    EXPECT_TRUE(idle.count(name)) << name;
  for (const char* name : {"references", "seed", "threads", "proxy", "largest_component", "joint_sites"})
    EXPECT_FALSE(idle.count(name)) << name;
}

TEST(IdleOptions, AreNamedInAWarningIfTheyWereChanged) {
  const TriangleMesh mesh = shapes::body();
  Options o;
  o.joint.samples = 30, o.joint.population = 4, o.joint.max_generations = 1;
  EXPECT_EQ(find_symmetry(mesh, o).warnings, std::vector<std::string>{});
  o.joint.reference_weight = 2;
  o.pairs.samples = 100;
  EXPECT_EQ(find_symmetry(mesh, o).warnings,
            (std::vector<std::string>{"joint_reference_weight does nothing without references",
                                      "pairs_samples does nothing with the method joint"}));
}

}  // namespace
}  // namespace ga_symmetry
