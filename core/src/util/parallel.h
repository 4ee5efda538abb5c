// SPDX-License-Identifier: GPL-3.0-or-later
// The one way to use several threads.
#pragma once
#include <functional>

namespace ga_symmetry {

/// Number of threads that `threads` means: itself, or all cores for 0. At least 1.
int thread_count(int threads);

/// Calls body(i, worker) once for every i in [0, count), on up to `threads` threads (0 = all cores). `worker` in
/// [0, thread_count(threads)) names the calling thread, for its scratch memory. Items are handed out in order, one at
/// a time; results must go to slots indexed by i, so that the number of threads never changes them.
/// The first exception that a body throws stops the hand-out and is rethrown here.
void parallel_for(int count, int threads, const std::function<void(int i, int worker)>& body);

}  // namespace ga_symmetry
