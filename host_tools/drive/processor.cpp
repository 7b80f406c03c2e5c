// SPDX-License-Identifier: MIT
#include "drive/processor.hpp"

#include <algorithm>
#include <array>

#include "drive/drive_file.hpp"

extern "C" {
#include "f28335/clock_tree.h"
}

namespace sdre {
namespace {

static_assert(BOARD_ADC_CODES == 1U << 12U);

const std::array<Processor, 1> processors{{
    {"f28335", CLOCK_SYSCLK_Hz, CLOCK_TBCLK_Hz,
     65535.0, // the capture timer's run, board.c
     CLOCK_DEAD_TIME_MAX_cnt, 12, 65532},
}};

} // namespace

const Processor *find_processor(const std::string &name)
{
    const auto *const found = std::find_if(processors.begin(), processors.end(),
                                           [&](const Processor &p) { return p.name == name; });
    return found == processors.end() ? nullptr : found;
}

std::string processor_names()
{
    std::string names;
    for (const Processor &p : processors) {
        names += (names.empty() ? "" : ", ") + p.name;
    }
    return names;
}

const Processor &default_processor()
{
    return processors.front();
}

const Processor &processor_of(const Drive &drive)
{
    return drive.board.file ? *drive.board.file->processor : default_processor();
}

} // namespace sdre
