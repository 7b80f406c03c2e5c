// SPDX-License-Identifier: MIT
#include "certificate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "firmware_config.hpp"
#include "sampled_model.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

// Chosen: fine enough that neighbouring points differ by under 2 % of the range.
constexpr int points_per_side = 64;
constexpr int speed_points    = 4;

// The phase current can pass from -max to +max while the bridge runs, so errors reach twice the limit;
// beyond the same figure the firmware trips.
double certified_range_A(const Motor &motor)
{
    return 2.0 * motor.max_current_A;
}

MatrixXd series_gain(const std::vector<MatrixXd> &gain, double s, std::size_t max_order)
{
    MatrixXd K = MatrixXd::Zero(gain[0].rows(), gain[0].cols());
    for (std::size_t n = std::min(max_order + 1, gain.size()); n-- > 0;) {
        K = K * s + gain[n];
    }
    return K;
}

/// The exact gain at a frozen state, from the exact solution X of the SDRE there.
using ExactGain = std::function<MatrixXd(const MatrixXd &X)>;
/// The spectral radius of the sampled loop with gain K at scheduling current s.
using Radius = std::function<double(const MatrixXd &K, double s)>;
/// The continuous closed loop.
using ClosedLoop = std::function<MatrixXd(const MatrixXd &K, double s)>;

std::vector<double> grid(double range)
{
    std::vector<double> s;
    for (int i = -points_per_side; i <= points_per_side; i++) {
        s.push_back(range * i / points_per_side);
    }
    return s;
}

/// errors[order][i]: relative gain error of the series of that order at s[i].
std::vector<std::vector<double>> series_errors(const GainSeries &g, const ExactGain &exact_gain,
                                               const std::vector<double> &s)
{
    std::vector<std::vector<double>> errors(g.gain.size(), std::vector<double>(s.size()));
    for (std::size_t i = 0; i < s.size(); i++) {
        const MatrixXd exact = exact_gain(solve_sdre_exact(g.problem, {s[i]}).X);
        const double   norm  = std::max(exact.norm(), 1e-300);
        for (std::size_t order = 0; order < g.gain.size(); order++) {
            errors[order][i] = (series_gain(g.gain, s[i], order) - exact).norm() / norm;
        }
    }
    return errors;
}

/// Largest r such that the full series is within series_error_limit at every grid point in +-r.
double usable_range(const std::vector<double> &error, const std::vector<double> &s)
{
    double r = s.back();
    for (std::size_t i = 0; i < s.size(); i++) {
        if (error[i] > series_error_limit) {
            r = std::min(r, std::abs(s[i]));
        }
    }
    const double step = s.back() / points_per_side;
    return (r < s.back()) ? std::max(r - step, step) : r;
}

SampledLoop sweep(const GainSeries &g, double range, double ts, const ExactGain &exact_gain,
                  const Radius &radius_of, const ClosedLoop &closed_loop)
{
    SampledLoop loop;
    loop.range_A                     = range;
    const std::vector<double> s      = grid(range);
    const auto                errors = series_errors(g, exact_gain, s);
    loop.series_range_A              = usable_range(errors.back(), s);
    loop.worst_pole_1ps              = -1e300;
    loop.series_error.assign(g.gain.size(), 0.0);
    loop.series_error_full.assign(g.gain.size(), 0.0);

    for (std::size_t i = 0; i < s.size(); i++) {
        for (std::size_t order = 0; order < g.gain.size(); order++) {
            double &full = loop.series_error_full[order];
            full         = std::max(full, errors[order][i]);
            if (std::abs(s[i]) <= loop.series_range_A) {
                loop.series_error[order] = std::max(loop.series_error[order], errors[order][i]);
            }
        }
        const double   held = std::clamp(s[i], -loop.series_range_A, loop.series_range_A);
        const MatrixXd K    = series_gain(g.gain, held, g.gain.size() - 1);
        for (const auto &pole : closed_loop(K, s[i]).eigenvalues()) {
            loop.worst_pole_1ps  = std::max(loop.worst_pole_1ps, pole.real());
            loop.fastest_pole_ts = std::max(loop.fastest_pole_ts, std::abs(pole) * ts);
        }
        loop.spectral_radius = std::max(loop.spectral_radius, radius_of(K, s[i]));
    }
    return loop;
}

/// Speeds at which the encoder form is checked: standstill to the trip speed, both directions.
std::vector<double> speed_grid(const Design &d)
{
    const double trip = static_cast<double>(trip_speed_ratio) * d.drive.motor.rated_speed_e_radps;
    std::vector<double> w;
    for (int i = -speed_points; i <= speed_points; i++) {
        w.push_back(trip * i / speed_points);
    }
    return w;
}

