// SPDX-License-Identifier: MIT
#include "firmware_config.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: five periods. Long against the limit cycle that a shorter one lets through with wrong
// parameters, short against the speed loop (docs/errata.md, d/dt of the current references).
constexpr double reference_filter_periods = 5.0;
// Chosen: half the nominal l1, reached at e_id = l1 / (2 |l11|).
constexpr double smallest_l1_ratio = 0.5;
// Chosen: room for regeneration and for a weak supply; the board's hardware limits stand behind it.
constexpr double dc_link_min_ratio = 0.3;
constexpr double dc_link_max_ratio = 1.35;
// Chosen: the flux-weakening range of the shipped motors ends below twice the rated speed.
constexpr double trip_speed_ratio   = 3.0;
constexpr double trip_current_ratio = 2.0;
// Chosen: a motor whose rated torque takes the whole current circle still accelerates with this share.
constexpr double smallest_torque_share = 0.25;

// Chosen: 5 % of the voltage circle stays free for transients.
constexpr double voltage_share = 0.95;

float single(double x)
{
    return static_cast<float>(x);
}

/// Entries that are zero in exact arithmetic come out of the solvers as rounding noise; they are stored as zero.
float gain_entry(const Eigen::MatrixXd &gain, Eigen::Index row, Eigen::Index column)
{
    const double x = gain(row, column);
    return (std::abs(x) < 1e-12 * gain.norm()) ? 0.0F : single(x);
}

double mtpa_gain_1pA(const ReducedParameters &l)
{
    return (l[10] - 1.0) / l[5]; // EQ-CURRENT-REF-1
}

/// The iq at which (iq, mtpa_gain iq^2) meets the current circle: iq^2 + k^2 iq^4 = max^2.
double largest_iq_A(const Motor &motor, double k)
{
    const double i2 = motor.max_current_A * motor.max_current_A;
    const double k2 = k * k;
    return std::sqrt(2.0 * i2 / (1.0 + std::sqrt(1.0 + 4.0 * k2 * i2)));
}

void copy_gains(const Design &d, drive_config_t &c)
{
    c.nosc.order          = static_cast<int16_t>(d.drive.nosc.order);
    c.nosc.iq_error_max_A = single(d.certificate.nosc.series_range_A);
    for (int n = 0; n <= d.drive.nosc.order; n++) {
        for (int row = 0; row < NOSC_N_U; row++) {
            for (int column = 0; column < NOSC_N_E; column++) {
                c.nosc.lambda[n][row][column] =
                    gain_entry(d.nosc.gain[static_cast<std::size_t>(n)], row, column);
            }
        }
    }
    c.nodo.order          = static_cast<int16_t>(d.drive.nodo.order);
    c.nodo.iq_max_A       = single(d.certificate.nodo.series_range_A);
    c.nodo.iq_certified_A = single(d.certificate.nodo.range_A);
    for (int n = 0; n <= d.drive.nodo.order; n++) {
        for (int row = 0; row < NODO_N_X; row++) {
            for (int column = 0; column < NODO_N_Y; column++) {
                c.nodo.gain[n][row][column] =
                    gain_entry(d.nodo.gain[static_cast<std::size_t>(n)], row, column);
            }
        }
    }
}

} // namespace

drive_config_t firmware_config(const Design &d)
{
    const Motor             &m             = d.drive.motor;
    const ReducedParameters &l             = d.l;
    const double             k             = mtpa_gain_1pA(l);
    const double             iq_max_A      = largest_iq_A(m, k);
    const double             torque_max_Nm = torque_Nm(m, k * iq_max_A * iq_max_A, iq_max_A);
    const double             torque_free_Nm =
        std::max(torque_max_Nm - m.rated_torque_Nm, smallest_torque_share * torque_max_Nm);
    const double ts = control_period_s(d.drive);

    drive_config_t c{};
    c.ts_s               = single(ts);
    c.accel_max_e_radps2 = single(l[3] * torque_free_Nm); // EQ-SPEED-REF-1
    c.trip_current_A     = single(trip_current_ratio * m.max_current_A);
    c.trip_speed_e_radps = single(trip_speed_ratio * m.rated_speed_e_radps);
    c.dc_link_min_V      = single(dc_link_min_ratio * d.drive.inverter.dc_link_V);
    c.dc_link_max_V      = single(dc_link_max_ratio * d.drive.inverter.dc_link_V);

    c.motor = {single(l[1]),  single(l[2]),       single(l[3]),      single(l[4]), single(l[5]),
               single(l[6]),  single(l[7]),       single(l[8]),      single(l[9]), single(l[10]),
               single(l[11]), single(1.0 / l[6]), single(1.0 / l[8])};

    c.current_ref.current_max_A     = single(m.max_current_A);
    c.current_ref.iq_max_A          = single(iq_max_A);
    c.current_ref.mtpa_gain_1pA     = single(k);
    c.current_ref.voltage_share     = single(voltage_share);
    c.current_ref.l1_min            = single(smallest_l1_ratio * l[1]);
    c.current_ref.filter_per_period = single(1.0 / reference_filter_periods);
    c.current_ref.filter_1ps        = single(1.0 / (reference_filter_periods * ts));
    copy_gains(d, c);
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
