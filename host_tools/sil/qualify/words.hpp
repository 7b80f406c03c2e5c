// SPDX-License-Identifier: MIT
/// How the table and the page of a qualification say the same things.
#pragma once

#include <string>
#include <vector>

#include "sil/qualify/qualify.hpp"

namespace sdre {

/// Adds a reason if a value is beyond its limit, or not a number. A limit of 0 is none. `scale` is for the words alone.
void beyond(std::vector<std::string> &reasons, const char *what, double is, double most,
            const char *unit, double scale = 1.0);
/// In milliseconds, or "never".
std::string settling_words(const TrialResult &r);
/// "good", or why it is not.
std::string verdict_words(const TrialResult &r);
/// "pi_foc with current_bandwidth_Hz = 241, ..: the best of 212 tunings ..", or that none is as quiet and settles.
std::string rival_words(const Rival &rival);
/// Where the rival is ahead of the drive in the load step, and where behind.
std::string rival_verdict(const Qualification &q, const Rival &rival);
/// One line about the first reason; empty for a good drive.
std::string next_step(const Qualification &q);
/// A line for each kind of random motors; empty when none were run.
std::string motors_words(const Qualification &q);
std::string wide_motors_words(const Qualification &q);

} // namespace sdre
