// SPDX-License-Identifier: GPL-3.0-or-later
// A surface of fewer vertices and the same shape.
#pragma once
#include "ga_symmetry/context.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// By quadric edge collapse (Garland & Heckbert 1997, vcglib's) to about `vertices`; no hole is closed and no two parts
/// are joined. More are left where nothing can be taken away without that.
/// @throws Cancelled
Surface simplified(const Surface& surface, int vertices, const Context& context = {});

}  // namespace ga_symmetry
