// SPDX-License-Identifier: MIT
/// The drive description: the only place where a motor number is written.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "drive/board_section.hpp"
#include "drive/flux_map.hpp"
#include "drive/mechanics.hpp"
#include "drive/uncertainty.hpp"

namespace sdre {

/// Fitted on a map of the iron, for EQ-CURRENT-REF-2; without one the inductances say it.
struct MtpaCurve {
    double k_A        = 0.0;   ///< 0: of the inductances
    bool second_order = false; ///< id = -iq^2 / (2 k), else the exact curve of constant inductances
};

/// SI units; the unit is part of the TOML key. Peak (amplitude-invariant) currents and flux.
struct Motor {
    int       pole_pairs            = 0;
    double    stator_resistance_Ohm = 0.0;
    double    d_axis_inductance_H   = 0.0;
    double    q_axis_inductance_H   = 0.0;
    double    pm_flux_Wb            = 0.0;
    double    inertia_kgm2          = 0.0;
    double    viscous_friction_Nms  = 0.0; ///< acts on the mechanical speed
    double    rated_speed_e_radps   = 0.0; ///< electrical
    double    rated_torque_Nm       = 0.0;
    double    max_current_A         = 0.0; ///< peak of the phase current
    double    max_speed_e_radps     = 0.0; ///< largest command, electrical; 0 when not given
    int       slots = 0; ///< stator slots, periods of cogging per turn; 0 when not given
    MtpaCurve mtpa;
};

/// Sink for the energy that a braking motor drives into the dc link, or its EMF with an open
/// bridge.
enum class DcLinkSink {
    none,          ///< nothing: the capacitor charges
    brake_chopper, ///< a resistor that is switched on by the link's voltage
    supply         ///< the supply, down to zero speed
};

struct Inverter {
    double     dc_link_V          = 0.0;
    double     pwm_frequency_Hz   = 0.0; ///< that the counter has, and everything is designed for
    double     pwm_wanted_Hz      = 0.0; ///< that the drive file says
    double     dead_time_s        = 0.0;
    int        updates_per_period = 1; ///< control runs at pwm_frequency_Hz times this
    bool       dead_time_compensation = true;
    bool       overmodulation         = false; ///< transient voltages may use the hexagon's corners
    DcLinkSink regeneration           = DcLinkSink::none;
};

/// Where the edges of the encoder's disc are off, in counts (EQ-ENCODER-7). The defaults are near the
/// better end of data sheets. The design takes own_rms_cnt, the simulated board all of them.
struct DiscErrors {
    double pattern_cnt =
        0.14; ///< of quadrature and duty, the same in each line: the drive learns it
    double own_rms_cnt = 0.02; ///< of each edge alone
    double turn_cnt    = 0.0;  ///< amplitude of one sine per turn: a disc that is not centred
};

struct Encoder {
    int    lines      = 0;
    bool   edge_times = false; ///< angle and speed from the times of the edges; else from counts
    double index_angle_e_rad = 0.0; ///< electrical angle at the index mark; 0: it marks the d axis
    DiscErrors disc;
};

/// Measurement of the phase currents. The defaults follow the motor: a range that shows a trip at
/// twice the limit.
struct CurrentSensors {
    double range_A     = 0.0; ///< full scale of the converter, either way
    double noise_rms_A = 0.0;
    int    adc_bits    = 12;
    int    count       = 2; ///< 2: phases a and b; 3: c too
};

/// Weights of the speed controller: speed, i_q, i_d error; v_q, v_d.
struct NoscSpec {
    int                   order = 0;
    std::array<double, 3> Q{};
    std::array<double, 2> T{};
};

/// Weights of the position controller: angle, speed, i_q, i_d error; v_q, v_d. Its series has the order of the speed's.
struct PositionSpec {
    std::array<double, 4> Q{};
    std::array<double, 2> T{};
};

/// Weights of the current controller of a torque run: i_q, i_d error; v_q, v_d.
struct TorqueWeights {
    std::array<double, 2> Q{};
    std::array<double, 2> T{};
};

struct TorqueSpec {
    std::optional<TorqueWeights> weights; ///< without them they follow the control period
};

/// Measurement of paper A's observer beside the currents: speed or encoder angle. The conventional
/// observer measures the speed; its two forms estimate the load alone or all three disturbances.
enum class NodoForm { speed, encoder, conventional_load, conventional_all };

const char *nodo_form_name(NodoForm form);

/// Weights of the observer. Speed form: states d_w, d_q, d_d, w, i_q, i_d; measured w, i_q, i_d.
/// Encoder form: the angle theta is a seventh state; measured i_q, i_d, theta. Load alone: d_w, w, i_q, i_d.
struct NodoSpec {
    NodoForm              form  = NodoForm::speed;
    int                   order = 0;
    std::vector<double>   Q;
    std::array<double, 3> T{};
};

/// The control law: paper A's and its variants for harmonics, an elastic shaft or saturated iron, its rival, one of
/// paper B's, or a cascade.
enum class Law {
    noc,
    noc_h,
    noc_shaft,
    noc_iron,
    conventional_noc,
    cdobc,
    gpiobc,
    hdobc,
    pid,
    pi_foc,
    ladrc
};

/// The laws with a controller and an observer from a state-dependent Riccati equation.
bool is_near_optimal(Law law);
/// The laws with which a drive file may have [position].
bool takes_positions(Law law);
/// The laws with a speed loop around current loops.
bool is_cascade(Law law);

const char *law_name(Law law);
bool        is_law_name(const std::string &name);

/// How paper B's observer places its poles and how it compensates.
enum class DobcPreset {
    printed, ///< all poles on one point, oscillators compensated without lead
    repaired ///< oscillators keep their frequency and get a light damping; half a sample of lead
};

/// cdobc, gpiobc (no harmonics, so no preset either), hdobc (no polynomial).
struct DobcSpec {
    DobcPreset          preset           = DobcPreset::repaired;
    int                 polynomial_order = 0;         ///< N
    std::vector<double> harmonics_per_turn;           ///< of the shaft, rising
    double              design_speed_e_radps   = 0.0; ///< the harmonics' frequencies hold here
    double              controller_pole_1ps    = 0.0; ///< distance from 0 of both poles
    double              observer_pole_1ps      = 0.0; ///< the same of the observer's fast poles
    double              oscillator_damping_1ps = 0.0; ///< repaired: half of s^2 + 2 damping s + w^2
};

/// Gains as paper B gives them: q voltage per mechanical speed error.
struct PidSpec {
    double proportional_Vs_per_rad = 0.0;
    double integral_V_per_rad      = 0.0;
    double derivative_Vs2_per_rad  = 0.0;
};

/// The PI that keeps i_d at zero, for every law of paper B.
struct DAxisSpec {
    double proportional_V_per_A = 0.0;
    double integral_V_per_As    = 0.0;
};

/// A speed law around current loops.
struct CascadeSpec {
    double current_bandwidth_Hz = 0.0; ///< of the current loops
    double symmetrical_optimum_a =
        0.0; ///< pi_foc: ratio of the speed loop's crossover to its corners
    double controller_radps    = 0.0; ///< ladrc: pole of the speed loop, distance from 0
    double observer_radps      = 0.0; ///< ladrc: the same of both poles of the observer
    double load_observer_radps = 0.0; ///< pi_foc: both poles of a load observer; 0: none
};

/// Model of repeating disturbances in noc_h's observer; weights are those of the observer's Q.
struct HarmonicSpec {
    std::vector<double>
        sensor; ///< electrical orders of current-sensor errors: 1 offset, 2 unequal gains
    std::vector<double> voltage; ///< electrical orders in d_q and d_d: 6 dead time
    std::vector<double> cogging; ///< multiples of the motor's slots
    double              sensor_weight  = 0.0;
    double              voltage_weight = 0.0;
    double              cogging_weight = 0.0;
    double              cogging_voltage_weight =
        0.0; ///< of the q voltage that the dead time makes of the cogging's current; 0: none
    double slope_weight = 0.0; ///< of d_w'; 0 leaves the state out
    double weight_speed_e_radps =
        0.0; ///< the pairs' weights hold from here on, below they fall with its square
    double leak_1ps = 0.0; ///< decay of every pair
};

/// Weights of noc_shaft's load, beside those of [nosc] and [nodo].
struct ShaftSpec {
    std::array<double, 2> Q{};      ///< controller: speed of the load, twist
    std::array<double, 2> nodo_Q{}; ///< observer: the same states
};

struct Drive {
    std::string name;
    std::string reproduces; ///< whose design it repeats as printed; empty: it is our own
    Motor       motor;      ///< what the control believes
    std::shared_ptr<const FluxMap> saturation; ///< what its iron is; none: as the inductances say
    Inverter                       inverter;
    Encoder                        encoder;
    CurrentSensors                 current_sensors;
    BoardDescription               board;
    Law                            law = Law::noc;
    NoscSpec                       nosc; ///< nosc and nodo: laws of near optimal control
    NodoSpec                       nodo;
    std::optional<PositionSpec>
        position; ///< noc with form "encoder", noc_h: the drive takes positions too
    std::optional<TorqueSpec> torque;    ///< noc with form "encoder": the drive takes torques too
    HarmonicSpec              harmonics; ///< noc_h only
    ShaftSpec                 shaft;     ///< noc_shaft only
    DobcSpec                  dobc;      ///< cdobc, gpiobc, hdobc only
    PidSpec                   pid;       ///< pid only
    DAxisSpec                 d_axis;    ///< laws of paper B
    CascadeSpec               cascade;   ///< pi_foc and ladrc only
    Uncertainty               uncertainty;
    Mechanics                 mechanics;
};

/// Whether a drive may have [torque]: law noc that observes the angle.
bool takes_torque(const Drive &drive);

constexpr int drive_schema = 1;

/// InputError in one line on anything missing, unknown, not finite or out of range.
Drive read_drive_file(const std::filesystem::path &file);
/// The same of a text; `source` names it in messages. Boards are looked for beside `file`, or beside `source`.
Drive read_drive_text(const std::string &text, const std::string &source,
                      const std::string &file = "");

/// Values of a drive file without [current_sensors].
CurrentSensors default_current_sensors(const Motor &motor);

/// Factors between the values of two motors; of the magnet 1 where the first has none.
FluxScale flux_scale(const Motor &from, const Motor &to);
/// The machine of a drive file with [saturation], with values of [motor] scaled as in `now`.
SaturatedMotor saturated_motor(const Drive &drive, const Motor &now);

/// "none", "brake_chopper", "supply".
const char *dc_link_sink_name(DcLinkSink sink);

/// Control period: 1 / (pwm_frequency_Hz * updates_per_period).
double control_period_s(const Drive &drive);
/// From one edge of the encoder to the next, electrical [rad].
double count_e_rad(const Drive &drive);
/// Speed at which the drive opens its bridge: above the largest command when the file has one, else
/// three times the rated speed. Certificates reach up to it.
double trip_speed_e_radps(const Drive &drive);
/// Edges of both tracks in a second at that speed.
double encoder_edges_Hz(const Drive &drive);

/// "fnv1a64:<16 hex digits>" of every value of the drive; independent of layout and comments.
std::string drive_digest(const Drive &drive);

/// The motor's keys and values, for tools that scale or list them. Throws InputError for an unknown key.
double &motor_value(Motor &motor, const std::string &key);

} // namespace sdre
