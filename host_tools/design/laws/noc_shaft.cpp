// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/noc_shaft/shaft_loop.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::noc_shaft;
}

SampledModel model_at(const Design &d, const TrueMotor &motor, const OperatingPoint &at,
                      const Eigen::MatrixXd &Lambda, const MovingReference *moving)
{
    return sampled_shaft_model(d, motor, believed_shaft(d.drive), at,
                               encoder_form_gains(d, at.iq_A, Lambda), moving);
}

SampledModel loop_at(const Design &d, const TrueMotor &motor, const Shaft &shaft,
                     const OperatingPoint &at, const LoopGains &gains)
{
    return sampled_shaft_model(d, motor, shaft, at, gains);
}

law_noc_shaft_feedback_t feedback(const Design &d)
{
    const Eigen::MatrixXd &Lambda = d.nosc.gain[0];
    const Shaft            shaft  = believed_shaft(d.drive);
    return {single(Lambda(0, 3) / Lambda(0, 1)), single(Lambda(0, 4) / Lambda(0, 1)),
            single(twist_per_accel(shaft)), single(1.0 / shaft.load_inertia_share)};
}

void observer(const Design &d, nodo_shaft_gains_t &nodo)
{
    nodo.motor.order    = static_cast<int16_t>(d.drive.nodo.order);
    nodo.motor.iq_max_A = single(d.certificate.nodo.series_range_A);
    copy_series(d.nodo, nodo.motor.gain);
    for (std::size_t n = 0; n < 2; n++) {
        for (Eigen::Index k = 0; k < 3; k++) {
            for (std::size_t i = 0; i < NODO_SHAFT_N_LOAD; i++) {
                nodo.load[i][n][k] =
                    gain_entry(d.nodo.gain[n], shaft_rows::omega_load + Eigen::Index(i), k);
            }
        }
    }
    const Eigen::MatrixXd step =
        shaft_step(d.l, believed_shaft(d.drive), control_period_s(d.drive));
    for (Eigen::Index i = 0; i < step.rows(); i++) {
        for (Eigen::Index k = 0; k < step.cols(); k++) {
            nodo.step[i][k] = single(step(i, k));
        }
    }
}

void solve(Design &d)
{
    solve_near_optimal(d);
    law_noc_shaft_config_t c{};
    c.near_optimal = near_optimal_constants(d, true, true);
    c.plausible    = encoder_limits(d);
    observer(d, c.nodo);
    c.rare              = sample_gains(c.nodo.motor, d.drive);
    c.gate              = angle_gate_constants(c.plausible, c.rare, control_period_s(d.drive));
    c.plausible.d_omega = believed_d_omega(c.plausible, c.rare, d.drive);
    c.shaft             = feedback(d);
    certify_whole(d, c.plausible, d.drive.nodo.T[2], c.near_optimal.current_ref, model_at);
    certify_shaft(d);
    keep_constants(d, c);
}

std::string summary(const Design &d)
{
    return method_line(fmt::format("EQ-NOSC-2 with N = {}, EQ-SHAFT-1 to 4", d.drive.nosc.order)) +
           residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           observer_line(d.certificate.nodo) + verdict_lines(*d.certificate.loop);
}

std::vector<std::string> mismatches(const Design &d)
{
    const auto &c   = *constants_of<law_noc_shaft_config_t>(d.config);
    auto        all = nosc_mismatches(c.near_optimal);
    all.insert(all.end(),
               {fmt::format("NODO_ORDER_MAX < {}", c.nodo.motor.order), "NODO_ENCODER_N_X != 7",
                "NODO_ENCODER_N_Y != 3", "NODO_SHAFT_N_STEP != 4", "NODO_SHAFT_N_FROM != 5"});
    return all;
}

std::string step_block(const nodo_shaft_gains_t &g)
{
    std::string s                       = "/* columns w, w_load, twist, a, d_w */\n";
    const char *rows[NODO_SHAFT_N_STEP] = {"w", "w_load", "twist", "theta"};
    for (int i = 0; i < NODO_SHAFT_N_STEP; i++) {
        s += c_row(rows[i], g.step[i], NODO_SHAFT_N_FROM);
    }
    return c_block("step", s);
}

std::string load_block(const nodo_shaft_gains_t &g)
{
    std::string s;
    const char *rows[NODO_SHAFT_N_LOAD] = {"w_load", "twist"};
    for (int i = 0; i < NODO_SHAFT_N_LOAD; i++) {
        s += fmt::format("{{ /* {} */\n", rows[i]) +
             c_indented(c_row("n = 0", g.load[i][0], 3) + c_row("n = 1", g.load[i][1], 3)) + "},\n";
    }
    return c_block("load", s);
}

Layout layout(const Design &d)
{
    const auto &c             = *constants_of<law_noc_shaft_config_t>(d.config);
    Layout      layout        = near_optimal_layout(d, c.near_optimal);
    layout["nodo.motor.gain"] = gain_block("         iq_A             id_A      theta_e_rad",
                                           {"d_w", "d_q", "d_d", "w", "iq", "id", "theta"},
                                           c.nodo.motor.order, c.nodo.motor.gain);
    layout["nodo.load"]       = load_block(c.nodo);
    layout["nodo.step"]       = step_block(c.nodo);
    return layout;
}

} // namespace

const LawDesign noc_shaft_design = [] {
    LawDesign d{"law_noc_shaft", "law_noc_shaft_config_t", is_for, solve, summary, mismatches,
                layout};
    d.shaft_states = true;
    d.weights      = Weights::by_goals;
    d.loop         = LinearLoop{loop_at};
    d.scheduling   = {{"e_iq"}, {"iq_hat"}};
    return d;
}();

} // namespace sdre
