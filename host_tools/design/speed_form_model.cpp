// SPDX-License-Identifier: MIT
#include "design/speed_form_model.hpp"

#include <vector>

namespace sdre {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index n_motor    = 4; // w, iq, id, theta
constexpr Index n_estimate = 6; // d_w^, d_q^, d_d^, w^, iq^, id^
constexpr Index first_hat  = n_motor;
constexpr Index first_v    = first_hat + n_estimate;
constexpr Index first_ref  = first_v + 2;
constexpr Index row_d_q    = 1;
constexpr Index row_d_d    = 2;
constexpr Index theta      = 3;
constexpr Index theta_of_7 = 6;

/// x^(k+1) = P x^ + K y + G v, y = (w, iq, id).
struct Observer {
    MatrixXd P; ///< 6 x 6
    MatrixXd K; ///< 6 x 3
    MatrixXd G; ///< 6 x 2
};

/// An observer of the load alone gets zero rows for d_q and d_d.
MatrixXd six_rows(const MatrixXd &L)
{
    if (L.rows() == n_estimate) {
        return L;
    }
    MatrixXd all      = MatrixXd::Zero(n_estimate, 3);
    all.row(0)        = L.row(0);
    all.bottomRows(3) = L.bottomRows(3);
    return all;
}

/// EQ-NODO-1, 2 or EQ-CONVENTIONAL-3, linearised where the estimates are the measurements.
Observer observer_at(const ReducedParameters &l, NodoForm form, const MatrixXd &L,
                     const OperatingPoint &at, double ts)
{
    const MatrixXd all_L = six_rows(L);
    MatrixXd       A     = MatrixXd::Zero(n_estimate, n_estimate);
    MatrixXd       B     = MatrixXd::Zero(n_estimate, 2);
    MatrixXd       K     = all_L;
    A.block(3, 0, 3, 3)  = MatrixXd::Identity(3, 3);
    A.block(3, 3, 3, 3)  = motor_jacobian(l, at);
    if (form == NodoForm::speed) { // -l10 id w is of the measurements
        const Eigen::RowVector3d product(-l[10] * at.id_A, 0.0, -l[10] * at.omega_e_radps);
        A.block(4, 3, 1, 3) -= product;
        K.row(4) += product;
    }
    A.rightCols(3) -= all_L;
    B.bottomRows(3) = nosc_input_matrix(l);
    return {MatrixXd::Identity(n_estimate, n_estimate) + ts * A, ts * K, ts * B};
}

/// A row over the encoder form's seven states, as parts of the motor and of the estimates.
struct Split {
    MatrixXd of_motor;    ///< rows x 4: w, iq, id, theta are measured
    MatrixXd of_estimate; ///< rows x 6
};

Split split(const MatrixXd &rows)
{
    Split s{MatrixXd(rows.rows(), n_motor), MatrixXd::Zero(rows.rows(), n_estimate)};
    s.of_motor << rows.middleCols(3, 3), rows.col(theta_of_7);
    s.of_estimate.leftCols(3) = rows.leftCols(3);
    return s;
}

} // namespace

SampledModel speed_form_model(const TrueMotor &motor, const ReducedParameters &model, NodoForm form,
                              const LoopGains &gains, const OperatingPoint &at, double ts,
                              const MovingReference *moving)
{
    const Held<MatrixXd> held  = held_motor(motor, at, ts);
    const Observer       o     = observer_at(model, form, gains.L, at, ts);
    const LawRows        law   = encoder_form_law(model, gains.Lambda, at, moving);
    const Split          F     = split(law.F);
    const Split          F_r   = split(law.B_ref);
    const Index          n_ref = law.A_ref.rows();
    const Index          n     = first_ref + n_ref;

    MatrixXd estimate    = MatrixXd::Zero(n_estimate, n); // x^(k+1), which the law uses
    estimate.leftCols(3) = o.K;
    estimate.middleCols(first_hat, n_estimate) = o.P;
    estimate.middleCols(first_v, 2)            = o.G;

    MatrixXd A                          = MatrixXd::Zero(n, n);
    A.topLeftCorner(n_motor, n_motor)   = held.Phi;
    A.block(0, first_v, n_motor, 2)     = held.Gamma.leftCols(2);
    A.middleRows(first_hat, n_estimate) = estimate;
    A.middleRows(first_v, 2)            = F.of_estimate * estimate;
    A.block(first_v, 0, 2, n_motor) += F.of_motor;
    A.block(first_v, first_ref, 2, n_ref) += law.F_ref;
    if (n_ref > 0) {
        A.bottomRows(n_ref) = F_r.of_estimate * estimate;
        A.block(first_ref, 0, n_ref, n_motor) += F_r.of_motor;
        A.bottomRightCorner(n_ref, n_ref) += law.A_ref;
    }
    MatrixXd b_load                  = MatrixXd::Zero(n, 1);
    b_load.topRows(n_motor)          = held.Gamma.col(2);
    MatrixXd B_voltage               = MatrixXd::Zero(n, 2);
    B_voltage.topRows(n_motor)       = held.Gamma.leftCols(2);
    MatrixXd C_voltage               = MatrixXd::Zero(2, n);
    C_voltage.middleCols(first_v, 2) = MatrixXd::Identity(2, 2);

    std::vector<Index> kept;
    for (Index i = 0; i < n; i++) {
        const bool unused = (i == theta && !has_angle(gains.Lambda)) ||
                            (form == NodoForm::conventional_load &&
                             (i == first_hat + row_d_q || i == first_hat + row_d_d));
        if (!unused) {
            kept.push_back(i);
        }
    }
    const auto   all = Eigen::all;
    SampledModel out;
    out.ts_s      = ts;
    out.A         = A(kept, kept);
    out.b_load    = b_load(kept, all);
    out.C_voltage = C_voltage(all, kept);
    out.B_voltage = B_voltage(kept, all);
    return out;
}

} // namespace sdre
