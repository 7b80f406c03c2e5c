// SPDX-License-Identifier: MIT
#include "emit/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/version.hpp"

namespace sdre {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const Eigen::MatrixXd &M)
{
    ordered_json rows = ordered_json::array();
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        ordered_json row = ordered_json::array();
        for (Eigen::Index j = 0; j < M.cols(); j++) {
            row.push_back(M(i, j));
        }
        rows.push_back(row);
    }
    return rows;
}

ordered_json to_json(const Eigen::VectorXcd &v)
{
    ordered_json out = ordered_json::array();
    for (Eigen::Index i = 0; i < v.size(); i++) {
        out.push_back({v(i).real(), v(i).imag()});
    }
    return out;
}

ordered_json gain_json(const GainSeries &g, const char *gain_key, const char *solution_key,
                       const char *poles_key)
{
    ordered_json gains     = ordered_json::array();
    ordered_json solutions = ordered_json::array();
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        gains.push_back(to_json(g.gain[n]));
        solutions.push_back(to_json(g.series.terms[n].X));
    }
    ordered_json out{{"order", series_order(g)},
                     {gain_key, gains},
                     {solution_key, solutions},
                     {poles_key, to_json(g.series.care.closed_loop_eigenvalues)},
                     {"residuals", g.residuals}};
    if (g.problem.dA.size() > 1) {
        for (const SeriesTerm &term : g.series.terms) {
            out["powers"].push_back(term.powers);
        }
    }
    return out;
}

ordered_json nodo_json(const Design &d)
{
    ordered_json out = gain_json(d.nodo, "gain", "pi", "eigenvalues");
    out["form"]      = nodo_form_name(d.drive.nodo.form);
    return out;
}

ordered_json loop_json(const SampledLoop &loop, const char *variable)
{
    return {{"range", {{"variable", variable}, {"min_A", -loop.range_A}, {"max_A", loop.range_A}}},
            {"series_range_A", loop.series_range_A},
            {"worst_pole_1ps", loop.worst_pole_1ps},
            {"fastest_pole_times_period", loop.fastest_pole_ts},
            {"spectral_radius", loop.spectral_radius},
            {"series_error", loop.series_error},
            {"series_error_full_range", loop.series_error_full}};
}

std::string loop_text(const char *name, const char *variable, const SampledLoop &loop)
{
    std::string s =
        fmt::format("  {}, {} in +-{:g} A (series used in +-{:.2f} A, gain held beyond)\n", name,
                    variable, loop.range_A, loop.series_range_A);
    s += fmt::format(
        "    slowest pole {:.3g} 1/s, fastest |pole| x Ts {:.2f}, sampled spectral radius {:.4f}\n",
        loop.worst_pole_1ps, loop.fastest_pole_ts, loop.spectral_radius);
    for (std::size_t n = 0; n < loop.series_error.size(); n++) {
        s += fmt::format("    order {}: gain error {:8.2e} in +-{:.2f} A, {:8.2e} in +-{:g} A\n", n,
                         loop.series_error[n], loop.series_range_A, loop.series_error_full[n],
                         loop.range_A);
    }
    return s;
}

std::string gain_text(const char *symbol, const GainSeries &g)
{
    std::string s;
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        s += fmt::format("  {}_{} (relative residual {:.1e})\n", symbol,
                         fmt::join(g.series.terms[n].powers, ","), g.residuals[n]);
        for (Eigen::Index i = 0; i < g.gain[n].rows(); i++) {
            s += fmt::format("    {:14.6g} {:14.6g} {:14.6g}\n", g.gain[n](i, 0), g.gain[n](i, 1),
                             g.gain[n](i, 2));
        }
    }
    return s;
}

std::string poles_text(const Eigen::VectorXcd &poles)
{
    std::string s;
    for (Eigen::Index i = 0; i < poles.size(); i++) {
        s += fmt::format("  {:.4g}", poles(i).real());
        if (poles(i).imag() != 0.0) {
            s += fmt::format("{:+.4g}i", poles(i).imag());
        }
    }
    return s;
}

ordered_json loop_json(const LoopCheck &loop)
{
    ordered_json at = ordered_json::object();
    for (const SensitivityAt &x : loop.at) {
        at[x.name] = {{"frequency_Hz", x.frequency_Hz}, {"sensitivity", x.value}};
    }
    return {{"spectral_radius", loop.spectral_radius},
            {"sensitivity_peak", loop.peak},
            {"sensitivity_peak_Hz", loop.peak_Hz},
            {"disturbances", at}};
}

