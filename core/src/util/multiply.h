// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

#include "util/parallel.h"

namespace ga_symmetry {

/// out = a * b, in pieces whose size does not depend on the number of threads: nor do the sums.
/// @param out  a.rows() x b.cols(), neither a nor b
template <class A, class B, class Out>
void multiply(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b, Eigen::MatrixBase<Out>& out, int threads) {
  constexpr int kRows = 96;
  parallel_blocks(static_cast<int>(a.rows()), kRows, threads, [&](int begin, int end, int) {
    out.middleRows(begin, end - begin).noalias() = a.middleRows(begin, end - begin) * b;
  });
}

}  // namespace ga_symmetry
