// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "common/parallel.hpp"
#include "design/certificate.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/noc_h/harmonic_loop.hpp"
#include "design/sampled_model.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

// Chosen: four points between two nodes of the table where they are closest, and every half of the current limit.
constexpr int speed_points   = 64;
constexpr int current_points = 4;

bool is_for(const Drive &drive)
{
    return drive.law == Law::noc_h;
}

/// Stability wherever the firmware can be, with the table's interpolated gains; negative speeds are mirror images.
void sweep(Design &d)
{
    const nodo_harmonic_gains_t &table    = *d.harmonics->table;
    HarmonicCheck               &check    = d.harmonic_check;
    const double                 ts       = control_period_s(d.drive);
    const double                 trip     = d.harmonics->nodes.back().omega_e_radps;
    const double                 range    = 2.0 * d.drive.motor.max_current_A;
    const auto                   at_speed = [&](std::size_t k) {
        HarmonicCheck worst;
        for (int j = -current_points; j <= current_points; j++) {
            const double         iq = range * j / current_points;
            const OperatingPoint at{trip * static_cast<double>(k) / speed_points, iq,
                                    mtpa_id_A(d.l, iq)};
            const double         radius =
                spectral_radius(sampled_harmonic_model(d.l, d.l, table, d.nosc.gain[0], at, ts).A);
            if (radius > worst.spectral_radius) {
                worst.spectral_radius     = radius;
                worst.worst_speed_e_radps = at.omega_e_radps;
                worst.worst_iq_A          = iq;
            }
        }
        return worst;
    };
    std::array<HarmonicCheck, speed_points + 1> found;
    parallel_for(found.size(), [&](std::size_t k) { found[k] = at_speed(k); });
    const auto smaller = [](const HarmonicCheck &a, const HarmonicCheck &b) {
        return a.spectral_radius < b.spectral_radius;
    };
    check = *std::max_element(found.begin(), found.end(), smaller);
    const OperatingPoint  at{d.drive.harmonics.weight_speed_e_radps, 0.0, 0.0};
    const HarmonicSampled loop = sampled_harmonic_model(d.l, d.l, table, d.nosc.gain[0], at, ts);
    check.speed_loop = check_loop({loop.A, loop.B_voltage.col(0), loop.C_voltage.row(0), ts},
                                  disturbance_frequencies(d.drive));
}

HarmonicSampled model_at(const Design &d, const TrueMotor &motor, const OperatingPoint &at,
                         const Eigen::MatrixXd &Lambda, const MovingReference *moving)
{
    return sampled_harmonic_model(motor, d.l, *d.harmonics->table, Lambda, at,
                                  control_period_s(d.drive), moving);
}

void certify_harmonics(Design &d)
{
    HarmonicCheck &check = d.harmonic_check;
    sweep(d);
    for (const HarmonicNode &node : d.harmonics->nodes) {
        check.worst_residual = std::max(check.worst_residual, node.residual);
    }
    std::vector<std::string> &failures = d.certificate.failures;
    if (!(check.spectral_radius < 1.0)) {
        failures.push_back(fmt::format("noc_h: the sampled loop is unstable at {:.0f} rad/s, iq "
                                       "{:.2f} A: spectral radius {:.5f}",
                                       check.worst_speed_e_radps, check.worst_iq_A,
                                       check.spectral_radius));
    }
    if (!(check.worst_residual <= residual_limit)) {
        failures.push_back(fmt::format("noc_h: relative residual {:.1e} exceeds {:.0e}",
                                       check.worst_residual, residual_limit));
    }
}

/// Those of standstill, where edges are rare.
encoder_form_gains_t sample_gains(const Design &d)
{
    const HarmonicNode &node = d.harmonics->nodes.front();
    const auto          gain = [&](int row) { return static_cast<float>(node.K0(row, 2)); };
    return {gain(6), gain(3), gain(0), static_cast<float>(count_e_rad(d.drive))};
}

void solve(Design &d)
{
    const Motor &m    = d.drive.motor;
    const double trip = trip_speed_e_radps(d.drive);
    solve_near_optimal(d);
    d.harmonics = design_harmonics(d.l, d.drive, trip, m.max_current_A);
    certify_harmonics(d);
    law_noc_h_config_t c{};
    c.near_optimal      = near_optimal_constants(d, true, true);
    c.plausible         = encoder_limits(d);
    c.nodo              = *d.harmonics->table;
    c.rare              = sample_gains(d);
    c.gate              = angle_gate_constants(c.plausible, c.rare, control_period_s(d.drive));
    c.plausible.d_omega = believed_d_omega(c.plausible, c.rare, d.drive);
    certify_whole(d, c.plausible, angle_weight(d.drive, m.rated_speed_e_radps),
                  c.near_optimal.current_ref, model_at);
    keep_constants(d, c);
}

