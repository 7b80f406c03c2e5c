// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/laws/noc_inertia.hpp"
#include "design/laws/nodo_current.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::noc && drive.nodo.form == NodoForm::encoder;
}

void certify_currents(Design &d, const CurrentObserver &o)
{
    if (!(o.spectral_radius < 1.0) || !(o.worst_residual <= residual_limit)) {
        d.certificate.failures.push_back(fmt::format(
            "observer without encoder: spectral radius {:.5f}, relative residual {:.1e}",
            o.spectral_radius, o.worst_residual));
    }
}

SampledModel model_at(const Design &d, const TrueMotor &motor, const OperatingPoint &at,
                      const Eigen::MatrixXd &Lambda, const MovingReference *moving)
{
    return sampled_model(motor, d.l, encoder_form_gains(d, at.iq_A, Lambda), at,
                         control_period_s(d.drive), moving);
}

SampledModel loop_at(const Design &d, const TrueMotor &motor, const Shaft & /*rigid*/,
                     const OperatingPoint &at, const LoopGains &gains)
{
    return sampled_model(motor, d.l, gains, at, control_period_s(d.drive));
}

void solve(Design &d)
{
    solve_near_optimal(d);
    law_noc_config_t c{};
    if (d.drive.torque) {
        d.torque = solve_torque(at_rest(d.l), d.drive, d.precision);
        c.torque = torque_constants(d);
    }
    c.near_optimal  = near_optimal_constants(d, true, true);
    c.plausible     = encoder_limits(d);
    c.nodo.order    = static_cast<int16_t>(d.drive.nodo.order);
    c.nodo.iq_max_A = static_cast<float>(d.certificate.nodo.series_range_A);
    copy_series(d.nodo, c.nodo.gain);
    c.rare              = sample_gains(c.nodo, d.drive);
    c.gate              = angle_gate_constants(c.plausible, c.rare, control_period_s(d.drive));
    c.plausible.d_omega = believed_d_omega(c.plausible, c.rare, d.drive);
    const CurrentObserver currents = design_nodo_current(d.l, d.drive, trip_speed_e_radps(d.drive));
    c.currents                     = currents.gains;
    c.inertia                      = {1.0F, 1.0F};
    certify_currents(d, currents);
    certify_whole(d, c.plausible, d.drive.nodo.T[2], c.near_optimal.current_ref, model_at);
    certify_shaft(d);
    keep_constants(d, c);
    if (d.precision == Precision::extended && d.certificate.passed()) {
        c.inertia = believable_inertia(d, model_at);
        keep_constants(d, c);
    }
}

std::string summary(const Design &d)
{
    return method_line(fmt::format("EQ-NOSC-2 with N = {}, EQ-NODO-ENCODER-3 with Nd = {}",
                                   d.drive.nosc.order, d.drive.nodo.order)) +
           residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           observer_line(d.certificate.nodo) + verdict_lines(*d.certificate.loop) +
           inertia_line(constants_of<law_noc_config_t>(d.config)->inertia);
}

std::vector<std::string> mismatches(const Design &d)
{
    const auto &c   = *constants_of<law_noc_config_t>(d.config);
    auto        all = nosc_mismatches(c.near_optimal);
    all.insert(all.end(), {fmt::format("NODO_ORDER_MAX < {}", c.nodo.order),
                           "NODO_ENCODER_N_X != 7", "NODO_ENCODER_N_Y != 3"});
    return all;
}

Layout layout(const Design &d)
{
    const auto &c      = *constants_of<law_noc_config_t>(d.config);
    Layout      layout = near_optimal_layout(d, c.near_optimal);
    layout["nodo.gain"] =
        gain_block("         iq_A             id_A      theta_e_rad",
                   {"d_w", "d_q", "d_d", "w", "iq", "id", "theta"}, c.nodo.order, c.nodo.gain);
    layout["currents.gain"] = nodo_current_block(c.currents);
    if (!d.torque) {
        layout["torque"] = "";
    }
    return layout;
}

} // namespace

const LawDesign noc_design = [] {
    LawDesign d{"law_noc", "law_noc_config_t", is_for, solve, summary, mismatches, layout};
    d.loop       = LinearLoop{loop_at};
    d.weights    = Weights::by_goals;
    d.scheduling = {{"e_iq"}, {"iq_hat"}};
    d.noise_knob = observer_knob("noc");
    return d;
}();

} // namespace sdre
