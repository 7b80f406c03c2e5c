// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::noc && drive.nodo.form == NodoForm::speed;
}

void solve(Design &d)
{
    solve_near_optimal(d);
    law_noc_speed_config_t c{};
    c.near_optimal        = near_optimal_constants(d, false, true); // the paper's second order
    c.nodo.order          = static_cast<int16_t>(d.drive.nodo.order);
    c.nodo.iq_max_A       = static_cast<float>(d.certificate.nodo.series_range_A);
    c.nodo.iq_certified_A = static_cast<float>(d.certificate.nodo.range_A);
    copy_series(d.nodo, c.nodo.gain);
    certify_loop(d, whole_loop(d, c.near_optimal.current_ref, speed_form_at), {});
    keep_constants(d, c);
}

std::string summary(const Design &d)
{
    return method_line(fmt::format("EQ-NOSC-2 with N = {}, EQ-NODO-2 with Nd = {}",
                                   d.drive.nosc.order, d.drive.nodo.order)) +
           residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           observer_line(d.certificate.nodo) + verdict_lines(*d.certificate.loop);
}

std::vector<std::string> mismatches(const Design &d)
{
    const auto &c   = *constants_of<law_noc_speed_config_t>(d.config);
    auto        all = nosc_mismatches(c.near_optimal);
    all.insert(all.end(), {fmt::format("NODO_ORDER_MAX < {}", c.nodo.order), "NODO_N_X != 6",
                           "NODO_N_Y != 3"});
    return all;
}

Layout layout(const Design &d)
{
    const auto &c      = *constants_of<law_noc_speed_config_t>(d.config);
    Layout      layout = near_optimal_layout(d, c.near_optimal);
    layout["nodo.gain"] =
        gain_block("omega_e_radps             iq_A             id_A",
                   {"d_w", "d_q", "d_d", "w", "iq", "id"}, c.nodo.order, c.nodo.gain);
    return layout;
}

} // namespace

const LawDesign noc_speed_design = [] {
    LawDesign d{"law_noc_speed", "law_noc_speed_config_t", is_for, solve, summary, mismatches,
                layout};
    d.weights    = Weights::by_goals;
    d.scheduling = {{"e_iq"}, {"iq_hat"}};
    d.noise_knob = observer_knob("noc");
    return d;
}();

} // namespace sdre
