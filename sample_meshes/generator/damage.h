// SPDX-License-Identifier: GPL-3.0-or-later
// Broken symmetry: what real scans lack or have too much. Each takes a closed person and keeps the truth.
#pragma once
#include "sample.h"

namespace samples {

/// Without some vertices, and without what then hangs on by a single vertex or not at all; the largest piece is left.
Sample without(const Sample& sample, std::vector<bool> drop);

/// The left hand cut off at the wrist, the wound closed.
Sample without_left_hand(const Sample& sample);
/// A hump on the left of the back. The hump and its place on the right have no counterpart.
Sample with_hump(const Sample& sample);
/// A hole in the left half of the chest.
Sample with_hole(const Sample& sample);
/// The quarter at the back left not seen by the scanner; open border.
Sample partial_scan(const Sample& sample);

}  // namespace samples
