// SPDX-License-Identifier: MIT
#include "drive/processor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "drive/drive_file.hpp"
#include "drive/processors/processors.hpp"

namespace sdre {
namespace {

const std::array<Processor, 2> &processors()
{
    static const std::array<Processor, 2> all{processor_f28335(), processor_stm32g431()};
    return all;
}

} // namespace

std::optional<double> Processor::dead_time_cnt(double wanted) const
{
    for (const DeadTimeRange &r : dead_times) {
        const double cnt = std::max(std::ceil(wanted / r.step_cnt) * r.step_cnt, r.least_cnt);
        if (cnt <= r.most_cnt) {
            return cnt;
        }
    }
    return {};
}

const Processor *find_processor(const std::string &name)
{
    const auto *const found = std::find_if(processors().begin(), processors().end(),
                                           [&](const Processor &p) { return p.name == name; });
    return found == processors().end() ? nullptr : found;
}

std::string processor_names()
{
    std::string names;
    for (const Processor &p : processors()) {
        names += (names.empty() ? "" : ", ") + p.name;
    }
    return names;
}

const Processor &default_processor()
{
    return processors().front();
}

const Processor &processor_of(const Drive &drive)
{
    return drive.board.file ? *drive.board.file->processor : default_processor();
}

} // namespace sdre