std::string summary(const Design &d)
{
    const nodo_harmonic_gains_t &t = *d.harmonics->table;
    const HarmonicCheck         &c = d.harmonic_check;
    return method_line(
               fmt::format("EQ-NOSC-2 with N = {}, EQ-HARMONIC-3 with {} pairs and {} nodes",
                           d.drive.nosc.order, t.n_pairs, t.n_nodes)) +
           residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           verdict_lines(*d.certificate.loop) +
           fmt::format(" *            loop:       sampled spectral radius {:.5f} at {:.0f} rad/s, "
                       "iq {:.2f} A, worst up to {:.0f} rad/s\n"
                       " *            speed loop: sensitivity peak {:.3g} at {:.0f} Hz\n",
                       c.spectral_radius, c.worst_speed_e_radps, c.worst_iq_A,
                       d.harmonics->nodes.back().omega_e_radps, c.speed_loop.peak,
                       c.speed_loop.peak_Hz);
}

std::vector<std::string> mismatches(const Design &d)
{
    const auto &c   = *constants_of<law_noc_h_config_t>(d.config);
    auto        all = nosc_mismatches(c.near_optimal);
    all.insert(all.end(), {fmt::format("NODO_HARMONIC_PAIRS_MAX < {}", c.nodo.n_pairs),
                           fmt::format("NODO_HARMONIC_NODES_MAX < {}", c.nodo.n_nodes),
                           fmt::format("NODO_HARMONIC_N_BASE != {}", NODO_HARMONIC_N_BASE),
                           fmt::format("NODO_HARMONIC_N_G != {}", NODO_HARMONIC_N_G)});
    return all;
}

const char *channel_symbol(nodo_harmonic_channel_t channel)
{
    switch (channel) {
    case NODO_HARMONIC_SENSOR:
        return "NODO_HARMONIC_SENSOR";
    case NODO_HARMONIC_TORQUE:
        return "NODO_HARMONIC_TORQUE";
    case NODO_HARMONIC_VOLTAGE_Q:
        return "NODO_HARMONIC_VOLTAGE_Q";
    case NODO_HARMONIC_VOLTAGE_D:
        return "NODO_HARMONIC_VOLTAGE_D";
    }
    return "unknown";
}

std::string row_label(int row)
{
    const char *base[NODO_HARMONIC_N_BASE] = {"d_w", "d_q", "d_d",   "w",
                                              "iq",  "id",  "theta", "d_w'"};
    if (row < NODO_HARMONIC_N_BASE) {
        return base[row];
    }
    const int i = row - NODO_HARMONIC_N_BASE;
    return fmt::format("{}{}", i % 2 == 0 ? 'a' : 'b', i / 2);
}

std::string nodes_block(const nodo_harmonic_gains_t &g)
{
    std::string s = "/* columns iq_A, id_A, theta_e_rad; then the same per ampere of iq */\n";
    for (int i = 0; i < NODO_HARMONIC_N_BASE + 2 * g.n_pairs; i++) {
        std::string nodes;
        for (int node = 0; node < g.n_nodes; node++) {
            const double root = node / static_cast<double>(g.nodes_per_root);
            nodes +=
                c_row(fmt::format("{:.1f} rad/s", root * root), g.gain[i][node], NODO_HARMONIC_N_G);
        }
        s += fmt::format("{{ /* {} */\n", row_label(i)) + c_indented(nodes) + "},\n";
    }
    return c_block("gain", s);
}

std::string pairs_block(const nodo_harmonic_gains_t &g)
{
    std::string pairs;
    for (int i = 0; i < g.n_pairs; i++) {
        pairs += fmt::format("{{ .channel = {}, .order = {} }},\n",
                             channel_symbol(g.pair[i].channel), c_number(g.pair[i].order));
    }
    return g.n_pairs > 0 ? c_block("pair", pairs) : ""; // {} is not C99
}

Layout layout(const Design &d)
{
    const auto &c       = *constants_of<law_noc_h_config_t>(d.config);
    Layout      layout  = near_optimal_layout(d, c.near_optimal);
    layout["nodo.pair"] = pairs_block(c.nodo);
    layout["nodo.gain"] = nodes_block(c.nodo);
    return layout;
}

} // namespace

const LawDesign noc_h_design = [] {
    LawDesign d{"law_noc_h", "law_noc_h_config_t", is_for, solve, summary, mismatches, layout};
    d.own_observer         = true;
    d.weights              = Weights::by_physics;
    d.design_speed_e_radps = [](const Drive &drive) {
        return drive.harmonics.weight_speed_e_radps;
    };
    d.noise_knob = observer_knob("noc_h");
    return d;
}();

} // namespace sdre
