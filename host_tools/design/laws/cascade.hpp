// SPDX-License-Identifier: MIT
/// Common part of the designs of the laws around current loops.
#pragma once

#include "common/c_text.hpp"
#include "design/laws/laws.hpp"

namespace sdre {

/// Checks the loops with the constants that the configuration has by now.
void certify_cascade(Design &design);

/// Method, then a line for each loop.
std::string cascade_summary(const Design &design, const std::string &method);

/// ".foc = {..},\n" and ".speed = {..},\n".
std::string cascade_blocks(const foc_config_t &foc, const speed_difference_config_t &speed);

/// ".gains = {..},\n", a block for each way to measure the speed.
template <typename Gains, typename Fields>
std::string gains_block(const Gains (&gains)[SPEED_DIFFERENCE_MODES], const Fields &fields)
{
    return c_block("gains", "{ /* counted */\n" +
                                c_indented(fields(gains[SPEED_DIFFERENCE_COUNTED])) +
                                "},\n{ /* timed */\n" +
                                c_indented(fields(gains[SPEED_DIFFERENCE_TIMED])) + "},\n");
}

} // namespace sdre
