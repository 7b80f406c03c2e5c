// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::conventional_noc;
}

/// One table of EQ-DOUBLE-SERIES-1: matrix row i of every term goes to row rows[i] of that term.
void copy_terms(const GainSeries &from, const std::vector<int> &rows, int rows_per_term,
                float (*to)[DOUBLE_SERIES_COLUMNS])
{
    for (std::size_t i = 0; i < from.gain.size(); i++) {
        const std::vector<int> &powers = from.series.terms[i].powers;
        const int               term =
            double_series_index(static_cast<int16_t>(powers[0]), static_cast<int16_t>(powers[1]));
        for (std::size_t row = 0; row < rows.size(); row++) {
            for (int column = 0; column < DOUBLE_SERIES_COLUMNS; column++) {
                to[term * rows_per_term + rows[row]][column] =
                    gain_entry(from.gain[i], static_cast<Eigen::Index>(row), column);
            }
        }
    }
}

/// An observer of the load alone gets zero rows for d_q and d_d.
conventional_gains_t gains(const Design &d)
{
    const bool           load = d.drive.nodo.form == NodoForm::conventional_load;
    conventional_gains_t g{};
    g.nosc_order    = static_cast<int16_t>(d.drive.nosc.order);
    g.nodo_order    = static_cast<int16_t>(d.drive.nodo.order);
    g.i_error_max_A = static_cast<float>(d.certificate.nosc.series_range_A);
    g.i_max_A       = static_cast<float>(d.certificate.nodo.series_range_A);
    g.i_certified_A = static_cast<float>(d.certificate.nodo.range_A);
    copy_terms(d.nosc, {0, 1}, NOSC_N_U, g.lambda);
    copy_terms(d.nodo, load ? std::vector<int>{0, 3, 4, 5} : std::vector<int>{0, 1, 2, 3, 4, 5},
               NODO_N_X, g.gain);
    return g;
}

void solve(Design &d)
{
    const int order = std::max(d.drive.nosc.order, d.drive.nodo.order);
    if (order > DOUBLE_SERIES_ORDER_MAX) {
        throw InputError(fmt::format("{}: order = {} is not allowed: a series in two variables has "
                                     "at most order {}",
                                     d.drive.name, order, DOUBLE_SERIES_ORDER_MAX));
    }
    solve_near_optimal(d);
    law_conventional_config_t c{};
    c.near_optimal = near_optimal_constants(d, false, false);
    c.gains        = gains(d);
    certify_loop(d, whole_loop(d, c.near_optimal.current_ref, speed_form_at), {});
    keep_constants(d, c);
}

std::string summary(const Design &d)
{
    return method_line(fmt::format("EQ-CONVENTIONAL-1 to 3 with N = {}, Nd = {}",
                                   d.drive.nosc.order, d.drive.nodo.order)) +
           residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           observer_line(d.certificate.nodo) + verdict_lines(*d.certificate.loop);
}

std::vector<std::string> mismatches(const Design &d)
{
    const auto &c   = *constants_of<law_conventional_config_t>(d.config);
    auto        all = nosc_mismatches(c.near_optimal);
    all.insert(all.end(), {"NODO_N_X != 6", "NODO_N_Y != 3",
                           fmt::format("DOUBLE_SERIES_ORDER_MAX < {}",
                                       std::max(c.gains.nosc_order, c.gains.nodo_order))});
    return all;
}

/// A table of EQ-DOUBLE-SERIES-1.
std::string terms_block(const char *name, const std::vector<const char *> &labels, int order,
                        const float (*rows)[DOUBLE_SERIES_COLUMNS])
{
    std::string s = "/*          omega_e_radps             iq_A             id_A */\n";
    for (int degree = 0; degree <= order; degree++) {
        for (int m = 0; m <= degree; m++) {
            s += fmt::format("/* n = {}, m = {} */\n", degree - m, m);
            for (const char *label : labels) {
                s += c_row(label, *rows++, DOUBLE_SERIES_COLUMNS);
            }
        }
    }
    return c_block(name, s);
}

Layout layout(const Design &d)
{
    const auto                 &c      = *constants_of<law_conventional_config_t>(d.config);
    const conventional_gains_t &g      = c.gains;
    Layout                      layout = near_optimal_layout(d, c.near_optimal);
    layout["gains.lambda"] = terms_block("lambda", {"v_q", "v_d"}, g.nosc_order, g.lambda);
    layout["gains.gain"] =
        terms_block("gain", {"d_w", "d_q", "d_d", "w", "iq", "id"}, g.nodo_order, g.gain);
    return layout;
}

} // namespace

const LawDesign conventional_design = [] {
    LawDesign d{"law_conventional",
                "law_conventional_config_t",
                is_for,
                solve,
                summary,
                mismatches,
                layout};
    d.scheduling = {{"e_iq", "e_id"}, {"iq_hat", "id_hat"}};
    return d;
}();

} // namespace sdre
