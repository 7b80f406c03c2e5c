// SPDX-License-Identifier: MIT
#include "pi_foc.hpp"

#include <cmath>

extern "C" {
#include "frames.h"
#include "svpwm.h"
}

namespace sdre {
namespace {

/// One PI; the sum takes back what the limit cut off.
float pi_step(float error, float p, float i, float limit, float &sum)
{
    const float wanted  = p * error + sum;
    const float limited = base_clamp(wanted, -limit, limit);
    sum += i * error + (limited - wanted);
    return limited;
}

} // namespace

PiFoc make_pi_foc(const Drive &drive)
{
    const Motor &m  = drive.motor;
    const double ts = control_period_s(drive);
    const double wc =
        0.1 / ts; // chosen: 1.5 periods of dead time cost 9 degrees of phase margin there
    const double ws           = 0.05 * wc; // chosen: a differenced encoder allows no more
    const double torque_per_A = 1.5 * m.pole_pairs * m.pm_flux_Wb;
    const double speed_p      = ws * m.inertia_kgm2 / (torque_per_A * m.pole_pairs);

    PiFoc c;
    c.gains.ts_s    = static_cast<float>(ts);
    c.gains.speed_p = static_cast<float>(speed_p);
    c.gains.speed_i = static_cast<float>(speed_p * 0.25 * ws * ts); // symmetric: zero at a quarter
    c.gains.d_p     = static_cast<float>(wc * m.d_axis_inductance_H);
    c.gains.d_i     = static_cast<float>(wc * m.stator_resistance_Ohm * ts);
    c.gains.q_p     = static_cast<float>(wc * m.q_axis_inductance_H);
    c.gains.q_i     = c.gains.d_i;
    c.gains.current_max_A = static_cast<float>(m.max_current_A);
    return c;
}

drive_output_t pi_foc_tick(PiFoc &c, const drive_sample_t &s, const drive_command_t &command)
{
    const PiFocGains &g = c.gains;
    const dq_t        i = frames_park(frames_clarke(s.ia_A, s.ib_A), frames_angle(s.theta_e_rad));

    const float v_max_V = s.dc_link_V * BASE_1_SQRT3;
    const float iq_ref  = pi_step(command.omega_e_radps - s.omega_e_radps, g.speed_p, g.speed_i,
                                  g.current_max_A, c.speed_sum_A);
    const float v_d     = pi_step(0.0F - i.d, g.d_p, g.d_i, v_max_V, c.d_sum_V);
    const float q_max_V = std::sqrt(v_max_V * v_max_V - v_d * v_d); // the d axis comes first
    const float v_q     = pi_step(iq_ref - i.q, g.q_p, g.q_i, q_max_V, c.q_sum_V);

    const float theta = s.theta_e_rad + 1.5F * g.ts_s * s.omega_e_radps; // as EQ-DRIVE-2
    return {svpwm_duty(frames_inverse_park({v_d, v_q}, frames_angle(theta)), s.dc_link_V), true};
}

} // namespace sdre
