// SPDX-License-Identifier: GPL-3.0-or-later
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "util/multiply.h"

namespace ga_symmetry {
namespace {

TEST(ParallelBlocks, CoverEveryItemOnce) {
  for (const int count : {0, 1, 7, 8, 9, 100})
    for (const int threads : {1, 4}) {
      std::vector<std::atomic<int>> seen(count);
      parallel_blocks(count, 8, threads, [&](int begin, int end, int worker) {
        EXPECT_LT(worker, threads);
        EXPECT_EQ(begin % 8, 0);
        EXPECT_LE(end - begin, 8);
        for (int i = begin; i < end; ++i) ++seen[i];
      });
      for (const auto& times : seen) EXPECT_EQ(times, 1) << count << " items, " << threads << " threads";
    }
}

TEST(ParallelBlocks, PassOnWhatABodyThrows) {
  EXPECT_THROW(parallel_blocks(100, 8, 4,
                               [](int begin, int, int) {
                                 if (begin == 48) throw std::runtime_error("here");
                               }),
               std::runtime_error);
}

TEST(Multiply, IsTheProductForAnyNumberOfThreads) {
  std::srand(1);  // Eigen's Random
  const Eigen::MatrixXf a = Eigen::MatrixXf::Random(250, 40), b = Eigen::MatrixXf::Random(40, 30);
  Eigen::MatrixXf one(250, 30), four(250, 30);
  multiply(a, b, one, 1);
  multiply(a, b, four, 4);
  EXPECT_EQ(one, four);
  EXPECT_LT((one - a * b).cwiseAbs().maxCoeff(), 1e-5);
}

}  // namespace
}  // namespace ga_symmetry
