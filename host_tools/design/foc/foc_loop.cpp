// SPDX-License-Identifier: MIT
#include "design/foc/foc_loop.hpp"

#include <algorithm>
#include <cmath>

#include "design/foc/foc_design.hpp"
#include "design/torque.hpp"

namespace sdre {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Columns of the state: motor (w, iq, id), voltage in force, sums of the current loops, id_ref of
// the previous period. The angle's steps of the last periods and the speed law's states follow.
enum : Index { iq = 1, id, vq, vd, sum_q, sum_d, id_before, first_step };

double wide(float x)
{
    return static_cast<double>(x);
}

/// Constants that both laws have, and the number of the law's own states.
struct Parts {
    const foc_config_t              *foc;
    const speed_difference_config_t *speed;
    Index                            own;
};

bool has_load_observer(const law_pi_foc_config_t &c)
{
    return c.gains[SPEED_DIFFERENCE_TIMED].load.gain_w > 0.0F;
}

Parts parts_of(const drive_config_t &config)
{
    if (const auto *c = constants_of<law_pi_foc_config_t>(config)) {
        return {&c->foc, &c->speed, has_load_observer(*c) ? 4 : 1};
    }
    const auto *c = constants_of<law_ladrc_config_t>(config);
    return {&c->foc, &c->speed, 3};
}

/// The acceleration that the law requests, from the state. The rows of the law's own states in the
/// next period follow.
struct SpeedLaw {
    RowVectorXd accel;
    MatrixXd    next;
};

/// Next z_w, z_f and acceleration of the period before. Their columns begin at `first`.
MatrixXd observer_rows(const speed_observer_gains_t &c, const RowVectorXd &speed,
                       const RowVectorXd &torque, double ts_s, Index first)
{
    const Index       n   = speed.size();
    const RowVectorXd z_f = RowVectorXd::Unit(n, first + 1);
    const RowVectorXd z_w = RowVectorXd::Unit(n, first) + ts_s * z_f +
                            0.5 * ts_s * (RowVectorXd::Unit(n, first + 2) + torque); // EQ-LADRC-1
    const RowVectorXd e = speed - z_w;

    MatrixXd next(3, n);
    next.row(0) = z_w + wide(c.gain_w) * e; // EQ-LADRC-2
    next.row(1) = z_f + wide(c.gain_f_1ps) * e;
    next.row(2) = torque;
    return next;
}

/// State: those of a load observer, if there is one, then the sum, in the last columns.
SpeedLaw pi_law(const law_pi_foc_gains_t &c, const RowVectorXd &speed, const RowVectorXd &torque,
                double ts_s, bool observes)
{
    const Index       n    = speed.size();
    const RowVectorXd sum  = RowVectorXd::Unit(n, n - 1);
    const RowVectorXd wish = sum - wide(c.kp_1ps) * speed;                     // EQ-PI-FOC-2
    const RowVectorXd next = sum - wide(c.ki_per_kp) * wide(c.kp_1ps) * speed; // EQ-PI-FOC-3
    if (!observes) {
        return {wish, next};
    }
    SpeedLaw law;
    law.next.resize(4, n);
    law.next.topRows(3) = observer_rows(c.load, speed, torque, ts_s, n - 4);
    law.next.row(3)     = next;
    law.accel           = wish - law.next.row(1); // EQ-PI-FOC-5
    return law;
}

/// The sum is not used. A torque is constant, and its speed limit is a P of the speed.
SpeedLaw torque_law(SpeedLaw law, const law_pi_foc_gains_t &c, const RowVectorXd &speed, FocRun run)
{
    const Index       n = speed.size();
    const RowVectorXd zf =
        law.next.rows() > 1 ? RowVectorXd(law.next.row(1)) : RowVectorXd::Zero(n);
    law.next.bottomRows(1).setZero();
    law.accel = run == FocRun::limit ? RowVectorXd(-wide(c.kp_1ps) * speed - zf)
                                     : RowVectorXd::Zero(n); // EQ-PI-FOC-6
    return law;
}

/// States: those of the observer, in the last columns.
SpeedLaw ladrc_law(const law_ladrc_gains_t &c, const RowVectorXd &speed, const RowVectorXd &torque,
                   double ts_s)
{
    SpeedLaw law;
    law.next  = observer_rows(c.observer, speed, torque, ts_s, speed.size() - 3);
    law.accel = -wide(c.w_c_1ps) * law.next.row(0) - law.next.row(1); // EQ-LADRC-3
    return law;
}

/// Everything of a period as rows on the state.
struct Signals {
    RowVectorXd iq_ref;
    RowVectorXd id_ref;
    RowVectorXd e_q;
    RowVectorXd e_d;
    RowVectorXd u_q;
    RowVectorXd u_d;
    MatrixXd    own;        ///< the speed law's next states
    double      bend = 0.0; ///< of id_ref over iq_ref
};

SpeedLaw speed_law(const Design &d, speed_difference_mode_t mode, FocRun run,
                   const RowVectorXd &speed, const RowVectorXd &torque)
{
    const double ts = control_period_s(d.drive);
    if (const auto *pi = constants_of<law_pi_foc_config_t>(d.config)) {
        const auto    &c   = pi->gains[mode];
        const SpeedLaw law = pi_law(c, speed, torque, ts, has_load_observer(*pi));
        return run == FocRun::speed ? law : torque_law(law, c, speed, run);
    }
    return ladrc_law(constants_of<law_ladrc_config_t>(d.config)->gains[mode], speed, torque, ts);
}

Signals signals(const Design &d, const OperatingPoint &at, speed_difference_mode_t mode, FocRun run,
                Index n, Index steps)
{
    const Motor        &m     = d.drive.motor;
    const foc_config_t &foc   = *parts_of(d.config).foc;
    const double        ts    = control_period_s(d.drive);
    const double        per_A = d.l[1] + d.l[11] * at.id_A;
    const auto          unit  = [n](Index i) -> RowVectorXd { return RowVectorXd::Unit(n, i); };

    const RowVectorXd torque = per_A * unit(iq) + d.l[11] * at.iq_A * unit(id);
    RowVectorXd       speed  = RowVectorXd::Zero(n); // EQ-SPEED-DIFFERENCE-1
    speed.segment(first_step, steps).setConstant(1.0 / (static_cast<double>(steps) * ts));

    const SpeedLaw law = speed_law(d, mode, run, speed, torque);

    Signals s;
    s.bend   = -at.iq_A / std::hypot(wide(foc.mtpa_A), at.iq_A);
    s.iq_ref = (law.accel - d.l[11] * at.iq_A * unit(id_before)) / per_A; // EQ-FOC-1
    s.id_ref = s.bend * s.iq_ref;                                         // EQ-FOC-2
    s.e_q    = s.iq_ref - unit(iq);
    s.e_d    = s.id_ref - unit(id);
    s.u_q    = wide(foc.q.kp_V_per_A) * s.e_q + unit(sum_q) +
            at.omega_e_radps * m.d_axis_inductance_H * unit(id) +
            (m.d_axis_inductance_H * at.id_A + m.pm_flux_Wb) * speed; // EQ-FOC-5
    s.u_d = wide(foc.d.kp_V_per_A) * s.e_d + unit(sum_d) -
            m.q_axis_inductance_H * (at.omega_e_radps * unit(iq) + at.iq_A * speed);
    s.own = law.next;
    return s;
}

} // namespace

