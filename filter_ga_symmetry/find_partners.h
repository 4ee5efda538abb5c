// "Intrinsic Symmetry: Find Partners".
#pragma once
#include "meshlab_adapter.h"

namespace ga_symmetry {

Filter find_partners_filter();

}  // namespace ga_symmetry
