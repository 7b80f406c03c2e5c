// SPDX-License-Identifier: MIT
#include "sil/verify/programme.hpp"

#include <algorithm>
#include <cmath>

#include "common/json.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/sampled_model.hpp"

namespace sdre {
namespace {

// Chosen on the shipped motors. The high speed leaves voltage for the whole current. At the low speed EMF and
// resistance are apart.
constexpr double high_share = 0.7;
constexpr double low_share  = 0.25;
// Ramps that take a part of the torque: friction and inductance show at currents that differ.
constexpr double half_share    = 0.5;
constexpr double quarter_share = 0.25;
constexpr double begin_share   = 0.1; ///< of the way, at the trigger
// Chosen: ten times the electrical and speed transients of the shipped drives.
constexpr double settle_s = 0.2;

double largest_accel_e_radps2(const Drive &d)
{
    const ReducedParameters l    = reduced_parameters(d.motor);
    const double            iq_A = largest_iq_A(d.motor, l);
    return torque_Nm(d.motor, mtpa_id_A(l, iq_A), iq_A) * d.motor.pole_pairs / d.motor.inertia_kgm2;
}

using Signals = std::array<std::string, 4>;

void add_direction(std::vector<Shot> &shots, const std::string &name, double low, double high,
                   double accel)
{
    const Signals both{"IQ", "ID", "VQ", "VD"};
    const Signals with_vq{"SPEED", "IQ", "ID", "VQ"};
    const Signals with_vd{"SPEED", "IQ", "ID", "VD"};
    const double  half    = std::round(half_share * accel);
    const double  quarter = std::round(quarter_share * accel);
    shots.push_back({name + " slow", low, low, 0.0, both});
    shots.push_back({name + " fast", high, high, 0.0, both});
    shots.push_back({name + " slow to fast", -low, high, 0.0, with_vq});
    shots.push_back({name + " fast to slow", high, low, quarter, with_vq});
    shots.push_back({name + " half as fast", low, high, half, with_vq});
    shots.push_back({name + " again", -low, high, 0.0, with_vq});
    shots.push_back({name + " d axis", -low, high, 0.0, with_vd});
    shots.push_back({name + " d axis again", -low, high, 0.0, with_vd});
}

} // namespace

double Shot::trigger_e_radps() const
{
    return from_e_radps + begin_share * (to_e_radps - from_e_radps);
}

Programme verify_programme(const Drive &d, int samples)
{
    Programme    p;
    const double accel = largest_accel_e_radps2(d);
    const double high  = high_share * d.motor.rated_speed_e_radps;
    const double low   = low_share * d.motor.rated_speed_e_radps;
    p.period_s         = control_period_s(d);
    p.samples          = samples;
    p.before           = samples / 8;
    p.settle_s         = settle_s;
    p.way_e_radps2     = std::max(std::round(half_share * accel), 1.0);
    add_direction(p.shots, "forward", low, high, accel);
    add_direction(p.shots, "backward", -low, -high, accel);
    return p;
}

std::string programme_json(const Drive &d, const Programme &p)
{
    Json shots = Json::array();
    for (const Shot &s : p.shots) {
        shots.push_back(
            {{"name", s.name},
             {"from_e_radps", s.from_e_radps},
             {"to_e_radps", s.to_e_radps},
             {"acceleration_e_radps2", s.accel_e_radps2},
             {"trigger", s.steady()                      ? "now"
                         : s.to_e_radps > s.from_e_radps ? "rising"
                                                         : "falling"},
             {"level_e_radps", s.trigger_e_radps()},
             {"signals", std::vector<std::string>(s.signals.begin(), s.signals.end())}});
    }
    return Json{{"drive", d.name},
                {"digest", drive_digest(d)},
                {"max_current_A", d.motor.max_current_A},
                {"period_s", p.period_s},
                {"samples", p.samples},
                {"before", p.before},
                {"settle_s", p.settle_s},
                {"way_e_radps2", p.way_e_radps2},
                {"shots", shots}}
        .text();
}

} // namespace sdre
