// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/option_table.h"

#include <array>
#include <charconv>
#include <limits>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

using Words = std::vector<std::string_view>;  // of an enumeration, in its order

struct Choice {
  Words words;
  std::variant<Method*, SymmetryKind*, PairError*, Sampling*> field;
};

// Where the value stands in an Options.
using Field = std::variant<bool*, int*, std::uint64_t*, double*, Choice, References*>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 1e6;  // weights and fitnesses: sums and squares stay finite in single precision

// Of a number. With `off`, 0 is allowed too and switches off what the option is for.
struct Range {
  double low = -kInfinity, high = kInfinity;
  bool off = false;
};

constexpr Range between(double low, double high) { return {low, high, false}; }
constexpr Range or_off(double low, double high) { return {low, high, true}; }

// What looks at an option.
enum Use : unsigned {
  kJoint = 1,
  kPairs = 2,
  kFind = kJoint | kPairs,
  kList = 4,
  kJointAndList = kJoint | kList,
  kAlways = kFind | kList,
  kBesideReferences = 8  // and only then
};

struct Entry {
  std::string_view name;
  OptionLevel level;
  unsigned use;
  Field field;
  Range range;
  const char* label;
  const char* help;
};

// A tooltip of MeshLab 2020.09 shows 84 letters, and with them the range: that is what help of a label may be long.
std::vector<Entry> entries(Options& o) {
  constexpr OptionLevel basic = OptionLevel::basic, advanced = OptionLevel::advanced, expert = OptionLevel::expert;
  constexpr Range any{}, share = between(0, 1), not_negative = between(0, kInfinity), weight = between(0, kLargest);
  JointOptions& j = o.joint;
  PairsOptions& p = o.pairs;
  return {
      {"references", basic, kAlways, &o.references, any, "References",
       "a0,a1,l,r: axis points, a left-right pair; or 3,8,12:57,90:4"},
      {"symmetry", basic, kFind, Choice{{"reflection", "rotation", "any"}, &o.symmetry}, any, "Symmetry",
       "A reflection swaps left and right, a rotation turns; any: what fits"},
      {"largest_component", basic, kAlways, &o.largest_component, any, "Only the largest component",
       "Leave all other parts out; the largest by area and vertices"},
      {"method", basic, kFind, Choice{{"joint", "pairs"}, &o.method}, any, "Method",
       "joint: all partners at once; pairs: the original way, one by one, with references"},
      {"seed", advanced, kAlways, &o.seed, not_negative, "Seed", "The same seed and mesh give the same result"},
      {"threads", advanced, kAlways, &o.threads, between(0, 256), "Threads",
       "0 = all cores; changes the time, never the result"},
      {"proxy", advanced, kJointAndList, &o.proxy, or_off(1000, 1e6), "Simplify to",
       "Larger meshes are searched with so many vertices"},
      {"rank", advanced, kJoint, &o.rank, between(1, 30), "Symmetry by rank",
       "1 = the best symmetry that is found, 2 = the next best and so on"},
      {"max_fitness", advanced, kFind, &o.max_fitness, between(0, kLargest), "Largest fitness",
       "Vertices above have no partner: -1; try 0.1, 0 = keep all"},

      {"joint_samples", advanced, kJointAndList, &j.samples, between(20, 1000), "Samples",
       "Evenly spaced, what the search works on"},
      {"joint_sites", expert, kJointAndList, &j.sites, between(20, 5000), "",
       "Evenly spaced candidates for the samples' partners, not fewer than the samples"},
      {"joint_population", expert, kJointAndList, &j.population, between(4, 10000), "", "Maps in competition"},
      {"joint_generations", expert, kJointAndList, &j.max_generations, between(0, 10000), "", "Generations at most"},
      {"joint_mutation", expert, kJointAndList, &j.mutation_probability, share, "",
       "Probability per gene and generation"},
      {"joint_turn", expert, kJointAndList, &j.turn_probability, share, "",
       "Probability of a child to have a region turned"},
      {"joint_ruin", expert, kJointAndList, &j.ruin_probability, share, "",
       "Probability of any other child to have a region made anew"},
      {"joint_outlier", expert, kJointAndList, &j.outlier_z, not_negative, "",
       "Genes of a Z-score above look at all candidates"},
      {"joint_distance_weight", expert, kJointAndList, &j.distance_weight, weight, "",
       "Distances between the samples are kept"},
      {"joint_orientation_weight", expert, kJointAndList, &j.orientation_weight, weight, "",
       "Turning directions are reversed (reflection) or kept (rotation)"},
      {"joint_continuity_weight", expert, kJointAndList, &j.continuity_weight, weight, "",
       "Neighbours go to neighbours"},
      {"joint_descriptor_weight", expert, kJointAndList, &j.descriptor_weight, weight, "", "Partners look alike"},
      {"joint_bijectivity_weight", expert, kJointAndList, &j.bijectivity_weight, weight, "",
       "No two samples have one partner"},
      {"joint_reference_weight", expert, kJointAndList | kBesideReferences, &j.reference_weight, weight, "",
       "Distances to the references are kept"},
      {"local_refinement", expert, kJoint, &o.local_refinement, any, "",
       "Move the samples' partners together to where distances agree best, then all to where the shape around fits"},
      {"noise_filter", expert, kJoint, &o.noise_filter, any, "",
       "Average over neighbours by how much distances to a partner are off"},
      {"spectral_refinement", expert, kJoint, &o.spectral_refinement, any, "",
       "Move partners to where smooth functions on the surface agree"},

      {"fitness", expert, kPairs, Choice{{"squared", "linear"}, &p.error}, any, "",
       "Relative error of the distances to the axis points"},
      {"pairs_samples", expert, kPairs, &p.samples, between(20, 20000), "", "On both sides together"},
      {"pairs_sampling", expert, kPairs, Choice{{"even", "uniform"}, &p.sampling}, any, "",
       "Samples that are evenly spaced, or uniformly random"},
      {"pairs_individuals", expert, kPairs, &p.individuals, between(1, 100), "",
       "Pairs in competition per reference vertex"},
      {"pairs_regions", expert, kPairs, &p.regions, between(2, 100), "",
       "Distance regions per axis point, for the crossover"},
      {"pairs_outlier", expert, kPairs, &p.outlier_z, not_negative, "", "A pair whose Z-error is above is mutated"},
      {"pairs_barrier", expert, kPairs, &p.mutation_barrier_z, between(-kInfinity, 0), "",
       "A pair whose Z-error is below is kept as it is"},
      {"pairs_mutation", expert, kPairs, &p.mutation_probability, share, "", "Probability per pair and generation"},
      {"pairs_generations", expert, kPairs, &p.max_generations, between(1, 100000), "", "Generations at most"},
  };
}

