// SPDX-License-Identifier: GPL-3.0-or-later
// Which of so many things belong together, as that becomes known pair by pair.
#pragma once
#include <numeric>
#include <utility>
#include <vector>

namespace ga_symmetry {

class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The lowest member of a set.
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// @return whether they were apart
  bool join(int a, int b) {
    a = find(a), b = find(b);
    if (a == b) return false;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    return true;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace ga_symmetry
