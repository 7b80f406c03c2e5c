// SPDX-License-Identifier: MIT
/// The extension `sdre._native`: what the Python package calls. Its functions take and give plain values; names, units and
/// words for people are those of the package.
#pragma once

#include <nanobind/nanobind.h>

namespace sdre {

void bind_design(nanobind::module_ &m);
void bind_runs(nanobind::module_ &m);
void bind_loop(nanobind::module_ &m);
void bind_cases(nanobind::module_ &m);

} // namespace sdre