std::vector<BrokenLoop> foc_loops(const Design &d, const Motor &motor_there,
                                  const OperatingPoint &at, speed_difference_mode_t mode,
                                  FocRun run)
{
    const bool          free  = run == FocRun::torque;
    const Motor         shaft = free ? with_load_of_its_own(motor_there) : motor_there;
    const double        ts    = control_period_s(d.drive);
    const Parts         parts = parts_of(d.config);
    const foc_config_t &foc   = *parts.foc;
    const Index         steps = speed_periods(d.drive, *parts.speed, mode);
    const Index         n     = first_step + steps + parts.own;
    const Signals       s     = signals(d, at, mode, run, n, steps);

    const auto plant        = held_motor(true_motor(d.drive, shaft), at, ts);
    MatrixXd   motor        = MatrixXd::Zero(4, n);
    motor.leftCols(3)       = plant.Phi.leftCols(3);
    motor.middleCols(vq, 2) = plant.Gamma.leftCols(2);

    MatrixXd A        = MatrixXd::Zero(n, n);
    A.topRows(3)      = motor.topRows(3);
    A.row(vq)         = s.u_q;
    A.row(vd)         = s.u_d;
    A.row(sum_q)      = wide(foc.q.ki_tick) * s.e_q; // EQ-FOC-6
    A.row(sum_d)      = wide(foc.d.ki_tick) * s.e_d;
    A.row(id_before)  = s.id_ref;
    A.row(first_step) = motor.row(3);
    A(sum_q, sum_q) += 1.0;
    A(sum_d, sum_d) += 1.0;
    for (Index i = 1; i < steps; i++) {
        A(first_step + i, first_step + i - 1) = 1.0;
    }
    A.bottomRows(parts.own) = s.own;

    VectorXd on_current   = VectorXd::Zero(n);
    on_current(vq)        = wide(foc.q.kp_V_per_A);
    on_current(vd)        = wide(foc.d.kp_V_per_A) * s.bend;
    on_current(sum_q)     = wide(foc.q.ki_tick);
    on_current(sum_d)     = wide(foc.d.ki_tick) * s.bend;
    on_current(id_before) = s.bend;
    const double own      = free ? shaft_mode(motor_there, ts) : 0.0;
    return {{A, on_current, s.iq_ref, ts, own},
            {A, VectorXd::Unit(n, vq), s.u_q, ts, own},
            {A, VectorXd::Unit(n, vd), s.u_d, ts, own}};
}

LoopFamily foc_family(const Design &d)
{
    LoopFamily family;
    family.channels = {"speed loop", "q axis", "d axis"};
    family.points   = verdict_points(d);
    family.loops    = [&d](const Motor &motor, const OperatingPoint &at) {
        std::vector<BrokenLoop>              all;
        std::vector<FocRun>                  runs{FocRun::speed};
        std::vector<speed_difference_mode_t> modes{SPEED_DIFFERENCE_COUNTED};
        if (d.config.torques) {
            runs.insert(runs.end(), {FocRun::torque, FocRun::limit});
        }
        if (d.drive.encoder.edge_times) {
            modes.push_back(SPEED_DIFFERENCE_TIMED);
        }
        for (const FocRun run : runs) {
            for (const speed_difference_mode_t mode : modes) {
                const auto loops = foc_loops(d, motor, at, mode, run);
                all.insert(all.end(), loops.begin(), loops.end());
            }
        }
        return all;
    };
    return family;
}

} // namespace sdre
