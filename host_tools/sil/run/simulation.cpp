// SPDX-License-Identifier: MIT
#include "sil/run/simulation.hpp"

#include <chrono>
#include <cmath>

#include "common/errors.hpp"
#include "sil/run/board.hpp"

namespace sdre {

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

} // namespace sdre
