// SPDX-License-Identifier: MIT
#include "drive/pwm_frequency.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "drive/cycle_budget.hpp"
#include "drive/drive_file.hpp"
#include "drive/processor.hpp"

namespace sdre {
namespace {

// Half a count of these is the 0.1 % by which a frequency may differ.
constexpr double least_full_cnt = 500.0;
// Measured with a chopper in host_stub's constants: what the default drive's period takes more, at the band's upper end.
constexpr double chopper_cycles = 193.0;

double law_cycles(const Drive &d)
{
    switch (d.law) {
    case Law::noc_h:
    case Law::noc_iron: // not priced; noc_h takes more
        return cycle_budget::noc_h;
    case Law::noc_shaft:
        return cycle_budget::noc_shaft;
    case Law::conventional_noc:
        return cycle_budget::conventional;
    case Law::noc:
        return d.nodo.form == NodoForm::encoder ? cycle_budget::noc : cycle_budget::noc_speed;
    default: // not priced; on a host each takes half of the encoder form's time or less
        return cycle_budget::noc;
    }
}

/// 0: none are recorded for the processor.
double least_cycles(const Drive &d)
{
    if (!processor_of(d).has_cycle_budget) {
        return 0.0;
    }
    const double more =
        std::max(d.position ? cycle_budget::position : 0.0, d.torque ? cycle_budget::torque : 0.0);
    const double chopper = has_chopper(d) ? chopper_cycles : 0.0;
    return (law_cycles(d) + more + chopper) / (1.0 - cycle_budget::background_share);
}

/// The section that takes the most cycles.
const char *with_words(const Drive &d)
{
    const double position = d.position ? cycle_budget::position : 0.0;
    const double torque   = d.torque ? cycle_budget::torque : 0.0;
    if (position <= 0.0 && torque <= 0.0) {
        return "";
    }
    return torque > position ? " with [torque]" : " with [position]";
}

/// A count is 61 ppm at the least.
std::string seven_digits(double pwm_Hz)
{
    return fmt::format("{:.7g}", pwm_Hz);
}

} // namespace

double pwm_full_cnt(const Processor &processor, double pwm_Hz)
{
    return std::round(processor.counter_Hz / (2.0 * pwm_Hz));
}

double counted_pwm_Hz(const Processor &processor, double full_cnt)
{
    return processor.counter_Hz / (2.0 * full_cnt);
}

FullCountRange pwm_full_cnt_range(const Drive &d)
{
    const Processor &p       = processor_of(d);
    const double     periods = d.inverter.updates_per_period;
    return {std::max(std::ceil(periods * least_cycles(d) / p.cycles_per_cnt()), least_full_cnt),
            std::floor(p.most_cycles / p.cycles_per_cnt())};
}

std::string pwm_refusal(const Drive &d, double pwm_Hz)
{
    const Processor     &p       = processor_of(d);
    const FullCountRange allowed = pwm_full_cnt_range(d);
    const double         full    = pwm_Hz > 0.0 ? pwm_full_cnt(p, pwm_Hz) : 0.0;
    if (full >= allowed.least && full <= allowed.most) {
        return "";
    }
    const std::string ends = fmt::format(
        "= {:g} is not allowed: must be {:.0f} .. {:.0f}; a PWM period has at most {:g} cycles of "
        "{:g} MHz",
        pwm_Hz, std::ceil(counted_pwm_Hz(p, allowed.most)),
        std::floor(counted_pwm_Hz(p, allowed.least)), p.most_cycles, 1e-6 * p.clock_Hz);
    if (!p.has_cycle_budget) {
        return fmt::format("{}, and half of one at least {:g} counts", ends, least_full_cnt);
    }
    return fmt::format("{}, and law \"{}\"{} needs {:.0f}{} (docs/hardware.md, \"Cycle budget\")",
                       ends, law_name(d.law), with_words(d), std::ceil(least_cycles(d)),
                       d.inverter.updates_per_period == 1 ? "" : " in each of its two updates");
}

std::string cycles_note(const Drive &d)
{
    const Processor &p = processor_of(d);
    return p.has_cycle_budget
               ? ""
               : fmt::format(
                     "cycles of a control period: nothing checked, none are recorded for {}; "
                     "it has {:.0f}\n",
                     p.name, p.clock_Hz * control_period_s(d));
}

std::string pwm_words(const Inverter &i)
{
    const std::string actual = seven_digits(i.pwm_frequency_Hz);
    const std::string wanted = seven_digits(i.pwm_wanted_Hz);
    return actual == wanted
               ? actual + " Hz"
               : fmt::format("{} Hz, the nearest to {} Hz that the counter has", actual, wanted);
}

std::string pwm_note(const Inverter &i)
{
    return seven_digits(i.pwm_frequency_Hz) == seven_digits(i.pwm_wanted_Hz)
               ? ""
               : fmt::format("PWM at {}\n", pwm_words(i));
}

} // namespace sdre
