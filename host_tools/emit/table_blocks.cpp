// SPDX-License-Identifier: MIT
#include "emit/table_blocks.hpp"

#include <vector>

#include <fmt/format.h>

namespace sdre {
namespace {

std::string number(float x)
{
    return fmt::format("{:.8e}f",
                       static_cast<double>(x)); // nine digits round-trip single precision
}

std::string field(const std::string &name, float value)
{
    return fmt::format("        .{} = {},\n", name, number(value));
}

template <std::size_t N> std::string row(const char *label, const float (&values)[N])
{
    std::string s = fmt::format("                /* {:<4}*/ {{", label);
    for (std::size_t i = 0; i < N; i++) {
        s += fmt::format("{}{:>16}", i == 0 ? " " : ", ", number(values[i]));
    }
    return s + " },\n";
}

/// The observer block of either form; Rows is 6 or 7.
template <std::size_t Rows>
std::string nodo_block(const char *name, const char *columns, int order, const std::string &ranges,
                       const float (&gain)[NODO_ORDER_MAX + 1][Rows][3])
{
    const char *labels[] = {"d_w", "d_q", "d_d", "w", "iq", "id", "theta"};
    std::string s        = fmt::format("    .{} = {{\n        .order = {},\n", name, order);
    s += ranges + "        .gain = {\n";
    for (int n = 0; n <= order; n++) {
        s += fmt::format("            {{ /* n = {} */\n", n);
        s += fmt::format("                /*          {} */\n", columns);
        for (std::size_t i = 0; i < Rows; i++) {
            s += row(labels[i], gain[n][i]);
        }
        s += "            },\n";
    }
    return s + "        },\n    },\n";
}

template <std::size_t N> std::string list(const float (&values)[N], int count)
{
    std::string s = "{";
    for (int i = 0; i < count; i++) {
        s += fmt::format("{}{:>16}", i == 0 ? " " : ", ", number(values[i]));
    }
    return s + " }";
}

std::string pid_block(const char *name, const pid_law_config_t &c)
{
    return fmt::format("        .{} = {{ .kp = {}, .ki_per_tick = {}, .kd_tick = {} }},\n", name,
                       number(c.kp), number(c.ki_per_tick), number(c.kd_tick));
}

std::string dobc_block(const dobc_config_t &c)
{
    std::string s = fmt::format("        .dobc = {{\n            .n_x = {},\n", c.n_x);
    s += fmt::format("            .direct_Vs = {},\n            .ld_H = {},\n"
                     "            .k_omega_Vs = {},\n",
                     number(c.direct_Vs), number(c.ld_H), number(c.k_omega_Vs));
    s += fmt::format("            .k_x = {},\n            .m = {{\n", list(c.k_x, c.n_x));
    for (int i = 0; i < c.n_x; i++) {
        s += fmt::format("                {},\n", list(c.m[i], c.n_x));
    }
    return s +
           fmt::format("            }},\n            .g = {},\n            .h = {},\n        }},\n",
                       list(c.g, c.n_x), list(c.h, c.n_x));
}

/// A table of EQ-DOUBLE-SERIES-1.
std::string double_series_block(const char *name, const std::vector<const char *> &labels,
                                int order, const float (*values)[DOUBLE_SERIES_COLUMNS])
{
    std::string s = fmt::format("        .{} = {{\n", name);
    s += "                /*          omega_e_radps             iq_A             id_A */\n";
    for (int degree = 0; degree <= order; degree++) {
        for (int m = 0; m <= degree; m++) {
            s += fmt::format("            /* n = {}, m = {} */\n", degree - m, m);
            for (const char *label : labels) {
                s += row(label, *values++);
            }
        }
    }
    return s + "        },\n";
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

std::string harmonic_label(int row)
{
    const char *base[NODO_HARMONIC_N_BASE] = {"d_w", "d_q", "d_d",   "w",
                                              "iq",  "id",  "theta", "d_w'"};
    if (row < NODO_HARMONIC_N_BASE) {
        return base[row];
    }
    const int i = row - NODO_HARMONIC_N_BASE;
    return fmt::format("{}{}", i % 2 == 0 ? 'a' : 'b', i / 2);
}

} // namespace

std::string scalar(const std::string &name, float value)
{
    return fmt::format("    .{} = {},\n", name, number(value));
}

std::string motor_block(const motor_reduced_t &m)
{
    return "    .motor = {\n" + field("l1", m.l1) + field("l2", m.l2) + field("l3", m.l3) +
           field("l4", m.l4) + field("l5", m.l5) + field("l6", m.l6) + field("l7", m.l7) +
           field("l8", m.l8) + field("l9", m.l9) + field("l10", m.l10) + field("l11", m.l11) +
           field("inv_l6", m.inv_l6) + field("inv_l8", m.inv_l8) + "    },\n";
}

std::string current_ref_block(const current_ref_config_t &c)
{
    return "    .current_ref = {\n" + field("current_max_A", c.current_max_A) +
           field("iq_max_A", c.iq_max_A) + field("mtpa_A", c.mtpa_A) +
           fmt::format("        .mtpa_exact = {},\n", c.mtpa_exact) +
           field("voltage_share", c.voltage_share) + field("torque_share", c.torque_share) +
           field("near_e_radps", c.near_e_radps) + field("l1_min", c.l1_min) +
           field("filter_per_period", c.filter_per_period) + field("filter_1ps", c.filter_1ps) +
           field("regen_max_W_norm", c.regen_max_W_norm) + field("regen_start_V", c.regen_start_V) +
           field("regen_per_V", c.regen_per_V) + "    },\n";
}

std::string dead_time_block(const dead_time_config_t &c)
{
    return "    .dead_time = {\n" + field("share", c.share) +
           field("inv_fade_1pA", c.inv_fade_1pA) + "    },\n";
}

std::string nosc_block(const nosc_gains_t &g)
{
    std::string s = fmt::format("    .nosc = {{\n        .order = {},\n", g.order);
    s += field("iq_error_max_A", g.iq_error_max_A) + field("iq_speed_max_A", g.iq_speed_max_A) +
         "        .lambda = {\n";
    for (int n = 0; n <= g.order; n++) {
        s += fmt::format("            {{ /* n = {} */\n", n);
        s += "                /*          omega_e_radps             iq_A             id_A */\n";
        s += row("v_q", g.lambda[n][0]) + row("v_d", g.lambda[n][1]) + "            },\n";
    }
    return s + "        },\n    },\n";
}

std::string observer_block(const drive_config_t &c)
{
    if (c.form == DRIVE_FORM_ENCODER) {
        const nodo_encoder_gains_t &g = c.nodo_encoder;
        return nodo_block("nodo_encoder", "           iq_A             id_A      theta_e_rad",
                          g.order, field("iq_max_A", g.iq_max_A), g.gain);
    }
    return nodo_block("nodo", "omega_e_radps             iq_A             id_A", c.nodo.order,
                      field("iq_max_A", c.nodo.iq_max_A) +
                          field("iq_certified_A", c.nodo.iq_certified_A),
                      c.nodo.gain);
}

std::string servo_block(const servo_law_config_t &c)
{
    const bool pid = c.kind == SERVO_LAW_PID;
    return fmt::format("    .servo = {{\n        .kind = {},\n",
                       pid ? "SERVO_LAW_PID" : "SERVO_LAW_DOBC") +
           (pid ? pid_block("pid", c.pid) : dobc_block(c.dobc)) + pid_block("id_pi", c.id_pi) +
           "    },\n";
}

std::string conventional_block(const conventional_gains_t &g)
{
    return fmt::format("    .conventional = {{\n        .nosc_order = {},\n"
                       "        .nodo_order = {},\n",
                       g.nosc_order, g.nodo_order) +
           field("i_error_max_A", g.i_error_max_A) + field("i_max_A", g.i_max_A) +
           field("i_certified_A", g.i_certified_A) +
           double_series_block("lambda", {"v_q", "v_d"}, g.nosc_order, g.lambda) +
           double_series_block("gain", {"d_w", "d_q", "d_d", "w", "iq", "id"}, g.nodo_order,
                               g.gain) +
           "    },\n";
}

std::string harmonic_table(const char *name, const nodo_harmonic_gains_t &g)
{
    std::string s = fmt::format("static const nodo_harmonic_gains_t {} = {{\n    .n_pairs = {},\n"
                                "    .n_nodes = {},\n",
                                name, g.n_pairs, g.n_nodes);
    s += scalar("iq_max_A", g.iq_max_A) + scalar("nodes_per_root", g.nodes_per_root) +
         scalar("keep", g.keep) + scalar("keep_fast", g.keep_fast) +
         (g.n_pairs > 0 ? "    .pair = {\n" : "");
    for (int i = 0; i < g.n_pairs; i++) {
        s += fmt::format("        {{ .channel = {}, .order = {} }},\n",
                         channel_symbol(g.pair[i].channel), number(g.pair[i].order));
    }
    s += g.n_pairs > 0 ? "    },\n" : ""; // an empty initialiser is not C99
    s += "    .gain = { /* columns iq_A, id_A, theta_e_rad; then the same per ampere of iq */\n";
    for (int node = 0; node < g.n_nodes; node++) {
        const double root = node / static_cast<double>(g.nodes_per_root);
        s += fmt::format("        {{ /* {:.1f} rad/s */\n", root * root);
        for (int i = 0; i < NODO_HARMONIC_N_BASE + 2 * g.n_pairs; i++) {
            s += row(harmonic_label(i).c_str(), g.gain[node][i]);
        }
        s += "        },\n";
    }
    return s + "    },\n};\n\n";
}

} // namespace sdre
