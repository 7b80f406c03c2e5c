// SPDX-License-Identifier: MIT
#include "design/noc_shaft/shaft_design.hpp"

#include <cmath>

#include "design/sampled_observer.hpp"
#include "linalg/c2d.hpp"

namespace sdre {
namespace {

using namespace shaft_rows;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double two_pi = 6.283185307179586;

} // namespace

double resonance_radps(const Shaft &shaft)
{
    return two_pi * shaft.resonance_Hz;
}

namespace {

/// EQ-CERT-9 in (w w_load twist) with inputs a = l1 iq + .. and d_w.
struct Masses {
    MatrixXd A; ///< 3 x 3
    MatrixXd B; ///< 3 x 2
};

Masses masses(const ReducedParameters &l, const Shaft &shaft)
{
    const double s      = shaft.load_inertia_share;
    const double spring = resonance_radps(shaft) * resonance_radps(shaft);
    const double drag   = 2.0 * shaft.damping * resonance_radps(shaft);
    Masses       m{MatrixXd(3, 3), MatrixXd::Zero(3, 2)};
    m.A << -l[2] / (1.0 - s) - s * drag, s * drag, -s * spring, (1.0 - s) * drag, -(1.0 - s) * drag,
        (1.0 - s) * spring, 1.0, -1.0, 0.0;
    m.B(0, 0) = 1.0 / (1.0 - s);
    m.B(1, 1) = 1.0 / s;
    return m;
}

} // namespace

Shaft believed_shaft(const Drive &drive)
{
    const Mechanics &m = drive.mechanics;
    return {m.resonance_Hz, m.least_damping, m.load_inertia_share};
}

double twist_per_accel(const Shaft &shaft)
{
    return 1.0 /
           ((1.0 - shaft.load_inertia_share) * resonance_radps(shaft) * resonance_radps(shaft));
}

MatrixXd shaft_step(const ReducedParameters &l, const Shaft &shaft, double ts)
{
    const Masses m        = masses(l, shaft);
    MatrixXd     A        = MatrixXd::Zero(4, 4);
    MatrixXd     B        = MatrixXd::Zero(4, 2);
    A.topLeftCorner(3, 3) = m.A;
    A(3, 0)               = 1.0;
    B.topRows(3)          = m.B;
    const auto held       = c2d(A, B, ts);
    MatrixXd   step(4, 5);
    step << held.Phi.leftCols(3), held.Gamma;
    return step;
}

namespace {

/// (e_w e_iq e_id slip twist) of a plant (w w_load twist) with the motor's currents.
SdreProblem controller_problem(const ReducedParameters &l, const Drive &drive)
{
    const NoscSpec &spec     = drive.nosc;
    const Shaft     shaft    = believed_shaft(drive);
    const Masses    m        = masses(l, shaft);
    SdreProblem     of_motor = nosc_problem(l, spec);

    MatrixXd                        A = MatrixXd::Zero(5, 5); // in (w iq id w_load twist)
    const std::vector<Eigen::Index> masses_at{0, 3, 4};
    A.block(1, 0, 2, 3)     = of_motor.A0.middleRows(1, 2);
    A(masses_at, masses_at) = m.A;
    A(0, 1)                 = l[1] * m.B(0, 0);
    MatrixXd dA             = MatrixXd::Zero(5, 5);
    dA(0, 2)                = l[11] * m.B(0, 0);

    MatrixXd S         = MatrixXd::Identity(5, 5); // to the slip
    MatrixXd S_inverse = MatrixXd::Identity(5, 5);
    S(3, 0)            = -1.0;
    S_inverse(3, 0)    = 1.0;
    VectorXd Q(5);
    Q << spec.Q[0], spec.Q[1], spec.Q[2], drive.shaft.Q[0], drive.shaft.Q[1];
    MatrixXd G            = MatrixXd::Zero(5, 5);
    G.topLeftCorner(3, 3) = of_motor.G;
    return {S * A * S_inverse,
            {S * dA * S_inverse},
            G,
            S_inverse.transpose() * Q.asDiagonal() * S_inverse};
}

} // namespace

GainSeries solve_shaft_controller(const ReducedParameters &l, const Drive &drive,
                                  Precision precision)
{
    const Eigen::Vector2d T_inverse(1.0 / drive.nosc.T[0], 1.0 / drive.nosc.T[1]);
    MatrixXd              B = MatrixXd::Zero(5, 2);
    B.topRows(3)            = nosc_input_matrix(l);
    return solve_gain_series(controller_problem(l, drive), T_inverse.asDiagonal() * B.transpose(),
                             MatrixXd::Identity(5, 5), drive.nosc.order, precision);
}

ObserverModel shaft_observer_model(const ReducedParameters &l, const Shaft &shaft)
{
    const ObserverModel base = nodo_model(l, NodoForm::encoder);
    const Masses        m    = masses(l, shaft);
    ObserverModel       model{
        MatrixXd::Zero(count, count), MatrixXd::Zero(count, count), {}, MatrixXd::Zero(3, count)};
    model.A0.topLeftCorner(7, 7) = base.A0;
    model.dA.topLeftCorner(7, 7) = base.dA;
    model.C.leftCols(7)          = base.C;
    const std::vector<Eigen::Index> masses_at{omega, omega_load, twist};
    model.A0(masses_at, masses_at) = m.A;
    model.A0(omega, iq)            = l[1] * m.B(0, 0);
    model.dA(omega, id)            = l[11] * m.B(0, 0);
    model.A0(omega, d_omega)       = 0.0; // the load torque acts behind the shaft
    model.A0(omega_load, d_omega)  = m.B(1, 1);
    return model;
}

GainSeries solve_shaft_observer(const ReducedParameters &l, const Drive &drive)
{
    const double        ts    = control_period_s(drive);
    const NodoSpec     &spec  = drive.nodo;
    const ObserverModel model = shaft_observer_model(l, believed_shaft(drive));
    const Vector3d      T(spec.T[0], spec.T[1], spec.T[2]);
    VectorXd            Q(9);
    Q << VectorXd::Map(spec.Q.data(), 7), drive.shaft.nodo_Q[0], drive.shaft.nodo_Q[1];

    const auto at_current = [=](double iq_A) {
        return solve_sampled_observer(
            sampled_observer(model.A0 + iq_A * model.dA, model.dA, model.C, Q, T, ts));
    };
    const SampledObserverGain k = at_current(0.0);
    GainSeries                out;
    out.problem                             = {model.A0.transpose(),
                                               {MatrixXd(model.dA.transpose())},
                                               control_weight(model.C.transpose(), T.asDiagonal()),
                                               Q.asDiagonal()};
    out.series.care.closed_loop_eigenvalues = encoder_form_poles(model, k.K0 / ts, 0.0, ts);
    out.series.terms = {{{0}, k.P0, k.riccati_residual}, {{1}, k.P1, k.stein_residual}};
    out.gain         = {k.K0 / ts, k.K1 / ts};
    out.residuals    = {k.riccati_residual, k.stein_residual};
    out.exact        = [=](const Schedule &s) -> MatrixXd { return at_current(s[0]).K0 / ts; };
    return out;
}

} // namespace sdre
