// SPDX-License-Identifier: MIT
#include "emit/report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "emit/report_machine.hpp"
#include "emit/report_parts.hpp"
#include "emit/report_torque.hpp"

namespace sdre {
namespace {

std::string loop_text(const char *name, const std::string &variable, const SampledLoop &loop)
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
            s += "   ";
            for (Eigen::Index k = 0; k < g.gain[n].cols(); k++) {
                s += fmt::format(" {:14.6g}", report_entry(g.gain[n], i, k));
            }
            s += "\n";
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

std::string point_text(const OperatingPoint &at)
{
    return fmt::format("at {:.0f} rad/s, iq {:.2f} A", at.omega_e_radps, at.iq_A);
}

std::string box_text(const RobustBox &box, const RobustBox &alone)
{
    return fmt::format("  motors: stable with R, L, flux x{:.2f} .. {:.2f} and J x{:.2f} .. {:.2f} "
                       "all at once{}\n  one at a time: {}\n",
                       std::pow(0.5, box.share), std::pow(1.5, box.share), std::pow(0.5, box.share),
                       std::pow(3.0, box.share),
                       box.corner.empty() ? "" : "; first unstable: " + box.corner,
                       alone.corner.empty() ? "R, L, flux x0.5 .. 1.5, J x0.5 .. 3"
                                            : "unstable with " + alone.corner);
}

/// The whole loop; nothing for laws that have no such model.
std::string verdict_text(const Certificate &c)
{
    if (!c.loop) {
        return "";
    }
    const Verdict &v = *c.loop;
    std::string    s = fmt::format("\nwhole loop\n  sampled spectral radius {:.5f} {}\n",
                                   v.spectral_radius, point_text(v.radius_at));
    for (const Channel &channel : v.channels) {
        s += loop_text(channel.name.c_str(), channel.worst);
    }
    if (v.box) {
        s += box_text(*v.box, *v.alone);
    }
    if (v.shaft) {
        s += fmt::format("  elastic shaft: {}\n", shaft_words(*v.shaft));
    }
    for (const TripMargin &t : v.trips) {
        const std::string healthy =
            std::isnan(t.healthy) ? "no bound" : fmt::format("{:.3g}", t.healthy);
        s += fmt::format("  {}: {}, trip at {:.3g}\n", t.name, healthy, t.limit);
    }
    return s;
}

std::string servo_text(const Design &d)
{
    return d.servo->dobc ? dobc_text(*d.servo->dobc) : pid_text(d.drive.pid);
}

std::string cascade_text(const Design &d)
{
    const CascadeSpec &spec = d.drive.cascade;
    std::string        s =
        fmt::format("\ncontroller\n  current loops {:g} Hz, ", spec.current_bandwidth_Hz);
    return s + law_design(d.drive).report_rows(d.drive);
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
        s += fmt::format("  {:<16} order {:g}\n", report_channel_name(t.pair[i].channel),
                         static_cast<double>(t.pair[i].order));
    }
    s += "\ncertificate\n" + loop_text("controller", "e_iq", d.certificate.nosc);
    s += fmt::format(
        "  observer, law and motor: relative residuals <= {:.1e}, sampled spectral radius {:.5f} "
        "(at {:.0f} rad/s, iq {:.2f} A)\n",
        check.worst_residual, check.spectral_radius, check.worst_speed_e_radps, check.worst_iq_A);
    return s + loop_text("speed loop", check.speed_loop);
}

std::string observer_heading(NodoForm form, bool shaft)
{
    const bool encoder = form == NodoForm::encoder;
    return fmt::format("\nobserver (rows d_w, {}w, iq, id{}{}; columns measured {})\n",
                       form == NodoForm::conventional_load ? "" : "d_q, d_d, ",
                       encoder ? ", theta" : "", shaft ? ", w_load, twist" : "",
                       encoder ? "iq, id, theta" : "w, iq, id");
}

std::string both(const std::vector<const char *> &currents)
{
    return fmt::format("{}", fmt::join(currents, " and "));
}

std::string noc_text(const Design &d)
{
    const bool  shaft = law_design(d.drive).shaft_states;
    std::string s     = fmt::format("\ncontroller (rows v_q, v_d; columns e_w, e_iq, e_id{})\n",
                                shaft ? ", slip, twist" : "") +
                    gain_text("Lambda", d.nosc);
    s += "  poles" + poles_text(d.nosc.series.care.closed_loop_eigenvalues) + " 1/s\n";
    if (d.harmonics) {
        return s + harmonic_text(d);
    }
    s += observer_heading(d.drive.nodo.form, shaft) + gain_text("L", d.nodo);
    s += "  poles" + poles_text(d.nodo.series.care.closed_loop_eigenvalues) + " 1/s\n";
    const Scheduling &scheduling = law_design(d.drive).scheduling;
    return s + "\ncertificate\n" +
           loop_text("controller", both(scheduling.controller), d.certificate.nosc) +
           loop_text("observer", both(scheduling.observer), d.certificate.nodo);
}

} // namespace

std::string report_text(const Design &d, const std::optional<Prediction> &prediction)
{
    std::string s = fmt::format("{} ({}), control period {:g} us\n", d.drive.name,
                                drive_digest(d.drive), 1e6 * control_period_s(d.drive));
    s += pwm_note(d.drive.inverter) + cycles_note(d.drive);
    s += machine_text(d, prediction) + "\nreduced parameters\n";
    for (std::size_t i = 1; i <= 11; i++) {
        s += fmt::format("  l{:<3} {:.9g}\n", i, d.l[i]);
    }
    s += d.servo ? servo_text(d) : is_cascade(d.drive.law) ? cascade_text(d) : noc_text(d);
    s += d.torque ? torque_text(d) : "";
    s += verdict_text(d.certificate);
    if (d.drive.mechanics.coupling != Coupling::rigid &&
        !(d.certificate.loop && d.certificate.loop->shaft)) {
        s += fmt::format("  elastic shaft: not checked with law = \"{}\"\n", law_name(d.drive.law));
    }
    s += fmt::format("\nverdict: {}\n", verdict_words(d));
    for (const std::string &failure : d.certificate.failures) {
        s += "  " + failure + "\n";
    }
    return s;
}

} // namespace sdre