ordered_json dobc_json(const DobcDesign &d)
{
    return {{"oscillators_radps", d.oscillators_radps},
            {"wanted_polynomial", d.wanted},
            {"matching_error", d.matching_error},
            {"l", std::vector<double>(d.l.begin(), d.l.end())},
            {"k1_Vs_per_rad", d.k1},
            {"k2_V_per_A", d.k2},
            {"K", std::vector<double>(d.K.begin(), d.K.end())},
            {"M", to_json(d.M)},
            {"g", std::vector<double>(d.g.begin(), d.g.end())},
            {"h", std::vector<double>(d.h.begin(), d.h.end())}};
}

std::string loop_text(const char *name, const LoopCheck &loop)
{
    std::string s =
        fmt::format("  {}: sensitivity peak {:.3f} at {:.1f} Hz, sampled spectral radius {:.5f}\n",
                    name, loop.peak, loop.peak_Hz, loop.spectral_radius);
    for (const SensitivityAt &x : loop.at) {
        s += fmt::format("    {:<22} {:7.2f} Hz  |S| = {:.5f}\n", x.name, x.frequency_Hz, x.value);
    }
    return s;
}

std::string dobc_text(const DobcDesign &d)
{
    std::string s = fmt::format("\nobserver (coefficients matched to {:.1e})\n", d.matching_error);
    for (Eigen::Index i = 0; i < d.l.size(); i++) {
        s += fmt::format("  l{:<2} {:.9g}\n", i + 2, d.l(i));
    }
    return s + fmt::format("\ncontroller\n  k1 {:.9g} V s/rad, k2 {:.9g} V/A\n", d.k1, d.k2);
}

std::string pid_text(const PidSpec &k)
{
    return fmt::format("\ncontroller\n  {:g} V s/rad, {:g} V/rad, {:g} V s^2/rad\n",
                       k.proportional_Vs_per_rad, k.integral_V_per_rad, k.derivative_Vs2_per_rad);
}

std::string servo_text(const Design &d)
{
    const ServoDesign &servo = *d.servo;
    return (servo.dobc ? dobc_text(*servo.dobc) : pid_text(d.drive.pid)) + "\nsampled loops\n" +
           loop_text("speed", servo.speed) + loop_text("d axis", servo.d_axis);
}

const char *channel_name(nodo_harmonic_channel_t channel)
{
    switch (channel) {
    case NODO_HARMONIC_SENSOR:
        return "current sensors";
    case NODO_HARMONIC_TORQUE:
        return "torque";
    case NODO_HARMONIC_VOLTAGE_Q:
        return "q voltage";
    case NODO_HARMONIC_VOLTAGE_D:
        return "d voltage";
    }
    return "unknown";
}

std::string harmonic_text(const Design &d)
{
    const nodo_harmonic_gains_t &t     = *d.harmonics->table;
    const HarmonicCheck         &check = d.harmonic_check;
    std::string                  s     = fmt::format(
                             "\nobserver with harmonics ({} states, {} nodes, {:.0f} to {:.0f} rad/s)\n",
                             NODO_HARMONIC_N_BASE + 2 * t.n_pairs, t.n_nodes, d.harmonics->nodes.front().omega_e_radps,
                             d.harmonics->nodes.back().omega_e_radps);
    for (int i = 0; i < t.n_pairs; i++) {
        s += fmt::format("  {:<16} order {:g}\n", channel_name(t.pair[i].channel),
                         static_cast<double>(t.pair[i].order));
    }
    s += "\ncertificate\n" + loop_text("controller", "e_iq", d.certificate.nosc);
    s += fmt::format(
        "  observer, law and motor: relative residuals <= {:.1e}, sampled spectral radius {:.5f} "
        "(at {:.0f} rad/s, iq {:.2f} A)\n",
        check.worst_residual, check.spectral_radius, check.worst_speed_e_radps, check.worst_iq_A);
    return s + loop_text("speed loop", check.speed_loop);
}

ordered_json harmonics_json(const Design &d)
{
    const nodo_harmonic_gains_t &t     = *d.harmonics->table;
    ordered_json                 pairs = ordered_json::array();
    ordered_json                 nodes = ordered_json::array();
    for (int i = 0; i < t.n_pairs; i++) {
        pairs.push_back({{"channel", channel_name(t.pair[i].channel)},
                         {"order", static_cast<double>(t.pair[i].order)}});
    }
    for (const HarmonicNode &node : d.harmonics->nodes) {
        nodes.push_back({{"omega_e_radps", node.omega_e_radps},
                         {"K0", to_json(node.K0)},
                         {"K1", to_json(node.K1)},
                         {"residual", node.residual}});
    }
    return {{"iq_max_A", static_cast<double>(t.iq_max_A)},
            {"keep", static_cast<double>(t.keep)},
            {"keep_fast", static_cast<double>(t.keep_fast)},
            {"pairs", pairs},
            {"nodes", nodes}};
}

ordered_json harmonic_check_json(const HarmonicCheck &check)
{
    return {{"spectral_radius", check.spectral_radius},
            {"worst_speed_e_radps", check.worst_speed_e_radps},
            {"worst_iq_A", check.worst_iq_A},
            {"worst_residual", check.worst_residual},
            {"speed_loop", loop_json(check.speed_loop)}};
}

