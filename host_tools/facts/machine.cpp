// SPDX-License-Identifier: MIT
#include "facts/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/machine_points.hpp"
#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "drive/board_file.hpp"
#include "drive/pwm_frequency.hpp"
#include "facts/block_commutation.hpp"
#include "facts/encoder_facts.hpp"

namespace sdre {
namespace {

// Chosen: what two data sheets of one motor differ by.
constexpr double alike_within = 1.12;
// Chosen: a motor without a rated current is loaded with half of what it can.
constexpr double rated_share        = 0.5;
constexpr double default_pwm_Hz     = 10e3;
constexpr double default_dead_share = 0.015; ///< of a PWM period: 3 us at 5 kHz

/// Reads facts into values, keeping what does not fit together.
class Reader {
public:
    Reader(const Facts &facts, Findings &findings) : facts_(facts), findings_(findings) {}

    /// The first of several values of one quantity; a contradiction when they disagree.
    Value agreed(const char *what, const std::vector<Value> &values)
    {
        for (std::size_t i = 1; i < values.size(); i++) {
            const double ratio = values[i].si / values[0].si;
            if (!(std::max(ratio, 1.0 / ratio) <= alike_within)) {
                findings_.contradictions.push_back(fmt::format(
                    "{} and {} disagree: {} {:.4g} and {:.4g}{}", values[0].origin,
                    values[i].origin, what, values[0].si, values[i].si, usual_mistake(ratio)));
            }
        }
        return values[0];
    }
    Value plain(const char *quantity)
    {
        std::vector<Value> values;
        for (const Fact &f : facts_.of(quantity)) {
            values.push_back({f.si, f.text});
        }
        return values.empty() ? Value{} : agreed(quantity, values);
    }
    Value required(const char *quantity, const char *instead = "")
    {
        if (!facts_.has(quantity)) {
            throw InputError(fmt::format("{}: {}{} is missing", facts_.source, quantity, instead));
        }
        return plain(quantity);
    }
    Value or_chosen(const char *quantity, double si, const std::string &why)
    {
        return facts_.has(quantity) ? plain(quantity) : Value{si, "chosen: " + why};
    }
    void note(const std::string &text)
    {
        findings_.notes.push_back(text);
    }
    const Facts &facts() const
    {
        return facts_;
    }

private:
    const Facts &facts_;
    Findings    &findings_;
};

Value pole_pairs(Reader &r)
{
    std::vector<Value> values;
    for (const Fact &f : r.facts().of("poles")) {
        if (std::fmod(f.si, 2.0) != 0.0) {
            throw InputError(
                fmt::format("{}: {} is not allowed: must be even", r.facts().source, f.text));
        }
        values.push_back({0.5 * f.si, f.text});
    }
    for (const Fact &f : r.facts().of("pole_pairs")) {
        values.push_back({f.si, f.text});
    }
    if (values.empty()) {
        throw InputError(fmt::format("{}: poles or pole_pairs is missing", r.facts().source));
    }
    return r.agreed("pole pairs", values);
}

/// Per phase, of a winding in star.
Value per_phase(Reader &r, const char *quantity)
{
    std::vector<Value> values;
    for (const Fact &f : r.facts().of(quantity)) {
        const bool line = f.connection == Connection::line_to_line;
        if (f.connection == Connection::unsaid) {
            r.note(fmt::format("{}: taken as of one phase; write line_to_line_ if it is between "
                               "two terminals",
                               f.text));
        }
        values.push_back({line ? 0.5 * f.si : f.si, f.text});
    }
    return values.empty() ? Value{} : r.agreed(quantity, values);
}

/// Both axes; data sheets give them of a phase.
void inductances(Reader &r, Machine &m)
{
    const Value both = per_phase(r, "inductance");
    const auto  axis = [&](const char *name) {
        std::vector<Value> values;
        for (const Fact &f : r.facts().of(name)) {
            values.push_back(
                 {f.connection == Connection::line_to_line ? 0.5 * f.si : f.si, f.text});
        }
        return values.empty() ? both : r.agreed(name, values);
    };
    m.ld_H = axis("ld");
    m.lq_H = axis("lq");
    if (m.ld_H.si <= 0.0 || m.lq_H.si <= 0.0) {
        throw InputError(fmt::format("{}: an inductance is missing: Ld and Lq, phase_inductance or "
                                     "line_to_line_inductance",
                                     r.facts().source));
    }
    if (both.si > 0.0) {
        r.agreed("inductance", {both,
                                {std::clamp(both.si, std::min(m.ld_H.si, m.lq_H.si),
                                            std::max(m.ld_H.si, m.lq_H.si)),
                                 m.ld_H.origin + ", " + m.lq_H.origin}});
    }
}

/// A torque or EMF constant that does not say rms or peak: as the others say, else rms as data sheets have it.
Value unsaid_flux(Reader &r, Fact f, double pairs, const std::vector<Value> &others)
{
    if (f.quantity == "kt" && is_block_commutated(r.facts())) {
        r.note(fmt::format("{}: of block commutation, since kt x kv = 1: the same current as the "
                           "peak of a sine gives 1 / {:.4g} of the torque",
                           f.text, block_factor()));
        return {block_flux_Wb(f.si, pairs), f.text};
    }
    if (!others.empty()) {
        Fact peak      = f;
        peak.amplitude = Amplitude::peak;
        const auto off = [&](const Fact &x) {
            return std::abs(std::log(flux_of(x, pairs) / others[0].si));
        };
        if (off(peak) < off(f)) {
            r.note(fmt::format("{}: taken as peak, as {} says", f.text, others[0].origin));
            return {flux_of(peak, pairs), f.text};
        }
    }
    r.note(fmt::format(
        "{}: taken as rms{}, as data sheets give it; write _peak if it is not", f.text,
        f.quantity == "ke" && f.connection == Connection::unsaid ? " between two terminals" : ""));
    return {flux_of(f, pairs), f.text};
}

Value flux(Reader &r, double pairs)
{
    std::vector<Value> values;
    std::vector<Fact>  unsaid;
    for (const char *quantity : {"pm_flux", "ke", "kt", "kv"}) {
        for (const Fact &f : r.facts().of(quantity)) {
            const bool constant = f.quantity == "ke" || f.quantity == "kt";
            if (constant && f.amplitude == Amplitude::unsaid) {
                unsaid.push_back(f);
            } else {
                values.push_back({flux_of(f, pairs), f.text});
            }
        }
    }
    for (const Fact &f : unsaid) {
        values.push_back(unsaid_flux(r, f, pairs, values));
    }
    if (values.empty()) {
        throw InputError(
            fmt::format("{}: the magnet is missing: pm_flux, ke, kt or kv", r.facts().source));
    }
    return r.agreed("flux [Wb]", values);
}

Value current(Reader &r, const char *quantity)
{
    std::vector<Value> values;
    for (const Fact &f : r.facts().of(quantity)) {
        const bool unsaid = f.amplitude == Amplitude::unsaid;
        const bool block =
            unsaid && f.quantity == "rated_current" && is_block_commutated(r.facts());
        if (block) {
            r.note(fmt::format("{}: taken as dc current of block commutation: {:.4g} A peak of a "
                               "sine heat as much",
                               f.text, block_factor() * f.si));
        } else if (unsaid) {
            r.note(fmt::format("{}: taken as peak; write _rms if it is", f.text));
        }
        values.push_back({block ? block_factor() * f.si : peak_A(f), f.text});
    }
    return values.empty() ? Value{} : r.agreed(quantity, values);
}

Value speed(Reader &r, const char *quantity, double pairs)
{
    std::vector<Value> values;
    for (const Fact &f : r.facts().of(quantity)) {
        values.push_back({f.electrical ? f.si / pairs : f.si, f.text});
    }
    return values.empty() ? Value{} : r.agreed(quantity, values);
}

Value encoder_lines(Reader &r)
{
    std::vector<Value> values;
    for (const EncoderLines &e : encoder_lines_of(r.facts())) {
        values.push_back({e.lines, e.text});
    }
    return r.agreed("encoder lines", values);
}

Value inertia(Reader &r)
{
    Value v = r.required("inertia");
    for (const Fact &f : r.facts().of("load_inertia")) {
        v.si += f.si;
        v.origin += ", " + f.text;
    }
    return v;
}

/// The currents that a limit and a rating give; what is not given follows from the other.
void ratings(Reader &r, Machine &m)
{
    Value rated_A   = current(r, "rated_current");
    m.max_current_A = current(r, "max_current");
    if (is_block_commutated(r.facts()) && m.max_current_A.si > 0.0) {
        rated_A.si = std::min(rated_A.si, m.max_current_A.si);
    }
    if (m.max_current_A.si <= 0.0) {
        if (rated_A.si <= 0.0) {
            throw InputError(
                fmt::format("{}: max_current or rated_current is missing", r.facts().source));
        }
        m.max_current_A = {rated_A.si, rated_A.origin + ", no max_current given"};
    }
    m.rated_torque_Nm = r.plain("rated_torque");
    if (m.rated_torque_Nm.si <= 0.0) {
        m.rated_torque_Nm =
            rated_A.si > 0.0
                ? Value{mtpa_torque_Nm(m, rated_A.si), "derived: with " + rated_A.origin}
                : Value{rated_share * mtpa_torque_Nm(m, m.max_current_A.si),
                        "derived: half of what the largest current gives"};
    }
    m.rated_speed_radps = speed(r, "rated_speed", m.pole_pairs.si);
    m.max_speed_radps   = speed(r, "max_speed", m.pole_pairs.si);
}

/// The highest speed at which the dc link carries the rated torque, by bisection.
Value base_speed(const Machine &m)
{
    const double circle_V = m.dc_link_V.si / std::sqrt(3.0);
    double       lo       = 0.0;
    double       hi       = 1e5 / m.pole_pairs.si;
    for (int i = 0; i < 60; i++) {
        const double middle                                                      = 0.5 * (lo + hi);
        (needed_voltage_V(m, m.rated_torque_Nm.si, middle) < circle_V ? lo : hi) = middle;
    }
    const bool slow = m.max_speed_radps.si > 0.0 && m.max_speed_radps.si < lo;
    return slow ? Value{m.max_speed_radps.si, m.max_speed_radps.origin}
                : Value{lo, "derived: where the dc link still carries the rated torque"};
}

} // namespace

double flux_of(const Fact &f, double pairs)
{
    const bool   peak  = f.amplitude == Amplitude::peak;
    const bool   rms   = f.amplitude == Amplitude::rms;
    const bool   line  = f.connection == Connection::line_to_line;
    const bool   phase = f.connection == Connection::phase;
    const double root2 = std::sqrt(2.0);
    const double root3 = std::sqrt(3.0);
    if (f.quantity == "kt") { // torque per ampere of the phase current
        return f.si / (1.5 * pairs) / (peak ? 1.0 : root2);
    }
    if (f.quantity == "kv") { // of the line's peak, as hobby motors have it
        return 1.0 / f.si / pairs * (rms ? root2 : 1.0) / (phase ? 1.0 : root3);
    }
    if (f.quantity == "ke") { // of the line's rms
        return f.si / pairs * (peak ? 1.0 : root2) / (phase ? 1.0 : root3);
    }
    return f.si * (rms ? root2 : 1.0) / (line ? root3 : 1.0);
}

double peak_A(const Fact &f)
{
    return f.si * (f.amplitude == Amplitude::rms ? std::sqrt(2.0) : 1.0);
}

std::string usual_mistake(double ratio)
{
    struct Mistake {
        double      factor;
        const char *what;
    };
    constexpr std::array mistakes{Mistake{1.4142, "rms and peak"},
                                  Mistake{1.7321, "of a phase and line to line"},
                                  Mistake{2.0, "poles and pole pairs, or line to line and phase"},
                                  Mistake{2.4495, "rms of a phase and peak of a line"},
                                  Mistake{9.5493, "r/min and rad/s"},
                                  Mistake{1e3, "a prefix of the unit"},
                                  Mistake{1e4, "cm2 and m2"},
                                  Mistake{1e7, "gcm2 and kgm2"}};
    const double         up = std::max(ratio, 1.0 / ratio);
    for (const Mistake &m : mistakes) {
        if (std::abs(up / m.factor - 1.0) < 0.07) {
            return fmt::format(", a factor of {:.3g}: {}?", up, m.what);
        }
    }
    return fmt::format(", a factor of {:.3g}", up);
}

namespace {

Motor motor_of(const Machine &m)
{
    Motor motor;
    motor.pole_pairs            = static_cast<int>(m.pole_pairs.si);
    motor.stator_resistance_Ohm = m.resistance_Ohm.si;
    motor.d_axis_inductance_H   = m.ld_H.si;
    motor.q_axis_inductance_H   = m.lq_H.si;
    motor.pm_flux_Wb            = m.flux_Wb.si;
    motor.inertia_kgm2          = 1.0; // the torque has no use for it
    return motor;
}

/// Nothing: no board is named.
std::optional<BoardFile> board_of(const Facts &facts)
{
    if (facts.board.empty()) {
        return {};
    }
    const std::optional<BoardFile> board = named_board(facts.board, facts.drive_file);
    if (!board) {
        throw InputError(fmt::format("{}: board {}", facts.source, no_such_board(facts.board)));
    }
    return board;
}

/// Without a fact, the least of the board.
Value dead_time(Reader &r, const std::optional<BoardFile> &board, double pwm_Hz)
{
    if (!board) {
        return r.or_chosen("dead_time", default_dead_share / pwm_Hz,
                           "1.5 % of a PWM period, not given");
    }
    return r.or_chosen("dead_time", (*board)[BOARD_FACT_DEAD_TIME_MIN_s],
                       "least of the board, not given");
}

} // namespace

double mtpa_torque_Nm(const Machine &m, double current_A)
{
    Motor motor                  = motor_of(m);
    motor.max_current_A          = current_A;
    const ReducedParameters l    = reduced_parameters(motor);
    const double            iq_A = largest_iq_A(motor, l);
    return torque_Nm(motor, mtpa_id_A(l, iq_A), iq_A);
}

double needed_voltage_V(const Machine &m, double torque, double speed_radps)
{
    const Motor             motor = motor_of(m);
    const ReducedParameters l     = reduced_parameters(motor);
    const double            iq_A  = mtpa_iq_A(motor, l, torque, 10.0 * m.max_current_A.si);
    return steady_voltage_V(motor, mtpa_id_A(l, iq_A), iq_A, m.pole_pairs.si * speed_radps);
}

Machine machine_of(const Facts &facts, const std::string &default_name, Findings &findings)
{
    const std::optional<BoardFile> board = board_of(facts);
    const Processor               &p     = board ? *board->processor : default_processor();
    Reader                         r(facts, findings);
    Machine                        m;
    m.name           = facts.name.empty() ? default_name : facts.name;
    m.pole_pairs     = pole_pairs(r);
    m.resistance_Ohm = per_phase(r, "resistance");
    if (m.resistance_Ohm.si <= 0.0) {
        throw InputError(fmt::format("{}: phase_resistance or line_to_line_resistance is missing",
                                     facts.source));
    }
    inductances(r, m);
    m.flux_Wb            = flux(r, m.pole_pairs.si);
    m.inertia_kgm2       = inertia(r);
    m.friction_Nms       = r.or_chosen("viscous_friction", 0.0,
                                       "none is known; the bench of `sdre-sil serve` has some");
    m.dc_link_V          = r.required("dc_link");
    m.pwm_Hz             = r.or_chosen("pwm", default_pwm_Hz, "not given");
    m.pwm_wanted_Hz      = m.pwm_Hz.si;
    m.pwm_Hz.si          = counted_pwm_Hz(p, std::max(pwm_full_cnt(p, m.pwm_wanted_Hz), 1.0));
    m.updates_per_period = r.or_chosen("updates_per_period", 1.0, "one a PWM period");
    m.dead_time_s        = dead_time(r, board, m.pwm_Hz.si);
    m.lines              = encoder_lines(r);
    m.range_A            = r.plain("current_range");
    m.noise_A            = r.plain("current_noise");
    m.adc_bits           = r.plain("adc_bits");
    m.slots              = r.plain("slots");
    m.regeneration       = facts.regeneration;
    m.board              = facts.board;
    m.edge_times         = facts.edge_times;
    if (m.ld_H.si > m.lq_H.si && m.flux_Wb.si <= 0.0) {
        std::swap(m.ld_H, m.lq_H);
        findings.notes.push_back("Ld above Lq without a magnet: the axes are exchanged, here d is "
                                 "the one of the smaller inductance");
    }
    if (m.ld_H.si > m.lq_H.si) {
        throw InputError(fmt::format("{}: {} must not exceed {} (the magnet's axis is d)",
                                     facts.source, m.ld_H.origin, m.lq_H.origin));
    }
    ratings(r, m);
    if (m.rated_speed_radps.si <= 0.0) {
        m.rated_speed_radps = base_speed(m);
    }
    return m;
}

} // namespace sdre
