// SPDX-License-Identifier: GPL-3.0-or-later
// Distance fields that are asked for again and again: no field twice.
#pragma once
#include <mutex>
#include <unordered_map>
#include <vector>

#include "geodesics/geodesics.h"

namespace ga_symmetry {

/// Computes fields and keeps them, up to 64 MB. Thread-safe; a field is the same whoever asked for it first.
class FieldCache {
 public:
  /// @param solver  must outlive this
  explicit FieldCache(const GeodesicSolver& solver) : solver_(solver) {}

  /// As GeodesicSolver::fields. @throws InvalidOption, Cancelled
  DistanceFields fields(const std::vector<int>& sources, int threads, const Context& context = {}) const;

 private:
  const GeodesicSolver& solver_;
  mutable std::mutex mutex_;
  mutable std::unordered_map<int, std::vector<float>> field_of_;  // by source; none is ever removed
};

}  // namespace ga_symmetry
