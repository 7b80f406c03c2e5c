// SPDX-License-Identifier: MIT
#include "design/sampled_observer.hpp"

#include <cmath>
#include <complex>

#include "linalg/c2d.hpp"
#include "linalg/eigenvalues.hpp"

namespace sdre {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

SampledObserverProblem sampled_observer(const MatrixXd &A, const MatrixXd &dA, const MatrixXd &C,
                                        const VectorXd &Q, const VectorXd &T, double ts)
{
    const Transition       over = transition(A, dA, ts);
    SampledObserverProblem p;
    p.A0               = over.Phi;
    p.A1               = over.dPhi;
    const MatrixXd AQ  = over.Phi * Q.asDiagonal();
    const MatrixXd AQ1 = 0.5 * ts * over.dPhi * AQ.transpose();
    p.Q0               = 0.5 * ts * (AQ * over.Phi.transpose() + MatrixXd(Q.asDiagonal()));
    p.Q1               = AQ1 + AQ1.transpose();
    p.C                = C;
    p.R                = (T / ts).asDiagonal();
    return p;
}

namespace {

SampledObserverGain at_current(const ObserverModel &model, const NodoSpec &spec, double iq_A,
                               double ts)
{
    const VectorXd Q = VectorXd::Map(spec.Q.data(), static_cast<Eigen::Index>(spec.Q.size()));
    const Vector3d T(spec.T[0], spec.T[1], spec.T[2]);
    return solve_sampled_observer(
        sampled_observer(model.A0 + iq_A * model.dA, model.dA, model.C, Q, T, ts));
}

} // namespace

Eigen::VectorXcd encoder_form_poles(const ObserverModel &model, const MatrixXd &L, double iq_A,
                                    double ts)
{
    const auto     n    = model.A0.rows();
    const MatrixXd Phi  = transition(model.A0 + iq_A * model.dA, model.dA, ts).Phi;
    const MatrixXd loop = Phi * (MatrixXd::Identity(n, n) - ts * L * model.C);
    return (eigenvalues(loop).array().log() / ts).matrix();
}

GainSeries solve_encoder_form(const ReducedParameters &l, const NodoSpec &spec, double ts)
{
    const ObserverModel       model = nodo_model(l, NodoForm::encoder);
    const SampledObserverGain k     = at_current(model, spec, 0.0, ts);

    GainSeries out;
    out.problem                             = nodo_problem(l, spec);
    out.series.care.closed_loop_eigenvalues = encoder_form_poles(model, k.K0 / ts, 0.0, ts);
    out.series.terms                        = {{{0}, k.P0, k.riccati_residual}};
    out.gain                                = {k.K0 / ts};
    out.residuals                           = {k.riccati_residual};
    if (spec.order > 0) {
        out.series.terms.push_back({{1}, k.P1, k.stein_residual});
        out.gain.emplace_back(k.K1 / ts);
        out.residuals.push_back(k.stein_residual);
    }
    out.exact = [=](const Schedule &s) -> MatrixXd {
        return at_current(model, spec, s[0], ts).K0 / ts;
    };
    return out;
}

} // namespace sdre