template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// A bound, which is a whole number; 1000000 and not 1e+06.
std::string bound_text(double value) { return number_text(static_cast<long long>(value)); }

std::string range_text(const Range& range) {
  if (range.low == -kInfinity && range.high == kInfinity) return "";
  if (range.high == kInfinity) return "at least " + bound_text(range.low);
  if (range.low == -kInfinity) return "at most " + bound_text(range.high);
  return bound_text(range.low) + " to " + bound_text(range.high) + (range.off ? ", 0 = off" : "");
}

std::string joined(const Words& words, const char* separator) {
  std::string out;
  for (const std::string_view word : words) out += (out.empty() ? "" : separator) + std::string(word);
  return out;
}

std::size_t index_of(const Choice& choice) {
  return std::visit([](const auto* field) { return static_cast<std::size_t>(*field); }, choice.field);
}

// The value as text.
struct Get {
  std::string operator()(bool* field) const { return *field ? "true" : "false"; }
  template <class Number>
  std::string operator()(Number* field) const {
    return number_text(*field);
  }
  std::string operator()(const Choice& choice) const {
    const std::size_t index = index_of(choice);
    return index < choice.words.size() ? std::string(choice.words[index]) : number_text(index);
  }
  std::string operator()(References* references) const {
    std::string out;
    for (int v : references->axis) out += (out.empty() ? "" : ",") + number_text(v);
    for (const auto& [l, r] : references->pairs)
      out += (out.empty() ? "" : ",") + number_text(l) + ":" + number_text(r);
    return out;
  }
};

// Sets the value, and tells whether the text is one.
struct Set {
  std::string_view text;
  const Range& range;
  bool operator()(bool* field) const {
    *field = text == "true";
    return *field || text == "false";
  }
  template <class Number>
  bool operator()(Number* field) const {
    const auto value = range.off && text == "off" ? Number{0} : parse_number<Number>(text);
    if (value) *field = *value;
    return value.has_value();
  }
  bool operator()(const Choice& choice) const {
    for (std::size_t i = 0; i < choice.words.size(); ++i)
      if (text == choice.words[i]) {
        std::visit([&](auto* field) { *field = static_cast<std::decay_t<decltype(*field)>>(i); }, choice.field);
        return true;
      }
    return false;
  }
  bool operator()(References* references) const {
    *references = parse_references(std::string(text));  // which says more than a rule does
    return true;
  }
};

// Tells whether the value is allowed.
struct Check {
  const Range& range;
  bool operator()(bool*) const { return true; }
  template <class Number>
  bool operator()(Number* field) const {
    const auto value = static_cast<double>(*field);
    return (value >= range.low && value <= range.high) || (range.off && value == 0);  // rejects NaN too
  }
  bool operator()(const Choice& choice) const { return index_of(choice) < choice.words.size(); }
  bool operator()(References*) const { return true; }  // they need the mesh
};

