// SPDX-License-Identifier: MIT
#include "design/law_design.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "design/laws/laws.hpp"

namespace sdre {

namespace {

constexpr const LawDesign *all[] = {
    &noc_design,          &noc_speed_design, &noc_h_design, &noc_shaft_design, &noc_iron_design,
    &conventional_design, &dobc_design,      &pid_design,   &pi_foc_design,    &ladrc_design};

} // namespace

const LawDesign &law_design(const Drive &drive)
{
    for (const LawDesign *law : all) {
        if (law->is_for(drive)) {
            return *law;
        }
    }
    throw std::logic_error("a law without a design");
}

std::vector<const RivalLaw *> rival_laws()
{
    std::vector<const RivalLaw *> laws;
    for (const LawDesign *law : all) {
        if (law->rival) {
            laws.push_back(&*law->rival);
        }
    }
    return laws;
}

std::string noise_knob_laws()
{
    std::vector<std::string> names;
    for (const LawDesign *law : all) {
        if (law->noise_knob && std::count(names.begin(), names.end(), law->noise_knob->law) == 0) {
            names.emplace_back(law->noise_knob->law);
        }
    }
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

} // namespace sdre
