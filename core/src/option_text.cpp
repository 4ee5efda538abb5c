#include "option_text.h"

#include <cstdio>
#include <set>
#include <variant>

#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

using Words = std::vector<std::string_view>;  // of an enumeration, in its order

struct Choice {
  Words words;
  std::variant<PairError*, Sampling*> field;
};

struct Entry {
  std::string_view key;
  std::variant<bool*, int*, double*, Choice> field;
  const char* meaning;
};

std::vector<Entry> entries(Options& o) {
  JointOptions& j = o.joint;
  PairsOptions& p = o.pairs;
  return {
      {"local_refinement", &o.local_refinement, "Joint: move all partners of samples to where distances agree best."},
      {"noise_filter", &o.noise_filter, "Joint: average over neighbours how far distances are off."},
      {"joint_sites", &j.sites, "Evenly spaced candidates for the samples' partners, the samples to 5000."},
      {"joint_population", &j.population, "Maps in competition, 4 to 10000."},
      {"joint_generations", &j.max_generations, "At most, 0 to 10000."},
      {"joint_mutation", &j.mutation_probability, "Per gene and generation, 0 to 1."},
      {"joint_ruin", &j.ruin_probability, "Of a child to have a region made anew, 0 to 1."},
      {"joint_outlier", &j.outlier_z, "Genes of a Z-score above look at all candidates; at least 0."},
      {"joint_distance_weight", &j.distance_weight, "Distances between the samples are kept; at least 0."},
      {"joint_orientation_weight", &j.orientation_weight,
       "Turning directions are reversed (reflection) or kept (rotation); at least 0."},
      {"joint_continuity_weight", &j.continuity_weight, "Neighbours go to neighbours; at least 0."},
      {"joint_descriptor_weight", &j.descriptor_weight, "Partners look alike; at least 0."},
      {"joint_bijectivity_weight", &j.bijectivity_weight, "No two samples have one partner; at least 0."},
      {"joint_reference_weight", &j.reference_weight, "Distances to the references are kept; at least 0."},
      {"fitness", Choice{{"squared", "linear"}, &p.error},
       "Pairs: squared or linear, the relative error of the distances to the axis points."},
      {"pairs_samples", &p.samples, "On both sides together, 20 to 20000."},
      {"pairs_sampling", Choice{{"even", "uniform"}, &p.sampling}, "even or uniform: how the samples are chosen."},
      {"pairs_individuals", &p.individuals, "Pairs in competition per reference vertex, 1 to 100."},
      {"pairs_regions", &p.regions, "Distance regions per axis point, for the crossover, 2 to 100."},
      {"pairs_outlier", &p.outlier_z, "A pair whose Z-error is above is mutated; at least 0."},
      {"pairs_barrier", &p.mutation_barrier_z, "A pair whose Z-error is below is kept as it is; at most 0."},
      {"pairs_mutation", &p.mutation_probability, "Per pair and generation, 0 to 1."},
      {"pairs_generations", &p.max_generations, "At most, 1 to 100000."},
  };
}

// Sets the field, or tells what it should have been.
struct Set {
  std::string_view text;
  std::string operator()(bool* field) const {
    if (text != "true" && text != "false") return "true or false";
    *field = text == "true";
    return "";
  }
  template <class Number>
  std::string operator()(Number* field) const {
    const auto value = parse_number<Number>(text);
    if (!value) return std::is_same_v<Number, int> ? "a whole number" : "a number";
    *field = *value;
    return "";
  }
  std::string operator()(const Choice& choice) const {
    std::string all;
    for (std::size_t i = 0; i < choice.words.size(); ++i) {
      if (text == choice.words[i]) {
        std::visit([&](auto* field) { *field = static_cast<std::decay_t<decltype(*field)>>(i); }, choice.field);
        return "";
      }
      all += (all.empty() ? "" : " or ") + std::string(choice.words[i]);
    }
    return all;
  }
};

struct Get {
  std::string operator()(const bool* field) const { return *field ? "true" : "false"; }
  std::string operator()(const int* field) const { return std::to_string(*field); }
  std::string operator()(const double* field) const {
    char text[32];
    std::snprintf(text, sizeof text, "%g", *field);
    return text;
  }
  std::string operator()(const Choice& choice) const {
    return std::string(
        choice.words[std::visit([](const auto* field) { return static_cast<std::size_t>(*field); }, choice.field)]);
  }
};

}  // namespace

void set_options(const std::string& text, Options& options) {
  const std::vector<Entry> known = entries(options);
  std::set<std::string_view> seen;
  for (const std::string_view item : split(text, ", \t\r\n")) {
    const std::size_t equals = item.find('=');
    const std::string_view key = item.substr(0, equals);
    const auto refuse = [&](const std::string& rule) {
      throw InvalidOption("advanced options " + rule + ", got \"" + std::string(item) + "\"");
    };
    std::string keys;
    const Entry* entry = nullptr;
    for (const Entry& e : known) {
      if (e.key == key) entry = &e;
      keys += (keys.empty() ? "" : ", ") + std::string(e.key);
    }
    if (!entry || equals == item.npos) refuse("must be key=value, without blanks, with the keys " + keys);
    if (!seen.insert(key).second) refuse("must name " + std::string(key) + " only once");
    const std::string rule = std::visit(Set{item.substr(equals + 1)}, entry->field);
    if (!rule.empty()) refuse("must give " + std::string(key) + " as " + rule);
  }
}

std::vector<OptionKey> option_keys() {
  Options defaults;
  std::vector<OptionKey> out;
  for (const Entry& e : entries(defaults)) out.push_back({std::string(e.key), std::visit(Get{}, e.field), e.meaning});
  return out;
}

}  // namespace ga_symmetry
