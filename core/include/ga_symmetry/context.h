// SPDX-License-Identifier: GPL-3.0-or-later
// What a long computation tells its caller, and how the caller stops it.
#pragma once
#include <atomic>
#include <functional>

namespace ga_symmetry {

/// Progress and cancellation. Both may be left empty.
struct Context {
  /// Called from the calling thread only, with the whole run's fraction in [0,1] (never falling) and the stage's name.
  std::function<void(double fraction, const char* stage)> progress;
  /// Set by anyone, from any thread or signal handler, to stop: the computation throws Cancelled soon after.
  const std::atomic<bool>* cancel = nullptr;
  /// What `advance` reports; null = it reports nothing.
  const char* stage = nullptr;

  /// Asked to stop.
  bool cancelled() const { return cancel && cancel->load(std::memory_order_relaxed); }
  /// Reports progress. @throws Cancelled if asked to stop.
  void report(double fraction, const char* stage) const;
  /// Reports progress within the stage, for work that does not know what it is done for. @throws Cancelled
  void advance(double fraction) const;
  /// For a part of the work: its progress from 0 to 1 is the whole's from `first` to `last`.
  Context part(double first, double last) const;
  /// The same, and names its stage.
  Context part(double first, double last, const char* name) const;
};

}  // namespace ga_symmetry
