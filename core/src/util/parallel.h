// SPDX-License-Identifier: GPL-3.0-or-later
// The one way to use several threads.
#pragma once
#include <algorithm>
#include <functional>

namespace ga_symmetry {

/// Number of threads that `threads` means: itself, or all cores for 0. At least 1.
int thread_count(int threads);

/// Calls body(i, worker) once for every i in [0, count), on up to `threads` threads (0 = all cores), but no more
/// than twice the cores, or 8. `worker` in [0, thread_count(threads)) names the calling thread, for its scratch memory.
/// Items are handed out in order, one at a time; results must go to slots indexed by i, so that the number of threads
/// never changes them.
/// The first exception that a body throws stops the hand-out and is rethrown here.
void parallel_for(int count, int threads, const std::function<void(int i, int worker)>& body);

/// The same for items that are too small to be handed out alone: body(begin, end, worker) for [0, count) in pieces of
/// `block` >= 1, the last one what is left.
template <class Body>
void parallel_blocks(int count, int block, int threads, const Body& body) {
  parallel_for((count + block - 1) / block, threads, [&](int i, int worker) {
    const int begin = i * block;
    body(begin, std::min(count, begin + block), worker);
  });
}

}  // namespace ga_symmetry
