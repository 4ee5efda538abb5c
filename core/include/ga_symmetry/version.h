// SPDX-License-Identifier: GPL-3.0-or-later
// The version of these headers.
#pragma once

#define GA_SYMMETRY_VERSION_MAJOR 0
#define GA_SYMMETRY_VERSION_MINOR 2
#define GA_SYMMETRY_VERSION_PATCH 0
#define GA_SYMMETRY_VERSION "0.2.0"
