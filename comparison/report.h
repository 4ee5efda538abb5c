// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a comparison: CSV and JSON files of every figure, and a page with tables and plots.
#pragma once
#include <string>

#include "ga_symmetry/context.h"
#include "measurement.h"

namespace ga_symmetry::comparison {

/// A report can be made there. @throws InvalidOption, FileError
void check_report_folder(const std::string& folder);

/// Writes runs.csv, methods.csv, durations.csv, generations.csv, error_curves.csv and comparison.json; report.py makes
/// report.html of them. The folder appears whole or not at all. Without python3 with jinja2 there is no page, without
/// matplotlib it has no plots; pictures.json, which is not kept otherwise, stays then, and report.py can be run later.
/// @param command  that makes the same report again, for the page
/// @return what is missing of the page and how to get it, one line; empty = nothing
/// @throws FileError, Cancelled
std::string write_report(const std::string& folder, const std::string& command, const Comparison& comparison,
                         const Context& context);

}  // namespace ga_symmetry::comparison
