// SPDX-License-Identifier: MIT
#include "design/noc_iron/iron_loop.hpp"

#include <utility>

#include "design/design.hpp"
#include "design/law_design.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

// States of the encoder form's observer.
constexpr Eigen::Index d_omega = 0;
constexpr Eigen::Index d_q     = 1;
constexpr Eigen::Index d_d     = 2;
constexpr Eigen::Index omega   = 3;
constexpr Eigen::Index iq      = 4;
constexpr Eigen::Index id      = 5;

iron_tangent_t tangent_at(const Design &d, const iron_map_t &table, const OperatingPoint &at)
{
    return iron_tangent(&table, &d.config.motor, static_cast<float>(at.id_A),
                        static_cast<float>(at.iq_A));
}

ReducedParameters as_parameters(const motor_reduced_t &m, ReducedParameters l)
{
    const float of[] = {m.l1, m.l2, m.l3, m.l4, m.l5, m.l6, m.l7, m.l8, m.l9, m.l10, m.l11};
    std::size_t i    = 1;
    for (const float x : of) {
        l[i++] = static_cast<double>(x);
    }
    return l;
}

} // namespace

ReducedParameters believed_motor(const Design &d, const OperatingPoint &at)
{
    const auto *c = constants_of<law_noc_iron_config_t>(d.config);
    return c == nullptr ? d.l : as_parameters(tangent_at(d, c->iron, at).motor, d.l);
}

IdReference believed_reference(IdReference r, const ReducedParameters &constants,
                               const ReducedParameters &believed)
{
    const double to_l6 = believed[6] / constants[6];
    r.most_Aps *= to_l6;
    r.c.flux_A *= static_cast<float>(to_l6);
    return r;
}

namespace {

double number(float x)
{
    return static_cast<double>(x);
}

/// EQ-IRON-1 linearised at the point itself, 7 x 7 and 7 x 2: constant disturbances, theta' = w.
std::pair<MatrixXd, MatrixXd> observer_motor(const iron_map_t &map, const iron_tangent_t &t,
                                             const OperatingPoint &at)
{
    const double w   = at.omega_e_radps;
    const double ld  = number(t.motor.inv_l8);
    const double lq  = number(t.motor.inv_l6);
    const double m   = number(t.m_H);
    const double rs  = number(map.rs_Ohm);
    const double c   = number(map.accel_per_WbA);
    const double p_d = number(t.psi_d_Wb);
    const double p_q = number(t.psi_q_Wb);

    Eigen::Matrix2d inverse; // of (i_q, i_d)
    inverse << ld, -m, -m, lq;
    inverse *= number(t.inv_det_1pH2);
    MatrixXd of_state(2, 3); // e_q, e_d over w, i_q, i_d
    of_state << -p_d, -rs - w * m, -w * ld, p_q, w * lq, -rs + w * m;

    MatrixXd J          = MatrixXd::Zero(7, 7);
    J.block(3, 0, 3, 3) = MatrixXd::Identity(3, 3);
    J.block(3, 3, 1, 3) << -number(t.motor.l2), c * (p_d + m * at.iq_A - lq * at.id_A),
        c * (ld * at.iq_A - p_q - m * at.id_A);
    J.block(4, 3, 2, 3) = inverse * of_state;
    J(6, 3)             = 1.0;
    MatrixXd B          = MatrixXd::Zero(7, 2);
    B.block(4, 0, 2, 2) = inverse;
    return {J, B};
}

} // namespace

SampledModel sampled_iron_model(const Design &d, const TrueMotor &motor, const OperatingPoint &at,
                                const LoopGains &gains, const MovingReference *moving)
{
    const auto             &c  = *constants_of<law_noc_iron_config_t>(d.config);
    const double            ts = control_period_s(d.drive);
    const iron_tangent_t    t  = tangent_at(d, c.iron, at);
    const ReducedParameters l  = as_parameters(t.motor, d.l);
    const double            m  = number(t.m_H);

    Eigen::Matrix2d to_iron; // EQ-IRON-3, of (v_q, v_d)
    to_iron << d.l[6] / l[6], m * d.l[8], m * d.l[6], d.l[8] / l[8];
    const MatrixXd Lambda = to_iron * gains.Lambda;

    const double w      = at.omega_e_radps;
    const double offset = number(t.psi_q_Wb) - number(t.iq_A) / l[6];
    MatrixXd     T      = MatrixXd::Identity(7, 7); // EQ-IRON-5
    T(d_d, omega)       = offset * l[8];
    T(d_d, id)          = w * m * l[8];
    T(d_q, iq)          = -w * m * l[6];
    T(d_omega, id)      = -number(c.iron.accel_per_WbA) * (offset + m * at.id_A);

    LawRows law = encoder_form_law(l, Lambda, at, moving);
    law.F       = law.F * T;
    if (law.B_ref.rows() > 0) {
        law.B_ref = law.B_ref * T;
    }
    const auto [J, B] = observer_motor(c.iron, t, at);
    const MatrixXd I  = MatrixXd::Identity(7, 7);
    const MatrixXd P  = I + ts * J * (I + 0.5 * ts * J); // EQ-NODO-ENCODER-2
    const MatrixXd G  = ts * (I + 0.5 * ts * J) * B;
    const MatrixXd C  = nodo_model(l, NodoForm::encoder).C;
    return closed_loop({held_motor(motor, at, ts), at, ts}, {P, G, C, law}, gains.L,
                       has_angle(gains.Lambda));
}

} // namespace sdre
