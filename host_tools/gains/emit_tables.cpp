// SPDX-License-Identifier: MIT
#include "emit_tables.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "errors.hpp"
#include "file_output.hpp"
#include "version.hpp"

namespace sdre {
namespace {

constexpr const char *header_name = "gain_tables.h";
constexpr const char *source_name = "gain_tables.c";
// Gains computed by different compilers agree far better; a real difference is far larger.
constexpr double check_relative = 1e-6;
constexpr double check_absolute = 1e-12;

std::string number(float x)
{
    return fmt::format("{:.8e}f",
                       static_cast<double>(x)); // nine digits round-trip single precision
}

std::string field(const std::string &name, float value)
{
    return fmt::format("        .{} = {},\n", name, number(value));
}

std::string scalar(const std::string &name, float value)
{
    return fmt::format("    .{} = {},\n", name, number(value));
}

template <std::size_t N> std::string row(const char *label, const float (&values)[N])
{
    std::string s = fmt::format("                /* {:<4}*/ {{", label);
    for (std::size_t i = 0; i < N; i++) {
        s += fmt::format("{}{:>16}", i == 0 ? " " : ", ", number(values[i]));
    }
    return s + " },\n";
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

std::string servo_block(const servo_law_config_t &c)
{
    const bool pid = c.kind == SERVO_LAW_PID;
    return fmt::format("    .servo = {{\n        .kind = {},\n",
                       pid ? "SERVO_LAW_PID" : "SERVO_LAW_DOBC") +
           (pid ? pid_block("pid", c.pid) : dobc_block(c.dobc)) + pid_block("id_pi", c.id_pi) +
           "    },\n";
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

std::string noc_summary(const Design &d)
{
    const double worst =
        std::max(*std::max_element(d.nosc.residuals.begin(), d.nosc.residuals.end()),
                 *std::max_element(d.nodo.residuals.begin(), d.nodo.residuals.end()));
    const SampledLoop &c = d.certificate.nosc;
    const SampledLoop &o = d.certificate.nodo;
    const char        *observer =
        d.drive.nodo.form == NodoForm::encoder ? "EQ-NODO-ENCODER-3" : "EQ-NODO-2";
    std::string s = d.drive.law == Law::conventional_noc
                        ? fmt::format(" * method     EQ-CONVENTIONAL-1 to 3 with N = {}, Nd = {}\n",
                                      d.drive.nosc.order, d.drive.nodo.order)
                        : fmt::format(" * method     EQ-NOSC-2 with N = {}, {} with Nd = {}\n",
                                      d.drive.nosc.order, observer, d.drive.nodo.order);
    s += fmt::format(" * checked    relative residuals <= {:.0e}\n", std::max(worst, 1e-16));
    s += fmt::format(" *            controller: slowest pole {:.0f} 1/s, sampled spectral radius "
                     "{:.3f}, |e_iq| <= {:g} A\n",
                     c.worst_pole_1ps, c.spectral_radius, c.range_A);
    s += fmt::format(" *            observer:   slowest pole {:.0f} 1/s, sampled spectral radius "
                     "{:.3f}, |iq| <= {:g} A\n",
                     o.worst_pole_1ps, o.spectral_radius, o.range_A);
    return s;
}

std::string servo_summary(const Design &d)
{
    const ServoDesign &servo = *d.servo;
    std::string        s =
        fmt::format(" * method     {}, {}\n", law_name(d.drive.law),
                    servo.dobc ? "EQ-DOBC-1 to 3 with gains of EQ-DOBC-5 to 7" : "EQ-PID-1, 2");
    for (const auto &[name, loop] :
         {std::pair("speed loop:", &servo.speed), {"d axis:", &servo.d_axis}}) {
        s += fmt::format(" * checked    {:<11} sensitivity peak {:.3g} at {:.0f} Hz, sampled "
                         "spectral radius {:.4f}\n",
                         name, loop->peak, loop->peak_Hz, loop->spectral_radius);
    }
    return s;
}

std::string header_text(const Design &d)
{
    std::string s =
        "/* SPDX-License-Identifier: MIT */\n"
        "/* Generated by sdre-gains. Do not edit: change the drive file and run ./dev gains\n *\n";
    s += fmt::format(" * generator  sdre-gains {}, schema {}\n", tool_version, drive_schema);
    s += fmt::format(" * drive      {}\n", d.drive.name);
    s += fmt::format(" * digest     {} (of the normalised drive file)\n", drive_digest(d.drive));
    s += d.servo ? servo_summary(d) : noc_summary(d);
    for (const std::string &failure : d.certificate.failures) {
        s += fmt::format(" * NOT CERTIFIED: {}\n", failure);
    }
    s += " */\n#ifndef GAIN_TABLES_H\n#define GAIN_TABLES_H\n\n#include \"drive_config.h\"\n\n";
    s += fmt::format("#define GAIN_TABLES_SCHEMA {}\n", drive_schema);
    s += fmt::format("#define GAIN_TABLES_NAME   \"{}\"\n", d.drive.name);
    s += fmt::format("#define GAIN_TABLES_DIGEST \"{}\"\n\n", drive_digest(d.drive));
    return s + "extern const drive_config_t gain_tables_drive;\n\n#endif /* GAIN_TABLES_H */\n";
}

std::string source_text(const Design &d)
{
    const drive_config_t &c = d.config;
    std::string           s = "/* SPDX-License-Identifier: MIT */\n";
    s += fmt::format("/* Generated by sdre-gains {}, {}. Do not edit. */\n", tool_version,
                     drive_digest(d.drive));
    s += "/* clang-format off */\n#include \"gain_tables.h\"\n\n";
    const bool servo   = c.law == DRIVE_LAW_SERVO;
    const bool encoder = c.form == DRIVE_FORM_ENCODER;
    s += servo
             ? fmt::format("#if (GAIN_TABLES_SCHEMA != {}) || (DOBC_N_X_MAX < {})\n", drive_schema,
                           c.servo.dobc.n_x)
             : fmt::format(
                   "#if (GAIN_TABLES_SCHEMA != {}) || (NOSC_ORDER_MAX < {}) || (NOSC_N_U != 2) || "
                   "(NOSC_N_E != 3) || \\\n    (NODO_ORDER_MAX < {}) || (NODO_N_X != 6) || "
                   "(NODO_N_Y != 3) || "
                   "\\\n    (NODO_ENCODER_N_X != 7) || (NODO_ENCODER_N_Y != 3)\n",
                   drive_schema, c.nosc.order, d.drive.nodo.order);
    if (c.law == DRIVE_LAW_CONVENTIONAL) {
        s.pop_back();
        s += fmt::format(" || \\\n    (DOUBLE_SERIES_ORDER_MAX < {})\n",
                         std::max(c.conventional.nosc_order, c.conventional.nodo_order));
    }
    s += "#error \"gain_tables.c does not match the control core: regenerate\"\n#endif\n\n";
    s += "const drive_config_t gain_tables_drive = {\n";
    s += scalar("ts_s", c.ts_s) + scalar("trip_current_A", c.trip_current_A) +
         scalar("trip_speed_e_radps", c.trip_speed_e_radps) +
         scalar("trip_angle_rad", c.trip_angle_rad) + scalar("trip_d_omega", c.trip_d_omega) +
         scalar("dc_link_min_V", c.dc_link_min_V) + scalar("dc_link_max_V", c.dc_link_max_V);
    s += fmt::format("    .overmodulation = {},\n", c.overmodulation);
    if (servo) {
        s += "    .law = DRIVE_LAW_SERVO,\n" + motor_block(c.motor);
        s += "    .current_ref = {\n" + field("current_max_A", c.current_ref.current_max_A) +
             "    },\n" + dead_time_block(c.dead_time) + servo_block(c.servo);
        return s + "};\n";
    }
    const bool conventional = c.law == DRIVE_LAW_CONVENTIONAL;
    s += fmt::format("    .law = {},\n", conventional ? "DRIVE_LAW_CONVENTIONAL" : "DRIVE_LAW_NOC");
    s += fmt::format("    .form = {},\n", encoder ? "DRIVE_FORM_ENCODER" : "DRIVE_FORM_SPEED");
    s += motor_block(c.motor) + current_ref_block(c.current_ref) + dead_time_block(c.dead_time) +
         nosc_block(c.nosc) +
         (conventional ? conventional_block(c.conventional) : observer_block(c));
    return s + "};\n";
}

/// Splits text into numbers (with a digit-led mantissa) and everything between them.
struct Token {
    bool        is_number;
    double      value;
    std::string text;
};

std::vector<Token> tokens(const std::string &text)
{
    std::vector<Token> out;
    std::string        word;
    const auto         flush = [&] {
        if (word.empty()) {
            return;
        }
        char        *end     = nullptr;
        const double value   = std::strtod(word.c_str(), &end);
        const bool   numeric = end != word.c_str() &&
                             (*end == '\0' || (*end == 'f' && end[1] == '\0')) &&
                             word.find('.') != std::string::npos;
        out.push_back({numeric, value, word});
        word.clear();
    };
    for (const char c : text) {
        if (std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',') {
            flush();
        } else {
            word += c;
        }
    }
    flush();
    return out;
}

/// Comments carry the certificate's rounded figures; only code is compared.
std::string without_comments(const std::string &text)
{
    std::string out;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t open = text.find("/*", at);
        out += text.substr(at, open == std::string::npos ? std::string::npos : open - at);
        if (open == std::string::npos) {
            break;
        }
        const std::size_t close = text.find("*/", open);
        at                      = close == std::string::npos ? text.size() : close + 2;
        out += ' ';
    }
    return out;
}

std::string compare_text(const std::string &expected, const std::string &found,
                         const std::string &file)
{
    const std::vector<Token> a = tokens(without_comments(expected));
    const std::vector<Token> b = tokens(without_comments(found));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); i++) {
        const double allowed =
            check_absolute + check_relative * std::max(std::abs(a[i].value), std::abs(b[i].value));
        const bool equal = (a[i].is_number && b[i].is_number)
                               ? std::abs(a[i].value - b[i].value) <= allowed
                               : a[i].text == b[i].text;
        if (!equal) {
            return fmt::format("{}: '{}' where the drive file gives '{}'", file, b[i].text,
                               a[i].text);
        }
    }
    return a.size() == b.size()
               ? ""
               : fmt::format("{}: length differs from what the drive file gives", file);
}

} // namespace

TableText table_text(const Design &design)
{
    return {header_text(design), source_text(design)};
}

void write_tables(const TableText &text, const std::filesystem::path &directory)
{
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) {
        throw InputError(
            fmt::format("{}: cannot create directory: {}", directory.string(), error.message()));
    }
    write_files({{directory / header_name, text.header}, {directory / source_name, text.source}});
}

std::string compare_tables(const TableText &text, const std::filesystem::path &directory)
{
    const std::filesystem::path header = directory / header_name;
    const std::filesystem::path source = directory / source_name;
    const std::string           difference =
        compare_text(text.header, read_text_file(header), header.string());
    return difference.empty() ? compare_text(text.source, read_text_file(source), source.string())
                              : difference;
}

} // namespace sdre
