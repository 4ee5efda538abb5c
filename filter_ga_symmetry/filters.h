// SPDX-License-Identifier: GPL-3.0-or-later
// All filters of the plugin, in the order in which menus show them.
#pragma once
#include <vector>

#include "meshlab_adapter.h"

namespace ga_symmetry {

Filter find_partners_filter();
Filter show_pairs_filter();
Filter mirror_attributes_filter();
Filter mirror_sculpt_filter();
Filter asymmetry_filter();
Filter samples_filter();
Filter import_partners_filter();

const std::vector<Filter>& all_filters();

}  // namespace ga_symmetry
