// SPDX-License-Identifier: MIT
/// Operating limits of motor and inverter together, independent of the law: the usual figures of a
/// drive.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

struct MachinePoint {
    double speed_e_radps = 0.0;
    double id_A          = 0.0;
    double iq_A          = 0.0;
    double torque_Nm     = 0.0;
    double voltage_V     = 0.0; ///< of the phase, peak
    double power_W       = 0.0; ///< at the shaft, without friction
};

struct MachinePoints {
    MachinePoint
        rated; ///< MTPA at the rated torque, as fast as the voltage allows, at most the rated speed
    MachinePoint
        limit; ///< MTPA at the current limit, at the base speed: there the voltage's circle is reached
    MachinePoint fastest;  ///< most torque at the largest command, within current and voltage
    bool         mtpv;     ///< there the voltage alone limits it
    double       emf_V;    ///< line to line, peak, at the largest command
    double       circle_V; ///< largest phase voltage, dc link / sqrt(3)
    double current_for_no_flux_A; ///< flux / L_d: with as much d current the magnet's flux is gone
};

MachinePoints machine_points(const Drive &drive);

/// MachinePoints::limit alone; the others take longer.
MachinePoint limit_point(const Drive &drive);

/// Most torque at a speed within the current limit and the circle; none where the circle is too small.
MachinePoint most_torque(const Motor &motor, double speed_e_radps, double circle_V);

/// Length of the phase voltage in steady state [V].
double steady_voltage_V(const Motor &motor, double id_A, double iq_A, double speed_e_radps);

} // namespace sdre
