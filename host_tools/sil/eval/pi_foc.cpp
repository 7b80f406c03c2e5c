// SPDX-License-Identifier: MIT
#include "sil/eval/pi_foc.hpp"

namespace sdre {

pi_foc_gains_t pi_foc_gains(const Drive &drive)
{
    const Motor &m  = drive.motor;
    const double ts = control_period_s(drive);
    const double wc =
        0.1 / ts; // chosen: 1.5 periods of dead time cost 9 degrees of phase margin there
    const double ws           = 0.05 * wc; // chosen: a differenced encoder allows no more
    const double torque_per_A = 1.5 * m.pole_pairs * m.pm_flux_Wb;
    const double speed_p      = ws * m.inertia_kgm2 / (torque_per_A * m.pole_pairs);

    pi_foc_gains_t g{};
    g.ts_s          = static_cast<float>(ts);
    g.speed_p       = static_cast<float>(speed_p);
    g.speed_i       = static_cast<float>(speed_p * 0.25 * ws * ts); // symmetric: zero at a quarter
    g.d_p           = static_cast<float>(wc * m.d_axis_inductance_H);
    g.d_i           = static_cast<float>(wc * m.stator_resistance_Ohm * ts);
    g.q_p           = static_cast<float>(wc * m.q_axis_inductance_H);
    g.q_i           = g.d_i;
    g.current_max_A = static_cast<float>(m.max_current_A);
    return g;
}

} // namespace sdre
