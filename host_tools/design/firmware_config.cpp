// SPDX-License-Identifier: MIT
#include "design/firmware_config.hpp"

#include <algorithm>
#include <cmath>

#include "design/sampled_model.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre {
namespace {

// Chosen: eight periods. Long against the limit cycle that a shorter one lets through with wrong
// parameters, short against the speed loop (docs/errata.md, d/dt of the current references).
constexpr double reference_filter_periods = 8.0;
// Chosen: half the nominal l1, reached at e_id = l1 / (2 |l11|).
constexpr double smallest_l1_ratio = 0.5;
// Chosen: room for regeneration and for a weak supply; the board's hardware limits stand behind it.
constexpr double dc_link_min_ratio  = 0.3;
constexpr double dc_link_max_ratio  = 1.35;
constexpr double trip_current_ratio = 2.0;
// Chosen: twice the torque the motor has, so that a motor with half the believed inertia does not trip.
// Measured: a standing encoder is found above about 120 rad/s.
constexpr double trip_torque_ratio = 2.0;
// Chosen: an encoder wrong by this much turns a tenth of the torque into flux.
constexpr double trip_angle_rad = 0.45;
// Chosen: 2 % of the torque stays for the feedback while the reference accelerates.
constexpr double torque_share = 0.98;
// Chosen: regeneration is full up to 10 % above the nominal dc link and nothing at 25 %, below the trip.
constexpr double regen_start_ratio = 1.10;
constexpr double regen_end_ratio   = 1.25;
// Chosen: 2.5 % of the current limit, ten times the rms noise of the shipped board's sensors.
constexpr double dead_time_fade_ratio = 0.025;
// A surface magnet motor has no saliency; this many amperes stand for its infinite k of EQ-CURRENT-REF-2.
constexpr double largest_mtpa_A = 1e6;

// Chosen: 1 % of the voltage circle, and what the hexagon holds outside it, stay free for transients.
constexpr double voltage_share = 0.99;
// Chosen by simulation: of 10,000 random motors (docs/errata.md) 48 failed without this limit and 36 with it;
// a smaller share deepens the dip after a load step.
constexpr double speed_current_ratio = 0.25;

float single(double x)
{
    return static_cast<float>(x);
}

/// k of EQ-CURRENT-REF-2.
double mtpa_A(const ReducedParameters &l)
{
    return std::min(0.5 * l[5] / std::max(1.0 - l[10], 1e-9), largest_mtpa_A);
}

/// The iq at which the MTPA curve meets the current circle. Exact: id = k/2 - sqrt(k^2/4 + max^2/2); second order:
/// iq^2 + iq^4 / (2 k)^2 = max^2.
double largest_iq_A(const Motor &motor, double k, bool exact)
{
    const double i2 = motor.max_current_A * motor.max_current_A;
    if (exact) {
        const double id_A = -0.5 * i2 / (0.5 * k + std::sqrt(0.25 * k * k + 0.5 * i2));
        return std::sqrt(i2 - id_A * id_A);
    }
    return std::sqrt(2.0 * i2 / (1.0 + std::sqrt(1.0 + i2 / (k * k))));
}

/// On the MTPA curve at the current limit.
double largest_torque_Nm(const Motor &motor, const ReducedParameters &l)
{
    const double iq_A = largest_iq_A(motor, mtpa_A(l), true);
    return torque_Nm(motor, mtpa_id_A(l, iq_A), iq_A);
}

/// The speed error whose feedback asks for the current to go from one limit to the other.
double near_e_radps(const Design &d)
{
    const Eigen::MatrixXd &Lambda = d.nosc.gain[0];
    const double           full =
        2.0 * d.drive.motor.max_current_A * Lambda(0, 1) / std::max(Lambda(0, 0), 1e-9);
    return std::min(full, trip_speed_ratio * d.drive.motor.rated_speed_e_radps);
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

/// The conventional law's tables; an observer of the load alone gets zero rows for d_q and d_d.
void copy_conventional(const Design &d, conventional_gains_t &g)
{
    const bool load = d.drive.nodo.form == NodoForm::conventional_load;
    g.nosc_order    = static_cast<int16_t>(d.drive.nosc.order);
    g.nodo_order    = static_cast<int16_t>(d.drive.nodo.order);
    g.i_error_max_A = single(d.certificate.nosc.series_range_A);
    g.i_max_A       = single(d.certificate.nodo.series_range_A);
    g.i_certified_A = single(d.certificate.nodo.range_A);
    copy_terms(d.nosc, {0, 1}, NOSC_N_U, g.lambda);
    copy_terms(d.nodo, load ? std::vector<int>{0, 3, 4, 5} : std::vector<int>{0, 1, 2, 3, 4, 5},
               NODO_N_X, g.gain);
}

template <std::size_t Rows, std::size_t Columns>
void copy_matrix(const Eigen::MatrixXd &from, float (&to)[Rows][Columns])
{
    for (std::size_t row = 0; row < Rows; row++) {
        for (std::size_t column = 0; column < Columns; column++) {
            to[row][column] =
                gain_entry(from, static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        }
    }
}

void copy_gains(const Design &d, drive_config_t &c)
{
    const auto  nodo_order = static_cast<int16_t>(d.drive.nodo.order);
    const float nodo_iq_A  = single(d.certificate.nodo.series_range_A);

    const bool conventional = d.drive.law == Law::conventional_noc;

    c.nosc.order          = static_cast<int16_t>(conventional ? 0 : d.drive.nosc.order);
    c.nosc.iq_error_max_A = single(d.certificate.nosc.series_range_A);
    c.nosc.iq_speed_max_A = single(speed_current_ratio * d.drive.motor.max_current_A);
    if (conventional) { // EQ-NOSC-3 needs Lambda_00
        copy_matrix(d.nosc.gain[0], c.nosc.lambda[0]);
        copy_conventional(d, c.conventional);
        return;
    }
    for (std::size_t n = 0; n < d.nosc.gain.size(); n++) {
        copy_matrix(d.nosc.gain[n], c.nosc.lambda[n]);
    }
    if (d.harmonics) {
        c.form          = DRIVE_FORM_ENCODER;
        c.nodo_harmonic = d.harmonics->table.get();
    } else if (d.drive.nodo.form == NodoForm::encoder) {
        c.form                  = DRIVE_FORM_ENCODER;
        c.nodo_encoder.order    = nodo_order;
        c.nodo_encoder.iq_max_A = nodo_iq_A;
        for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
            copy_matrix(d.nodo.gain[n], c.nodo_encoder.gain[n]);
        }
    } else {
        c.form                = DRIVE_FORM_SPEED;
        c.nodo.order          = nodo_order;
        c.nodo.iq_max_A       = nodo_iq_A;
        c.nodo.iq_certified_A = single(d.certificate.nodo.range_A);
        for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
            copy_matrix(d.nodo.gain[n], c.nodo.gain[n]);
        }
    }
}

current_ref_config_t current_ref_config(const Design &d)
{
    const Motor &m      = d.drive.motor;
    const double ts     = control_period_s(d.drive);
    const double np     = m.pole_pairs;
    const double v_dc   = d.drive.inverter.dc_link_V;
    const double k      = mtpa_A(d.l);
    const double full_W = 1.5 * v_dc / std::sqrt(3.0) * m.max_current_A;

    // The paper's own form keeps the paper's second-order MTPA.
    const bool exact = d.drive.nodo.form == NodoForm::encoder;

    current_ref_config_t c{};
    c.current_max_A     = single(m.max_current_A);
    c.iq_max_A          = single(largest_iq_A(m, k, exact));
    c.mtpa_A            = single(k);
    c.mtpa_exact        = exact;
    c.voltage_share     = single(voltage_share);
    c.torque_share      = single(torque_share);
    c.near_e_radps      = single(near_e_radps(d));
    c.l1_min            = single(smallest_l1_ratio * d.l[1]);
    c.filter_per_period = single(1.0 / reference_filter_periods);
    c.filter_1ps        = single(1.0 / (reference_filter_periods * ts));
    c.regen_max_W_norm  = single(np * np / m.inertia_kgm2 * full_W); // EQ-CURRENT-REF-7
    c.regen_start_V     = single(regen_start_ratio * v_dc);
    c.regen_per_V       = single(1.0 / ((regen_end_ratio - regen_start_ratio) * v_dc));
    return c;
}

dobc_config_t dobc_config(const Motor &m, const DobcDesign &d)
{
    const ServoPlant p = servo_plant(m);
    const double np = m.pole_pairs; // the design's speeds are mechanical, the firmware's electrical
    dobc_config_t c{};
    c.n_x        = static_cast<int16_t>(d.l.size());
    c.direct_Vs  = single(m.viscous_friction_Nms * m.stator_resistance_Ohm / (p.kt_NmpA * np) +
                          m.pm_flux_Wb); // EQ-DOBC-1
    c.ld_H       = single(m.d_axis_inductance_H);
    c.k_omega_Vs = single(d.k1 / np);
    for (Eigen::Index i = 0; i < d.l.size(); i++) {
        c.k_x[i] = single(d.K(i));
        c.g[i]   = single(d.g(i) / np);
        c.h[i]   = single(d.h(i));
        for (Eigen::Index j = 0; j < d.l.size(); j++) {
            c.m[i][j] = single(d.M(i, j));
        }
    }
    return c;
}

servo_law_config_t servo_config(const Design &d)
{
    const double       ts = control_period_s(d.drive);
    const double       np = d.drive.motor.pole_pairs;
    const PidSpec     &k  = d.drive.pid;
    servo_law_config_t c{};
    c.kind  = d.drive.law == Law::pid ? SERVO_LAW_PID : SERVO_LAW_DOBC;
    c.id_pi = {single(d.drive.d_axis.proportional_V_per_A),
               single(d.drive.d_axis.integral_V_per_As * ts), 0.0F};
    if (c.kind == SERVO_LAW_PID) {
        c.pid = {single(k.proportional_Vs_per_rad / np), single(k.integral_V_per_rad * ts / np),
                 single(k.derivative_Vs2_per_rad / (ts * np))};
    } else {
        c.dobc = dobc_config(d.drive.motor, *d.servo->dobc);
    }
    return c;
}

drive_law_t firmware_law(Law law)
{
    switch (law) {
    case Law::noc:
        return DRIVE_LAW_NOC;
    case Law::noc_h:
        return DRIVE_LAW_NOC_H;
    case Law::conventional_noc:
        return DRIVE_LAW_CONVENTIONAL;
    default:
        return DRIVE_LAW_SERVO;
    }
}

} // namespace