// What a value must be, in words.
struct Rule {
  const Range& range;
  std::string operator()(bool*) const { return "true or false"; }
  template <class Number>
  std::string operator()(Number*) const {
    const std::string in = range_text(range);
    return (std::is_same_v<Number, double> ? "a number" : "a whole number") + (in.empty() ? "" : ", " + in);
  }
  std::string operator()(const Choice& choice) const { return joined(choice.words, " or "); }
  std::string operator()(References*) const { return "vertex indices"; }
};

struct KindOf {
  OptionKind operator()(bool*) const { return OptionKind::flag; }
  template <class Number>
  OptionKind operator()(Number*) const {
    return std::is_same_v<Number, double> ? OptionKind::real : OptionKind::integer;
  }
  OptionKind operator()(const Choice&) const { return OptionKind::choice; }
  OptionKind operator()(References*) const { return OptionKind::references; }
};

[[noreturn]] void refuse(const Entry& entry, const std::string& got) {
  throw InvalidOption(std::string(entry.name) + " must be " + std::visit(Rule{entry.range}, entry.field) + ", got " +
                      got);
}

void set(const Entry& entry, std::string_view value) {
  if (!std::visit(Set{value, entry.range}, entry.field) || !std::visit(Check{entry.range}, entry.field))
    refuse(entry, quoted(value));
}

}  // namespace

const std::vector<OptionInfo>& option_table() {
  static const std::vector<OptionInfo> table = [] {
    Options defaults;
    std::vector<OptionInfo> out;
    for (const Entry& e : entries(defaults)) {
      OptionInfo info;
      info.name = e.name;
      info.kind = std::visit(KindOf{}, e.field);
      info.level = e.level;
      if ((e.use & kFind) != kFind) info.method = e.use & kJoint ? Method::joint : Method::pairs;
      if (const auto* choice = std::get_if<Choice>(&e.field))
        info.choices.assign(choice->words.begin(), choice->words.end());
      info.range = range_text(e.range);
      info.default_value = std::visit(Get{}, e.field);
      info.label = e.label;
      info.help = e.help;
      out.push_back(std::move(info));
    }
    return out;
  }();
  return table;
}

const OptionInfo& option_info(const std::string& name) {
  for (const OptionInfo& info : option_table())
    if (info.name == name) return info;
  throw InvalidOption("there is no option " + quoted(name));
}

void set_option(Options& options, const std::string& name, const std::string& value) {
  option_info(name);
  Options changed = options;
  for (const Entry& e : entries(changed))
    if (e.name == name) set(e, value);
  options = std::move(changed);
}

void set_expert_options(Options& options, const std::string& line) {
  Options changed = options;
  const std::vector<Entry> known = entries(changed);
  std::set<std::string_view> seen;
  for (const std::string_view item : split(line, ", \t\r\n")) {
    const std::size_t equals = item.find('=');
    const std::string_view name = item.substr(0, equals);
    Words names;
    const Entry* entry = nullptr;
    for (const Entry& e : known)
      if (e.level == OptionLevel::expert) {
        if (e.name == name) entry = &e;
        names.push_back(e.name);
      }
    const auto refuse_item = [&](const std::string& rule) {
      throw InvalidOption("advanced options must " + rule + ", got " + quoted(item));
    };
    if (!entry || equals == item.npos)
      refuse_item("be key=value, without blanks around the =, with the keys " + joined(names, ", "));
    if (!seen.insert(name).second) refuse_item("name " + std::string(name) + " only once");
    set(*entry, item.substr(equals + 1));
  }
  options = std::move(changed);
}

std::vector<IdleOption> idle_options(const Options& options, bool listing) {
  Options copy = options, defaults;
  const std::vector<Entry> given = entries(copy), usual = entries(defaults);
  const unsigned used = listing ? kList : options.method == Method::joint ? kJoint : kPairs;
  std::vector<IdleOption> out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    std::string why;
    if (!(given[i].use & used))
      why = listing ? "when symmetries are listed" : used == kJoint ? "with the method joint" : "with the method pairs";
    else if (given[i].use & kBesideReferences && options.references.empty())
      why = "without references";
    else
      continue;
    out.push_back(
        {std::string(given[i].name), why, std::visit(Get{}, given[i].field) != std::visit(Get{}, usual[i].field)});
  }
  return out;
}

void check_options(const Options& options) {
  Options o = options;
  for (const Entry& e : entries(o))
    if (!std::visit(Check{e.range}, e.field)) refuse(e, std::visit(Get{}, e.field));
  if (o.joint.sites < o.joint.samples)
    throw InvalidOption("joint_sites must be at least joint_samples, which is " + number_text(o.joint.samples) +
                        ", got " + number_text(o.joint.sites));
  if (o.method == Method::pairs) {
    if (o.symmetry == SymmetryKind::rotation)
      throw InvalidOption("the method `pairs` finds reflections only: use the method `joint` for rotations");
    if (o.references.axis.size() != 2 || o.references.pairs.size() != 1)
      throw InvalidOption("the method `pairs` needs four references, two on the axis and one pair (a0,a1,l,r)");
  }
}

}  // namespace ga_symmetry
