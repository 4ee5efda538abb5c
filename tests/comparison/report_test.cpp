// SPDX-License-Identifier: GPL-3.0-or-later
// What the report of a comparison is made with.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "ga_symmetry/errors.h"
#include "measurement.h"
#include "run_program.h"

namespace ga_symmetry::comparison {
namespace {

class RunProgram : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(output_); }
  int run(const std::vector<std::string>& words, const Context& context = {}) {
    return run_program(words, output_, context);
  }
  const std::string output_ = testing::TempDir() + "ga_symmetry_run_program_" + std::to_string(getpid());
};

TEST_F(RunProgram, TellsHowItEnded) {
  EXPECT_EQ(run({"true"}), 0);
  EXPECT_EQ(run({"sh", "-c", "echo one; echo two >&2; exit 7"}), 7);
  std::string one, two;
  std::ifstream(output_) >> one >> two;
  EXPECT_EQ(one + two, "onetwo");
  EXPECT_EQ(run({"sh", "-c", "kill -9 $$"}), -1);
  EXPECT_EQ(run({"/no/such/program"}), -1);
}

// Where the parent left SIGCHLD ignored the system keeps no exit status: nobody may take that for success.
TEST_F(RunProgram, AnUnknownEndIsNoSuccess) {
  const auto before = signal(SIGCHLD, SIG_IGN);
  const int status = run({"false"});
  signal(SIGCHLD, before);
  EXPECT_EQ(status, -1);
}

TEST_F(RunProgram, EndsWhenCancelled) {
  const std::atomic<bool> cancel{true};
  Context context;
  context.cancel = &cancel;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(run({"sleep", "60"}, context), Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(Plan, RefusesWhatCannotBeMeasured) {
  const Plan good{{"naive"}, {1, 2}, 1, 0};
  EXPECT_NO_THROW(check_plan(good));
  for (const auto& change : std::vector<void (*)(Plan&)>{[](Plan& p) { p.methods = {}; },
                                                         [](Plan& p) {
                                                           p.methods = {"naive", "slow"};
                                                         },
                                                         [](Plan& p) {
                                                           p.methods = {"naive", "naive"};
                                                         },
                                                         [](Plan& p) { p.seeds = {}; },
                                                         [](Plan& p) {
                                                           p.seeds = {1, 1};
                                                         },
                                                         [](Plan& p) { p.repeats = 0; }}) {
    Plan plan = good;
    change(plan);
    EXPECT_THROW(check_plan(plan), InvalidOption);
  }
}

}  // namespace
}  // namespace ga_symmetry::comparison