drive_config_t firmware_config(const Design &d)
{
    const Motor             &m   = d.drive.motor;
    const Inverter          &inv = d.drive.inverter;
    const ReducedParameters &l   = d.l;

    drive_config_t c{};
    c.ts_s               = single(control_period_s(d.drive));
    c.trip_current_A     = single(trip_current_ratio * m.max_current_A);
    c.trip_speed_e_radps = single(trip_speed_ratio * m.rated_speed_e_radps);
    c.trip_angle_rad     = single(trip_angle_rad);
    c.trip_d_omega       = single(trip_torque_ratio * l[3] * largest_torque_Nm(m, l));
    c.dc_link_min_V      = single(dc_link_min_ratio * inv.dc_link_V);
    c.dc_link_max_V      = single(dc_link_max_ratio * inv.dc_link_V);
    c.overmodulation     = inv.overmodulation;

    c.motor = {single(l[1]),  single(l[2]),       single(l[3]),      single(l[4]), single(l[5]),
               single(l[6]),  single(l[7]),       single(l[8]),      single(l[9]), single(l[10]),
               single(l[11]), single(1.0 / l[6]), single(1.0 / l[8])};

    c.dead_time.share =
        single(inv.dead_time_compensation ? inv.dead_time_s * inv.pwm_frequency_Hz : 0.0);
    c.dead_time.inv_fade_1pA = single(1.0 / (dead_time_fade_ratio * m.max_current_A));
    if (d.servo) {
        c.law = firmware_law(d.drive.law);
        c.current_ref.current_max_A =
            single(m.max_current_A); // the application's alignment uses it
        c.servo = servo_config(d);
    } else {
        c.law         = firmware_law(d.drive.law);
        c.current_ref = current_ref_config(d);
        copy_gains(d, c);
    }
    return c;
}

void add_firmware_failures(const drive_config_t &config, Certificate &certificate)
{
    if (drive_config_check(&config) != CTL_OK) {
        certificate.failures.emplace_back(
            "a constant is not finite in single precision or outside the firmware's range");
    }
}

} // namespace sdre
