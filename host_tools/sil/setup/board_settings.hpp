// SPDX-License-Identifier: MIT
/// Settings between the control core and the motor: sensors, inverter, and the effects beyond the
/// plain motor model. The defaults are the shipped board.
#pragma once

#include <optional>
#include <vector>

#include "drive/flux_map.hpp"

namespace sdre {

/// In counts: a quarter of a line, 90 electrical degrees of it. Data sheets allow +-10 to +-45 degrees of state width,
/// +-10 to +-35 of pulse width and +-1 to +-5 of a line's length. Chosen: near the better end, an edge off by
/// 0.10 counts rms and 0.175 at most.
struct EncoderDiscSettings {
    double quadrature_error_cnt = 0.14; ///< of the width of a state: 12.6 degrees
    double duty_error_cnt       = 0.14; ///< of the width of a pulse: 12.6 degrees
    double jitter_rms_cnt       = 0.02; ///< of each edge: 1.8 degrees, 3.1 at most
    int    jitter_repeats       = 0;    ///< edges after which the jitter is the same; 0: a turn
    /// The drive has a map of the disc that is off by this at each edge; none: it has no map.
    std::optional<double> map_error_rms_cnt = std::nullopt;
};

struct SensorSettings {
    bool ideal = true; ///< exact signals; every other key of this table is then without effect
    std::optional<int> encoder_lines;             ///< the drive file's unless given
    bool               encoder_index     = true;  ///< lost counts come back once per turn
    bool               encoder_edge_time = false; ///< the drive file's unless given
    bool               encoder_dead      = false; ///< the counter stands where it is
    double encoder_eccentricity_rad      = 0.0;   ///< mechanical, amplitude of one sine per turn
    double encoder_offset_e_rad          = 0.0;   ///< alignment error, electrical
    double encoder_count_late_s =
        0.0; ///< the count is latched this long after the times of its edges
    EncoderDiscSettings encoder_disc;
    int                 adc_bits = 12; ///< this and the next two: the drive file's unless given
    double              adc_full_scale_A = 10.0;
    double              adc_noise_rms_A  = 0.010;
    double              adc_offset_a_A   = 0.0; ///< calibrated before the start
    double              adc_offset_b_A   = 0.0;
    double              adc_gain_a       = 1.0;
    double              adc_gain_b       = 1.0;
    int                 current_sensors = 2; ///< of the drive file; the application reads the third
    double              adc_offset_c_A  = 0.0;
    double              adc_gain_c      = 1.0;
    double sampling_advance_s = 0.0; ///< samples are taken this long before the period starts
};

enum class InverterModel { averaged, switched };
enum class Regeneration {
    blocks, ///< diode rectifier: energy that comes back charges the capacitor
    sinks   ///< the source takes it
};

struct InverterSettings {
    std::optional<double> dc_link_V; ///< Scenario::dc_link_V unless given
    InverterModel         model = InverterModel::averaged;
    std::optional<double>
                 dead_time_s; ///< none: the drive file's with real sensors, 0 with ideal ones
    double       switch_drop_V         = 0.0;
    double       diode_drop_V          = 0.0;
    double       duty_min              = 0.0;
    double       duty_max              = 1.0;
    double       source_resistance_Ohm = 0.0;                 ///< 0 = stiff
    double       capacitance_F         = 1e-3;                ///< chosen: 295 V then hold 44 J
    Regeneration regeneration          = Regeneration::sinks; ///< a laboratory supply with a load
    std::optional<double> chopper_on_V;                       ///< none: no brake chopper
    double                chopper_hysteresis_V = 5.0; ///< chosen: some 4 us of delay would be 0.1 V
    double                chopper_resistance_Ohm = 100.0; ///< chosen: 1.4 kW at 380 V
    bool                  chopper_of_board       = false; ///< the firmware switches it
    double                ripple_V               = 0.0;   ///< amplitude of a sine in the source
    double                ripple_Hz = 300.0; ///< of three phases of 50 Hz and six diodes
};

/// Inductances over the currents; flux = L(i_d, i_q) i + magnet.
struct SaturationMap {
    std::vector<double> id_A; ///< increasing
    std::vector<double> iq_A; ///< increasing
    std::vector<double> ld_H; ///< one row of iq values per i_d
    std::vector<double> lq_H;
};

struct MotorEffects {
    std::optional<SaturationMap>  saturation; ///< of a scenario
    std::optional<SaturatedMotor> flux;       ///< of the drive file, where the scenario has none
    double                        cogging_amplitude_Nm = 0.0;
    double                        cogging_order        = 0.0; ///< periods per mechanical turn
    double                        cogging_second_Nm    = 0.0; ///< amplitude at twice the order
    double                        cogging_second_rad   = 0.0; ///< phase of the second
    double                        coulomb_friction_Nm  = 0.0;
    double static_friction_Nm     = 0.0; ///< at rest; below the Coulomb friction: as that one
    double stribeck_speed_m_radps = 0.0; ///< at which 1/e of the difference is left
    double load_inertia_share     = 0.0; ///< of the motor's inertia: behind an elastic shaft
    double shaft_stiffness_Nmprad = 0.0;
    double shaft_damping_Nms      = 0.0;
    double flux_5th               = 0.0; ///< harmonics of a phase's magnet flux, shares of pm_flux
    double flux_7th               = 0.0;
    double iron_hysteresis_Nm     = 0.0; ///< drag at the magnet's flux
    double iron_eddy_Nms          = 0.0;
    double resistance_drift       = 0.0; ///< share of the start value per second
    double flux_drift             = 0.0;
};

} // namespace sdre
