// SPDX-License-Identifier: MIT
#include "tune/tune_spec.hpp"

#include <algorithm>
#include <cmath>

#include "common/toml_reader.hpp"

namespace sdre {
namespace {

constexpr Range factor{0.1, 10.0};
constexpr Range speed_e_radps{0.0, 1e5};
constexpr Range deviation_e_radps{1e-6, 1e4};
constexpr Range torque_Nm{1e-6, 1e5};
constexpr Range time_s{1e-5, 10.0};
constexpr Range current_A{1e-6, 1e4};
constexpr Range voltage_V{1e-3, 1e4};
constexpr Range pole{0.1, 0.9999};
constexpr Range error_cnt{1e-4, 1.0};
// Standard deviation of a number that is rounded to whole ones.
const double a_count = 1.0 / std::sqrt(12.0);

RobustnessCase read_case(TomlReader &t)
{
    RobustnessCase c;
    c.mechanical      = t.number("mechanical", factor);
    c.electrical      = t.number("electrical", factor);
    c.inductance      = t.number_or("inductance", factor, 1.0);
    c.resonance       = t.number_or("resonance", factor, 1.0);
    c.dip_e_radps     = t.number("dip_e_radps", deviation_e_radps);
    c.settling_time_s = t.number("settling_time_s", time_s);
    c.ripple_e_radps  = t.number("ripple_e_radps", deviation_e_radps);
    t.reject_unknown_keys();
    return c;
}

} // namespace

bool is_nominal(const RobustnessCase &c)
{
    return c.mechanical == 1.0 && c.electrical == 1.0 && c.inductance == 1.0 && c.resonance == 1.0;
}

bool has_resonance(const TuneSpec &spec)
{
    return std::any_of(spec.cases.begin(), spec.cases.end(),
                       [](const RobustnessCase &c) { return c.resonance != 1.0; });
}

TuneSpec read_tune_spec(const std::filesystem::path &file)
{
    const toml::table root = parse_toml_file(file);
    TomlReader        t(file.string(), "", root);
    TuneSpec          spec;
    spec.speed_e_radps      = t.number("speed_e_radps", speed_e_radps);
    spec.load_before_Nm     = t.number("load_before_Nm", {0.0, 1e5});
    spec.load_step_Nm       = t.number("load_step_Nm", torque_Nm);
    spec.band_e_radps       = t.number("band_e_radps", deviation_e_radps);
    spec.largest_pole       = t.number("largest_pole", pole);
    spec.voltage_V          = t.number("voltage_V", voltage_V);
    spec.voltage_headroom_V = t.number("voltage_headroom_V", voltage_V);
    spec.d_axis_error_A     = t.number("d_axis_error_A", current_A);
    spec.current_noise_A    = t.number("current_noise_A", current_A);
    spec.current_lsb_A      = t.number("current_lsb_A", current_A);
    spec.voltage_noise_V    = t.number_or("voltage_noise_V", voltage_V, 0.0);
    spec.angle_error_cnt    = t.number_or("angle_error_cnt", error_cnt, a_count);
    for (TomlReader &entry : t.tables("case")) {
        spec.cases.push_back(read_case(entry));
    }
    if (spec.cases.empty() || !is_nominal(spec.cases[0])) {
        t.fail("case", "number 1 must be the nominal one: every factor 1");
    }
    t.reject_unknown_keys();
    return spec;
}

} // namespace sdre
