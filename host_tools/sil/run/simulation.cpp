// SPDX-License-Identifier: MIT
#include "sil/run/simulation.hpp"

#include <chrono>
#include <cmath>
#include <iterator>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "sil/run/board.hpp"

extern "C" {
#include "gain_tables.h"
}

namespace sdre {

Controller prepare_controller(const Scenario &s)
{
    Drive believed      = s.drive;
    believed.motor      = scaled(s.drive.motor, s.controller_scale);
    believed.nosc.order = s.nosc_order.value_or(believed.nosc.order);
    believed.nodo.order = s.nodo_order.value_or(believed.nodo.order);

    Controller c;
    if (drive_digest(believed) == GAIN_TABLES_DIGEST) {
        c.config         = gain_tables_drive;
        c.compiled_table = true;
    } else {
        const Design design = design_drive(believed);
        c.config            = design.config;
        c.harmonics         = design.harmonics ? design.harmonics->table : nullptr;
        c.uncertified       = design.certificate.failures;
    }
    if (s.sensors.ideal && s.inverter.dead_time_s.value_or(0.0) <= 0.0) {
        c.config.dead_time.share = 0.0F; // an inverter without dead time has nothing to compensate
    }
    return c;
}

namespace {

/// What paper B's law compensates on the q axis, as a current slope.
double disturbance_Aps(const drive_t &drive)
{
    const servo_law_config_t &c   = drive.config->servo;
    double                    u_V = static_cast<double>(drive.servo.pid.integral_V);
    if (c.kind == SERVO_LAW_DOBC) {
        u_V = 0.0;
        for (int i = 1; i < c.dobc.n_x; i++) {
            u_V += static_cast<double>(c.dobc.k_x[i] * drive.servo.dobc.x[i]);
        }
    }
    return u_V * static_cast<double>(drive.config->motor.l6);
}

/// The pair that stands still in the stator frame.
double sensor_offset_A(const drive_t &drive)
{
    const nodo_harmonic_gains_t &g = *drive.config->nodo_harmonic;
    for (int i = 0; i < g.n_pairs; i++) {
        if (g.pair[i].channel == NODO_HARMONIC_SENSOR && std::lround(g.pair[i].order) == -1) {
            const nodo_harmonic_pair_t &p = drive.harmonic.pair[i];
            return std::hypot(static_cast<double>(p.a), static_cast<double>(p.b));
        }
    }
    return 0.0;
}

} // namespace

void add_drive(TraceRow &row, const drive_t &drive)
{
    row.iq_ref_A    = static_cast<double>(drive.current_ref.i_A.q);
    row.id_ref_A    = static_cast<double>(drive.current_ref.i_A.d);
    row.vq_V        = static_cast<double>(drive.v_V.q);
    row.vd_V        = static_cast<double>(drive.v_V.d);
    row.d_omega_hat = static_cast<double>(drive.observer.d_omega);
    row.d_q_hat     = static_cast<double>(drive.observer.d_q);
    row.d_d_hat     = static_cast<double>(drive.observer.d_d);
    if (drive.config != nullptr && drive.config->law == DRIVE_LAW_SERVO) {
        row.d_q_hat = disturbance_Aps(drive);
    }
    if (drive.config != nullptr && drive.config->law == DRIVE_LAW_NOC_H) {
        row.sensor_offset_hat_A = sensor_offset_A(drive);
    }
}

namespace {

TraceRow row_of(double time_s, double omega_ref, const Board &board, const drive_t &drive)
{
    const Plant      &plant = board.plant();
    const RotorVector i     = plant.current_A();
    TraceRow          row;
    row.time_s            = time_s;
    row.omega_ref_e_radps = omega_ref;
    row.omega_e_radps     = plant.omega_e_radps();
    row.iq_A              = i.q;
    row.id_A              = i.d;
    row.load_torque_Nm    = board.load_Nm();
    row.torque_Nm         = plant.torque_Nm();
    row.dc_link_V         = board.dc_link_V();
    add_drive(row, drive);
    return row;
}

} // namespace

SimulationResult simulate(const Scenario &s)
{
    return simulate(s, prepare_controller(s));
}

SimulationResult simulate(const Scenario &s, const Controller &controller)
{
    const double ts    = control_period_s(s.drive);
    const auto   ticks = static_cast<long>(std::floor(s.duration_s / ts + 1e-9)) + 1;

    Board            board(s);
    StepCursor       reference(s.speed_reference, s.initial_speed_e_radps);
    drive_t          drive{};
    SimulationResult result;
    result.compiled_table = controller.compiled_table;
    result.uncertified    = controller.uncertified;
    result.trace.reserve(static_cast<std::size_t>(ticks));
    if (drive_init(&drive, &controller.config) != CTL_OK) {
        throw DesignError("the control core refuses these constants");
    }

    drive_output_t in_force{{0.5F, 0.5F, 0.5F}, true}; // until the first result acts: no voltage
    const auto     start = std::chrono::steady_clock::now();
    for (long k = 0; k < ticks; k++) {
        const double t         = static_cast<double>(k) * ts;
        const double omega_ref = reference.at(t);
        board.begin_tick(t);

        const drive_sample_t  sample  = board.sample();
        const drive_command_t command = {static_cast<float>(omega_ref), true};
        const drive_output_t  output  = drive_tick(&drive, &sample, &command);
        result.trace.push_back(row_of(t, omega_ref, board, drive));
        if (drive.state == DRIVE_FAULT && result.fault == 0) {
            result.fault        = drive.fault;
            result.fault_time_s = t;
        }

        in_force.gate_enable = in_force.gate_enable && output.gate_enable; // gates go off at once
        board.run_period(in_force);
        result.trace.back().peak_current_A = board.peak_current_A();
        in_force                           = output;
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    result.simulated_seconds_per_second      = static_cast<double>(ticks) * ts / wall.count();
    return result;
}

namespace {

const char *app_fault_name(int fault)
{
    // In the order of app_fault_t, which is part of the serial protocol.
    static const char *const names[] = {"none",
                                        "application: constant out of range",
                                        "application: board fault",
                                        "application: background stands still",
                                        "application: invalid sample",
                                        "application: current offset",
                                        "application: temperature sensor",
                                        "application: temperature",
                                        "application: index out of place",
                                        "application: alignment",
                                        "application: drive"};
    return fault >= 0 && fault < static_cast<int>(std::size(names)) ? names[fault] : "unknown";
}

} // namespace

const char *fault_name(int fault)
{
    if (fault == device_reset_fault) {
        return "reset by the watchdog";
    }
    if (fault >= app_fault_base) {
        return app_fault_name(fault - app_fault_base);
    }
    switch (static_cast<drive_fault_t>(fault)) {
    case DRIVE_FAULT_NONE:
        return "none";
    case DRIVE_FAULT_SAMPLE:
        return "invalid sample";
    case DRIVE_FAULT_OVER_CURRENT:
        return "over current";
    case DRIVE_FAULT_DC_LINK:
        return "dc link out of range";
    case DRIVE_FAULT_OVER_SPEED:
        return "over speed";
    case DRIVE_FAULT_ENCODER:
        return "encoder implausible";
    case DRIVE_FAULT_COMMAND:
        return "command out of range";
    case DRIVE_FAULT_NUMERIC:
        return "law not a number";
    }
    return "unknown";
}

} // namespace sdre
