// SPDX-License-Identifier: MIT
/// C text of the structures that the generated tables are made of; every float has nine digits.
#pragma once

#include <string>

#include "design/core_types.hpp"

namespace sdre {

/// A member of the configuration itself.
std::string scalar(const std::string &name, float value);

/// The structures inside the configuration, each with its name.
std::string motor_block(const motor_reduced_t &m);
std::string current_ref_block(const current_ref_config_t &c);
std::string dead_time_block(const dead_time_config_t &c);
std::string nosc_block(const nosc_gains_t &g);
/// The observer of either form of paper A.
std::string observer_block(const drive_config_t &c);
std::string servo_block(const servo_law_config_t &c);
std::string conventional_block(const conventional_gains_t &g);

/// A whole table of EQ-HARMONIC-3 as a static object of that name.
std::string harmonic_table(const char *name, const nodo_harmonic_gains_t &g);

} // namespace sdre
