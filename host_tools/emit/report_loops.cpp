// SPDX-License-Identifier: MIT
#include "emit/report_loops.hpp"

#include "common/errors.hpp"
#include "common/json.hpp"
#include "common/version.hpp"
#include "design/law_design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/sampled_model.hpp"
#include "design/verdict.hpp"

namespace sdre {
namespace {

constexpr int speeds = 16; // chosen: steps of 75 rad/s for the shipped drive

Json to_json(const Eigen::MatrixXd &M)
{
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        const Eigen::RowVectorXd row = M.row(i);
        rows.push_back(std::vector<double>(row.begin(), row.end()));
    }
    return rows;
}

Json point_json(const Design &d, const OperatingPoint &at)
{
    const double    ts_s  = control_period_s(d.drive);
    const LoopGains gains = encoder_form_gains(d, at.iq_A, d.nosc.gain[0]);
    const auto [P, G]     = predicted_encoder_form(d.l, at, ts_s);
    return {{"speed_e_radps", at.omega_e_radps},
            {"iq_A", at.iq_A},
            {"id_A", at.id_A},
            {"P", to_json(P)},
            {"G", to_json(G)},
            {"L_Ts", to_json(ts_s * gains.L)},
            {"F", to_json(encoder_form_law(d.l, gains.Lambda, at).F)},
            {"A", to_json(sampled_model(d.l, d.l, gains, at, ts_s).A)}};
}

} // namespace

std::string loops_json(const Design &d)
{
    if (constants_of<law_noc_config_t>(d.config) == nullptr) {
        throw InputError("--loops: needs law noc with form = \"encoder\"");
    }
    const Motor &m      = d.drive.motor;
    Json         points = Json::array();
    for (int i = 0; i <= speeds; i++) {
        const double speed = static_cast<double>(d.config.speed_max_e_radps) * i / speeds;
        for (const double iq : {0.0, m.max_current_A, -m.max_current_A}) {
            points.push_back(point_json(d, held_point(d, speed, iq)));
        }
    }
    Json box = Json::array();
    for (const OperatingPoint &at : verdict_box_points(d)) {
        box.push_back(point_json(d, at));
    }
    const Json out{{"tool", std::string("sdre-gains ") + tool_version},
                   {"drive", d.drive.name},
                   {"digest", drive_digest(d.drive)},
                   {"control_period_s", control_period_s(d.drive)},
                   {"motor",
                    {{"pole_pairs", m.pole_pairs},
                     {"stator_resistance_Ohm", m.stator_resistance_Ohm},
                     {"d_axis_inductance_H", m.d_axis_inductance_H},
                     {"q_axis_inductance_H", m.q_axis_inductance_H},
                     {"pm_flux_Wb", m.pm_flux_Wb},
                     {"inertia_kgm2", m.inertia_kgm2},
                     {"viscous_friction_Nms", m.viscous_friction_Nms},
                     {"max_current_A", m.max_current_A}}},
                   {"dc_link_V", d.drive.inverter.dc_link_V},
                   {"points", points},
                   {"box_points", box}};
    return out.text();
}

} // namespace sdre