SampledLoop sweep_nosc(const Design &d)
{
    const double          ts      = control_period_s(d.drive);
    const bool            delayed = d.drive.nodo.form == NodoForm::speed;
    const MatrixXd        B       = nosc_input_matrix(d.l);
    const MatrixXd       &A0      = d.nosc.problem.A0;
    const MatrixXd       &dA      = d.nosc.problem.dA[0];
    const Eigen::Vector2d T_inverse(1.0 / d.drive.nosc.T[0], 1.0 / d.drive.nosc.T[1]);

    const auto exact = [&](const MatrixXd &X) -> MatrixXd {
        return T_inverse.asDiagonal() * B.transpose() * X;
    };
    const auto loop = [&](const MatrixXd &K, double s) -> MatrixXd { return A0 + s * dA - B * K; };
    const auto radius = [&](const MatrixXd &K, double s) { // EQ-CERT-1
        MatrixXd M             = MatrixXd::Zero(5, 5);
        M.topLeftCorner(3, 3)  = (A0 + s * dA) * ts;
        M.topRightCorner(3, 2) = B * ts;
        const MatrixXd E       = M.exp();
        if (!delayed) { // the prediction takes the delay out
            return spectral_radius(E.topLeftCorner(3, 3) - E.topRightCorner(3, 2) * K);
        }
        MatrixXd Z               = MatrixXd::Zero(5, 5);
        Z.topRows(3)             = E.topRows(3);
        Z.bottomLeftCorner(2, 3) = -K;
        return spectral_radius(Z);
    };
    return sweep(d.nosc, certified_range_A(d.drive.motor), ts, exact, radius, loop);
}

SampledLoop sweep_nodo(const Design &d)
{
    const double              ts     = control_period_s(d.drive);
    const ObserverModel       model  = nodo_model(d.l, d.drive.nodo.form);
    const std::vector<double> speeds = speed_grid(d);
    const Eigen::Vector3d     T_inverse(1.0 / d.drive.nodo.T[0], 1.0 / d.drive.nodo.T[1],
                                        1.0 / d.drive.nodo.T[2]);

    const auto exact = [&](const MatrixXd &X) -> MatrixXd {
        return X * model.C.transpose() * T_inverse.asDiagonal();
    };
    const auto loop = [&](const MatrixXd &L, double s) -> MatrixXd {
        return model.A0 + s * model.dA - L * model.C;
    };
    const auto radius = [&](const MatrixXd &L, double s) {
        if (d.drive.nodo.form == NodoForm::speed) { // EQ-CERT-2
            return spectral_radius(MatrixXd::Identity(6, 6) + ts * loop(L, s));
        }
        double worst = 0.0;
        for (const double w : speeds) { // EQ-CERT-3: observer, law and motor at a steady state
            const OperatingPoint at{w, s, mtpa_id_A(d.l, s)};
            const LoopGains      gains{d.nosc.gain[0], L};
            worst = std::max(worst, spectral_radius(sampled_model(d.l, d.l, gains, at, ts).A));
        }
        return worst;
    };
    return sweep(d.nodo, certified_range_A(d.drive.motor), ts, exact, radius, loop);
}

void judge(const char *name, const GainSeries &g, const SampledLoop &loop,
           std::vector<std::string> &failures)
{
    for (std::size_t n = 0; n < g.residuals.size(); n++) {
        if (!(g.residuals[n] <= residual_limit)) {
            failures.push_back(
                fmt::format("{}: relative residual {:.1e} of order {} exceeds {:.0e}", name,
                            g.residuals[n], n, residual_limit));
        }
    }
    if (!(loop.worst_pole_1ps < 0.0)) {
        failures.push_back(fmt::format("{}: unstable in +-{:g} A: a pole at {:+.1f} 1/s", name,
                                       loop.range_A, loop.worst_pole_1ps));
    }
    if (!(loop.spectral_radius < 1.0)) {
        failures.push_back(fmt::format(
            "{}: the sampled loop is unstable in +-{:g} A: spectral radius {:.4f}, fastest "
            "pole times period {:.2f}",
            name, loop.range_A, loop.spectral_radius, loop.fastest_pole_ts));
    }
}

} // namespace

Certificate certify(const Design &design)
{
    Certificate certificate;
    certificate.nosc = sweep_nosc(design);
    certificate.nodo = sweep_nodo(design);
    judge("nosc", design.nosc, certificate.nosc, certificate.failures);
    judge("nodo", design.nodo, certificate.nodo, certificate.failures);
    return certificate;
}

} // namespace sdre