ordered_json noc_h_json(const Design &d)
{
    const Certificate &c = d.certificate;
    return {{"law", law_name(d.drive.law)},
            {"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
            {"harmonics", harmonics_json(d)},
            {"harmonic_check", harmonic_check_json(d.harmonic_check)},
            {"certificate",
             {{"certified", c.passed()},
              {"failures", c.failures},
              {"nosc", loop_json(c.nosc, "e_iq")}}}};
}

std::string observer_heading(NodoForm form)
{
    const bool encoder = form == NodoForm::encoder;
    return fmt::format("\nobserver (rows d_w, {}w, iq, id{}; columns measured {})\n",
                       form == NodoForm::conventional_load ? "" : "d_q, d_d, ",
                       encoder ? ", theta" : "", encoder ? "iq, id, theta" : "w, iq, id");
}

std::string noc_text(const Design &d)
{
    const bool  two = d.drive.law == Law::conventional_noc;
    std::string s =
        "\ncontroller (rows v_q, v_d; columns e_w, e_iq, e_id)\n" + gain_text("Lambda", d.nosc);
    s += "  poles" + poles_text(d.nosc.series.care.closed_loop_eigenvalues) + " 1/s\n";
    if (d.harmonics) {
        return s + harmonic_text(d);
    }
    s += observer_heading(d.drive.nodo.form) + gain_text("L", d.nodo);
    s += "  poles" + poles_text(d.nodo.series.care.closed_loop_eigenvalues) + " 1/s\n";
    return s + "\ncertificate\n" +
           loop_text("controller", two ? "e_iq and e_id" : "e_iq", d.certificate.nosc) +
           loop_text("observer", two ? "iq_hat and id_hat" : "iq_hat", d.certificate.nodo);
}

ordered_json heading_json(const Design &d)
{
    ordered_json reduced;
    for (int i = 1; i <= 11; i++) {
        reduced[fmt::format("l{}", i)] = d.l[static_cast<std::size_t>(i)];
    }
    return {{"tool", fmt::format("sdre-gains {}", tool_version)},
            {"drive", d.drive.name},
            {"digest", drive_digest(d.drive)},
            {"control_period_s", control_period_s(d.drive)},
            {"reduced_parameters", reduced}};
}

ordered_json servo_json(const Design &d)
{
    const ServoDesign &servo = *d.servo;
    ordered_json       out   = {{"law", law_name(d.drive.law)}};
    if (servo.dobc) {
        out["dobc"] = dobc_json(*servo.dobc);
    }
    out["speed_loop"]  = loop_json(servo.speed);
    out["d_axis_loop"] = loop_json(servo.d_axis);
    out["certificate"] = {{"certified", d.certificate.passed()},
                          {"failures", d.certificate.failures}};
    return out;
}

} // namespace

std::string report_json(const Design &d)
{
    ordered_json report = heading_json(d);
    if (d.servo) {
        report.update(servo_json(d));
        return report.dump(2) + "\n";
    }
    if (d.harmonics) {
        report.update(noc_h_json(d));
        return report.dump(2) + "\n";
    }
    const Certificate &c = d.certificate;
    report.update(ordered_json{
        {"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
        {"nodo", nodo_json(d)},
        {"certificate",
         {{"certified", c.passed()},
          {"failures", c.failures},
          {"range",
           {{"e_iq_A", {-c.nosc.range_A, c.nosc.range_A}},
            {"i_q_hat_A", {-c.nodo.range_A, c.nodo.range_A}}}},
          {"worst_pole",
           {{"nosc_1ps", c.nosc.worst_pole_1ps}, {"nodo_1ps", c.nodo.worst_pole_1ps}}},
          {"series_error", {{"nosc", c.nosc.series_error}, {"nodo", c.nodo.series_error}}},
          {"nosc", loop_json(c.nosc, "e_iq")},
          {"nodo", loop_json(c.nodo, "i_q_hat")}}}});
    return report.dump(2) + "\n";
}

std::string report_text(const Design &d)
{
    std::string s =
        fmt::format("{} ({}), control period {:g} us\n\nreduced parameters\n", d.drive.name,
                    drive_digest(d.drive), 1e6 * control_period_s(d.drive));
    for (std::size_t i = 1; i <= 11; i++) {
        s += fmt::format("  l{:<3} {:.9g}\n", i, d.l[i]);
    }
    s += d.servo ? servo_text(d) : noc_text(d);
    s += d.certificate.passed() ? "\nverdict: certified\n" : "\nverdict: refused\n";
    for (const std::string &failure : d.certificate.failures) {
        s += "  " + failure + "\n";
    }
    return s;
}

} // namespace sdre
