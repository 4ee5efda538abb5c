// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/field_cache.h"

#include <algorithm>

namespace ga_symmetry {

DistanceFields FieldCache::fields(const std::vector<int>& sources, int threads, const Context& context) const {
  constexpr std::size_t kMost = std::size_t{64} << 20;  // bytes
  std::vector<const float*> known(sources.size(), nullptr);
  std::vector<int> missing;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto found = field_of_.find(sources[i]);
      if (found != field_of_.end())
        known[i] = found->second.data();
      else
        missing.push_back(sources[i]);
    }
  }
  const DistanceFields computed = solver_.fields(missing, threads, context);
  DistanceFields out(static_cast<Eigen::Index>(sources.size()), computed.cols());
  for (std::size_t i = 0, next = 0; i < sources.size(); ++i) {
    const float* field = known[i] ? known[i] : computed.row(static_cast<Eigen::Index>(next++)).data();
    std::copy(field, field + out.cols(), out.row(static_cast<Eigen::Index>(i)).data());
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t k = 0; k < missing.size(); ++k) {
    const std::size_t bytes = computed.cols() * sizeof(float);
    if ((field_of_.size() + 1) * bytes > kMost) break;
    const float* field = computed.row(static_cast<Eigen::Index>(k)).data();
    field_of_.try_emplace(missing[k], field, field + computed.cols());
  }
  return out;
}

}  // namespace ga_symmetry
