// Advanced options: one line of text.
#include "option_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ga_symmetry {
namespace {

std::string refusal(const std::string& text) {
  Options options;
  try {
    set_options(text, options);
  } catch (const InvalidOption& error) {
    return error.what();
  }
  return "";
}

TEST(OptionText, SetsWhatIsNamedAndNothingElse) {
  Options o;
  set_options(" joint_sites=400,\tjoint_distance_weight=2.5 fitness=linear,,local_refinement=false pairs_barrier=-3",
              o);
  EXPECT_EQ(o.joint.sites, 400);
  EXPECT_EQ(o.joint.distance_weight, 2.5);
  EXPECT_EQ(o.pairs.error, PairError::linear);
  EXPECT_FALSE(o.local_refinement);
  EXPECT_EQ(o.pairs.mutation_barrier_z, -3);
  EXPECT_TRUE(o.noise_filter);
  EXPECT_EQ(o.joint.population, JointOptions{}.population);
  EXPECT_EQ(o.pairs.sampling, PairsOptions{}.sampling);
  set_options("", o);
  EXPECT_EQ(o.joint.sites, 400);
}

TEST(OptionText, EveryKeyTakesItsOwnDefaultAndSetsItsOwnField) {
  const auto keys = option_keys();
  ASSERT_GT(keys.size(), 20u);
  const auto state = [](const std::string& text) {
    Options o;
    set_options(text, o);
    const JointOptions& j = o.joint;
    const PairsOptions& p = o.pairs;
    return std::vector<double>{
        double(o.local_refinement), double(o.noise_filter), double(j.sites),          double(j.population),
        double(j.max_generations),  j.mutation_probability, j.ruin_probability,       j.outlier_z,
        j.distance_weight,          j.orientation_weight,   j.continuity_weight,      j.descriptor_weight,
        j.bijectivity_weight,       j.reference_weight,     double(p.error),          double(p.samples),
        double(p.sampling),         double(p.individuals),  double(p.regions),        p.outlier_z,
        p.mutation_barrier_z,       p.mutation_probability, double(p.max_generations)};
  };
  const auto defaults = state("");
  ASSERT_EQ(keys.size(), defaults.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(state(keys[i].name + "=" + keys[i].value), defaults) << keys[i].name;
    std::string other = "7";
    if (keys[i].value == "true") other = "false";
    if (keys[i].value == "squared") other = "linear";
    if (keys[i].value == "even") other = "uniform";
    const auto changed = state(keys[i].name + "=" + other);
    for (std::size_t k = 0; k < defaults.size(); ++k) EXPECT_EQ(changed[k] != defaults[k], k == i) << keys[i].name;
  }
}

TEST(OptionText, RefusesTheRestAndNamesTheKeys) {
  for (const char* text : {"?", "sites=3", "joint_sites", "=3", "joint_sites = 3", "Joint_sites=3"}) {
    EXPECT_NE(refusal(text).find("joint_sites, joint_population"), std::string::npos) << text;
    EXPECT_NE(refusal(text).find("pairs_generations"), std::string::npos) << text;
  }
  EXPECT_NE(refusal("joint_sites=1 joint_sites=1").find("only once"), std::string::npos);
  EXPECT_NE(refusal("joint_sites=1.5").find("joint_sites as a whole number, got \"joint_sites=1.5\""),
            std::string::npos);
  EXPECT_NE(refusal("joint_ruin=half").find("a number"), std::string::npos);
  EXPECT_NE(refusal("noise_filter=1").find("true or false"), std::string::npos);
  EXPECT_NE(refusal("fitness=cubic").find("squared or linear"), std::string::npos);
  EXPECT_NE(refusal("joint_sites="), "");
  EXPECT_NE(refusal("joint_sites=1=2"), "");
}

TEST(OptionText, RangesAreCheckedBeforeTheMesh) {
  Options o;
  set_options("joint_population=3", o);
  EXPECT_THROW(find_symmetry({}, o), InvalidOption);
}

}  // namespace
}  // namespace ga_symmetry
