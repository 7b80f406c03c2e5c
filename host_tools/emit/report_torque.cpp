// SPDX-License-Identifier: MIT
#include "emit/report_torque.hpp"

#include <cmath>

#include <fmt/format.h>

#include "design/torque.hpp"
#include "design/torque_bound.hpp"

namespace sdre {
namespace {

struct Bound {
    double speed_e_radps;
    double time_s; ///< not a number: the voltage does not reach the torque
};

/// Bounds of a step from zero to the rated torque: at rest, at half of the rated speed, and at all of it.
std::vector<Bound> bounds(const Design &d)
{
    std::vector<Bound> all;
    for (const double share : {0.0, 0.5, 1.0}) {
        const double speed = share * d.drive.motor.rated_speed_e_radps;
        all.push_back(
            {speed, least_torque_time_s(d.drive, speed, 0.0, d.drive.motor.rated_torque_Nm)});
    }
    return all;
}

std::string time_text(const Bound &b)
{
    const std::string where =
        b.speed_e_radps > 0.0 ? fmt::format("{:.1f} rad/s el.", b.speed_e_radps) : "rest";
    return std::isnan(b.time_s) ? fmt::format("out of reach at {}", where)
                                : fmt::format("{:.2f} ms at {}", 1e3 * b.time_s, where);
}

} // namespace

std::string torque_text(const Design &d)
{
    const torque_gains_t g    = torque_constants(d);
    std::string          text = fmt::format(
                 "\ntorque\n  {:.4g} V/A of i_q, {:.4g} V/A of i_d; a step within the voltage takes two "
                          "periods, {:g} us\n  90 % of a step from zero to the rated torque, earliest by any voltage "
                          "and without a delay:\n    ",
                 g.iq_VpA, g.id_VpA, 2e6 * control_period_s(d.drive));
    std::string comma;
    for (const Bound &b : bounds(d)) {
        text += comma + time_text(b);
        comma = ", ";
    }
    return text + "\n";
}

Json torque_json(const Design &d)
{
    const torque_gains_t g     = torque_constants(d);
    Json                 least = Json::array();
    for (const Bound &b : bounds(d)) {
        least.push_back(Json{{"speed_e_radps", b.speed_e_radps},
                             {"time_s", std::isnan(b.time_s) ? Json() : Json(b.time_s)}});
    }
    return Json{{"iq_VpA", g.iq_VpA}, {"id_VpA", g.id_VpA}, {"least_time_of_rated_step", least}};
}

} // namespace sdre
