// SPDX-License-Identifier: GPL-3.0-or-later
#include "filters.h"

namespace ga_symmetry {

const std::vector<Filter>& all_filters() {
  static const std::vector<Filter> filters{find_partners_filter(),  show_pairs_filter(), mirror_attributes_filter(),
                                           mirror_sculpt_filter(),  asymmetry_filter(),  samples_filter(),
                                           import_partners_filter()};
  return filters;
}

}  // namespace ga_symmetry
