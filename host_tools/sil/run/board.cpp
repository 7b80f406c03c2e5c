// SPDX-License-Identifier: MIT
#include "sil/run/board.hpp"

#include <algorithm>
#include <cmath>

#include "sil/plant/inverter.hpp"

namespace sdre {
namespace {

// Measured: 4 RK4 steps of 50 us reproduce the reference trajectories to 3e-10 of the speed range.
constexpr int substeps_per_period = 4;

// A change and a tick that mean the same instant.
constexpr double time_tolerance_s = 1e-12;

BridgeTiming timing_of(const Scenario &s)
{
    return {control_period_s(s.drive), s.drive.inverter.pwm_frequency_Hz,
            s.drive.motor.d_axis_inductance_H, s.drive.inverter.updates_per_period == 2};
}

double dead_time_of(const SensorSettings &sensors, const InverterSettings &inverter,
                    const Drive &drive)
{
    return inverter.dead_time_s.value_or(sensors.ideal ? 0.0 : drive.inverter.dead_time_s);
}

/// The scenario's own inductances stand in for the drive file's map.
std::optional<SaturatedMotor> iron_of(const Scenario &s)
{
    if (s.motor_effects.saturation || (!s.motor_effects.flux && !s.drive.saturation)) {
        return {};
    }
    return s.motor_effects.flux ? *s.motor_effects.flux : saturated_motor(s.drive, s.drive.motor);
}

/// A board with a chopper has it in every simulation.
InverterSettings with_chopper_of_board(InverterSettings i, const Drive &drive)
{
    if (has_chopper(drive)) {
        const BoardFile &b       = *drive.board.file;
        i.chopper_of_board       = true;
        i.chopper_on_V           = b[BOARD_FACT_CHOPPER_ON_V];
        i.chopper_hysteresis_V   = b[BOARD_FACT_CHOPPER_ON_V] - b[BOARD_FACT_CHOPPER_OFF_V];
        i.chopper_resistance_Ohm = b[BOARD_FACT_CHOPPER_RESISTANCE_Ohm];
    }
    return i;
}

bool has_drift(const MotorEffects &e)
{
    return e.resistance_drift != 0.0 || e.flux_drift != 0.0;
}

} // namespace

Board::Board(const Scenario &s)
    : scenario_(s), period_s_(control_period_s(s.drive)),
      motor_(scaled(s.drive.motor, s.plant_scale)), scale_(s.plant_scale), iron_(iron_of(s)),
      sensors_(s.sensors), inverter_(s.inverter), source_V_(s.dc_link_V), plant_(motor_),
      bridge_(timing_of(s), s.inverter, dead_time_of(s.sensors, s.inverter, s.drive)),
      dc_link_(s.inverter, s.dc_link_V),
      encoder_(s.sensors, s.drive.encoder.lines, s.drive.motor.pole_pairs, period_s_, s.seed),
      channel_a_(channel_a(s.sensors)), channel_b_(channel_b(s.sensors)),
      channel_c_(channel_c(s.sensors)), noise_a_(s.seed, NoiseStream::adc_a),
      noise_b_(s.seed, NoiseStream::adc_b), noise_c_(s.seed, NoiseStream::adc_c),
      load_(s.load_torque, s.load_ramps, s.load_sine), brake_(s.load_brake),
      first_dead_time_s_(dead_time_of(s.sensors, s.inverter, s.drive)), faults_(s.faults)
{
    plant_.reset(s.initial_speed_e_radps, start_theta_e_rad(s));
    shaft_load_.fan_Nm_per_radps2 = s.load_fan_Nm_per_radps2;
    plain_motor_ = !any_effect(s.motor_effects) && !iron_ && s.load_fan_Nm_per_radps2 == 0.0 &&
                   !brake_.present();
    if (any_effect(s.motor_effects) || iron_) {
        update_motor();
    }
    configure_inverter();
    plant_.path().lead_to(plant_.theta_e_rad(), s.initial_speed_e_radps, period_s_);
    encoder_.start(plant_.theta_e_rad(), s.initial_speed_e_radps);
}

void Board::configure_inverter()
{
    const InverterSettings i         = with_chopper_of_board(inverter_, scenario_.drive);
    const double           dead_time = dead_time_of(sensors_, i, scenario_.drive);
    bridge_.configure(i, dead_time);
    dc_link_.configure(i, source_V_);
    plain_inverter_ = i.model == InverterModel::averaged && dead_time <= 0.0 &&
                      i.switch_drop_V <= 0.0 && i.diode_drop_V <= 0.0 && i.duty_min <= 0.0 &&
                      i.duty_max >= 1.0 && dc_link_.stiff();
}

/// The motor with its scale and the drift up to now.
void Board::update_motor()
{
    MotorEffects effects = scenario_.motor_effects;
    Motor        now     = motor_;
    now.stator_resistance_Ohm =
        drifted(now.stator_resistance_Ohm, effects.resistance_drift, time_s_);
    now.pm_flux_Wb        = drifted(now.pm_flux_Wb, effects.flux_drift, time_s_);
    const FluxScale scale = flux_scale(scenario_.drive.motor, now);
    if (effects.saturation) {
        effects.saturation = scaled(*effects.saturation, scale.ld, scale.lq);
    } else if (iron_) {
        effects.flux   = iron_->scaled(scale);
        now.pm_flux_Wb = effects.flux->magnet_Wb();
    }
    plant_.set_motor(now);
    if (any_effect(effects)) {
        plant_.set_effects(effects);
    }
}

void Board::apply(const PlantChange &change)
{
    if (change.sensors) {
        sensors_   = *change.sensors;
        channel_a_ = channel_a(sensors_);
        channel_b_ = channel_b(sensors_);
        channel_c_ = channel_c(sensors_);
        encoder_.configure(sensors_);
    }
    encoder_.lose(change.lost_counts);
    if (change.inverter) {
        inverter_ = *change.inverter;
        source_V_ = inverter_.dc_link_V.value_or(scenario_.dc_link_V);
    }
    if (change.sensors || change.inverter) {
        configure_inverter();
    }
    if (change.load_sine) {
        load_.set_sine(*change.load_sine);
    }
    if (change.changes_plant) {
        motor_ = scaled(scenario_.drive.motor, change.plant_scale);
        update_motor();
    }
}

void Board::begin_tick(double time_s)
{
    time_s_ = time_s;
    for (; next_change_ < scenario_.changes.size() &&
           scenario_.changes[next_change_].time_s <= time_s + time_tolerance_s;
         next_change_++) {
        apply(scenario_.changes[next_change_]);
    }
    if (has_drift(scenario_.motor_effects)) {
        update_motor();
    }
    shaft_load_.torque_Nm = load_.at(time_s, 0.5 * period_s_) + extra_load_Nm_;
    shaft_load_.brake_Nm  = extra_brake_Nm_ + holding_brake_.torque_Nm(time_s);
    if (brake_.present()) {
        shaft_load_.brake_Nm += brake_.at(time_s, 0.5 * period_s_);
    }
    glitch_ = glitch_at(scenario_.glitches, time_s, period_s_);
    begin_faults();
}

void Board::set_source_V(double voltage_V)
{
    source_V_ = voltage_V;
    configure_inverter();
}

void Board::mend()
{
    faults_.mend();
    lost_counts_ = 0;
    bridge_.mend();
}

void Board::begin_faults()
{
    faults_.begin_tick(time_s_);
    for (std::size_t x = 0; x < 3; x++) {
        if (faults_.active(FaultKind::phase_open, x) != nullptr) {
            bridge_.break_phase(x);
        }
    }
    const int lost = faults_.lost_counts();
    encoder_.lose(lost - lost_counts_);
    lost_counts_ = lost;
}

PlantState Board::plant_state() const
{
    const double omega_m  = plant_.omega_load_m_radps();
    const double fan_Nm   = shaft_load_.fan_Nm_per_radps2 * omega_m * std::abs(omega_m);
    const double brake_Nm = omega_m == 0.0 ? 0.0 : std::copysign(shaft_load_.brake_Nm, omega_m);
    return {plant_.omega_e_radps(), plant_.current_A(),
            plant_.torque_Nm(),     shaft_load_.torque_Nm + fan_Nm + brake_Nm,
            dc_link_.voltage_V(),   plant_.theta_e_rad()};
}

bool Board::runaway() const
{
    return !(std::abs(plant_.omega_e_radps()) * period_s_ < std::acos(-1.0));
}

drive_sample_t Board::ideal_sample() const
{
    const StatorVector i = to_stator(plant_.current_A(), plant_.theta_e_rad());
    drive_sample_t     s{};
    s.ia_A        = static_cast<float>(i.alpha);
    s.ib_A        = static_cast<float>(-0.5 * i.alpha + 0.5 * std::sqrt(3.0) * i.beta);
    s.dc_link_V   = static_cast<float>(dc_link_.voltage_V());
    s.theta_e_rad = static_cast<float>(std::remainder(plant_.theta_e_rad(), 2.0 * std::acos(-1.0)));
    s.omega_e_radps = static_cast<float>(plant_.omega_e_radps());
    s.valid         = true;
    return s;
}

drive_sample_t Board::measured_sample()
{
    encoder_.misread(glitch_.encoder_cnt);
    const QuadratureEncoder::Reading position = encoder_.read(plant_.path());
    plant_.path().restart();
    if (sensors_.ideal) {
        return ideal_sample();
    }
    const PhaseVector i = plant_.phase_current_A();
    drive_sample_t    s{};
    const double      ia_A = faults_.sensed_A(0, i.a) + glitch_.ia_A;
    const double      ib_A = faults_.sensed_A(1, i.b) + glitch_.ib_A;
    s.ia_A = static_cast<float>(adc_current_A(channel_a_, adc_code(channel_a_, ia_A, noise_a_)));
    s.ib_A = static_cast<float>(adc_current_A(channel_b_, adc_code(channel_b_, ib_A, noise_b_)));
    s.dc_link_V       = static_cast<float>(dc_link_.voltage_V());
    s.theta_e_rad     = static_cast<float>(position.theta_e_rad);
    s.band_rad        = static_cast<float>(position.band_e_rad);
    s.edge_gap_s      = static_cast<float>(position.edge_gap_s);
    s.edge_age_s      = static_cast<float>(position.edge_age_s);
    s.edge_of_pattern = static_cast<std::int16_t>(position.edge_of_pattern);
    s.omega_e_radps   = static_cast<float>(position.omega_e_radps);
    s.valid           = true;
    return s;
}

drive_sample_t Board::sample()
{
    if (have_early_) {
        have_early_ = false;
        return early_sample_;
    }
    return measured_sample();
}

RawSample Board::raw_sample()
{
    encoder_.misread(glitch_.encoder_cnt);
    const QuadratureEncoder::Reading position = encoder_.read(plant_.path(), edges_);
    plant_.path().restart();
    const PhaseVector i = plant_.phase_current_A();
    RawSample         s;
    s.ia_code = adc_code(channel_a_, faults_.sensed_A(0, i.a) + glitch_.ia_A, noise_a_);
    s.ib_code = adc_code(channel_b_, faults_.sensed_A(1, i.b) + glitch_.ib_A, noise_b_);
    if (sensors_.current_sensors == 3) {
        s.ic_code = adc_code(channel_c_, faults_.sensed_A(2, i.c), noise_c_);
    }
    s.dc_link_V   = dc_link_.voltage_V();
    s.count       = position.raw_count;
    s.index       = position.index && faults_.active(FaultKind::index_missing) == nullptr;
    s.index_count = position.index_count;
    return s;
}

void Board::begin_raw_period(const std::array<LegTiming, 3> &legs)
{
    // A dead time that has grown since the start: switches that have become slower than the gates' dead band knows.
    const double late_s =
        std::max(0.0, dead_time_of(sensors_, inverter_, scenario_.drive) - first_dead_time_s_);
    std::array<LegTiming, 3> limited = legs;
    for (LegTiming &leg : limited) {
        leg.duty = std::clamp(leg.duty, inverter_.duty_min, inverter_.duty_max);
        leg.rise_delay_s += late_s;
        leg.fall_delay_s += late_s;
    }
    plant_.reset_peak();
    plant_.align_angle();
    bridge_.begin_period(limited);
}

/// Nothing but the plain motor under a constant averaged voltage.
bool Board::plain_period() const
{
    return scenario_.faults.empty() && plain_inverter_ && plain_motor_ && sensors_.ideal &&
           extra_brake_Nm_ == 0.0;
}

void Board::run_period(const bridge_t &in_force)
{
    plant_.reset_peak();
    if (plain_period() && in_force.gate_enable) {
        plant_.step(inverter_voltage(in_force, dc_link_.voltage_V()), shaft_load_.torque_Nm,
                    period_s_, substeps_per_period);
        return;
    }
    plant_.align_angle();
    bridge_.begin_period(in_force);
    const double advance_s = sensors_.ideal ? 0.0 : sensors_.sampling_advance_s;
    const double sampled_s = period_s_ - advance_s;
    bridge_.advance(plant_, dc_link_, shaft_load_, 0.0, sampled_s);
    if (advance_s > 0.0) {
        early_sample_ = measured_sample();
        have_early_   = true;
        bridge_.advance(plant_, dc_link_, shaft_load_, sampled_s, period_s_);
    }
}

} // namespace sdre
