// SPDX-License-Identifier: MIT
#include "design/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "design/law_design.hpp"
#include "design/noc_shaft/shaft_loop.hpp"
#include "design/position.hpp"
#include "design/sampled_model.hpp"
#include "design/sampled_observer.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

// Chosen: fine enough that neighbouring points differ by under 2 % of the range.
constexpr int points_per_side = 64;
// Chosen: 625 points of a box in two variables, a fifth of a second.
constexpr int box_points_per_side = 12;
constexpr int speed_points        = 4;

// The phase current can pass from -max to +max while the bridge runs, so errors reach twice the
// limit. Beyond twice the limit the firmware trips.
double certified_range_A(const Motor &motor)
{
    return 2.0 * motor.max_current_A;
}

/// The spectral radius of the sampled loop with gain K at the scheduling currents s.
using Radius = std::function<double(const MatrixXd &K, const Schedule &s)>;
/// The poles of the closed loop with gain K at s, as those of a continuous system.
using Poles = std::function<Eigen::VectorXcd(const MatrixXd &K, const Schedule &s)>;

/// Largest r such that the full series is within series_error_limit at every grid point in +-r.
double usable_range(const std::vector<double> &error, const std::vector<Schedule> &s, double range,
                    double step)
{
    double r = range;
    for (std::size_t i = 0; i < s.size(); i++) {
        if (error[i] > series_error_limit) {
            r = std::min(r, reach(s[i]));
        }
    }
    return (r < range) ? std::max(r - step, step) : r;
}

Schedule held(Schedule s, double limit)
{
    for (double &x : s) {
        x = std::clamp(x, -limit, limit);
    }
    return s;
}

SampledLoop sweep(const GainSeries &g, double range, double ts, const Radius &radius_of,
                  const Poles &poles_of)
{
    SampledLoop loop;
    loop.range_A                          = range;
    const std::size_t           variables = g.problem.dA.size();
    const int                   per_side  = variables == 1 ? points_per_side : box_points_per_side;
    const std::vector<Schedule> s         = box_grid(variables, range, per_side);
    const auto errors   = g.held_A ? std::vector<std::vector<double>>{} : series_errors(g, s);
    loop.series_range_A = g.held_A.value_or(0.0);
    if (!g.held_A) {
        loop.series_range_A = usable_range(errors.back(), s, range, range / per_side);
    }
    loop.worst_pole_1ps = -1e300;
    loop.series_error.assign(errors.size(), 0.0);
    loop.series_error_full.assign(errors.size(), 0.0);

    for (std::size_t i = 0; i < s.size(); i++) {
        for (std::size_t order = 0; order < errors.size(); order++) {
            double &full = loop.series_error_full[order];
            full         = std::max(full, errors[order][i]);
            if (reach(s[i]) <= loop.series_range_A) {
                loop.series_error[order] = std::max(loop.series_error[order], errors[order][i]);
            }
        }
        const MatrixXd K = series_gain(g, held(s[i], loop.series_range_A), series_order(g));
        for (const auto &pole : poles_of(K, s[i])) {
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
    const double        trip = trip_speed_e_radps(d.drive);
    std::vector<double> w;
    for (int i = -speed_points; i <= speed_points; i++) {
        w.push_back(trip * i / speed_points);
    }
    return w;
}

/// B the input matrix of the error system that g is solved for.
SampledLoop sweep_controller(const Design &d, const GainSeries &g, const MatrixXd &B)
{
    const double ts      = control_period_s(d.drive);
    const bool   delayed = d.drive.nodo.form != NodoForm::encoder;

    const auto poles = [&](const MatrixXd &K, const Schedule &s) {
        return eigenvalues(state_matrix(g.problem, s) - B * K);
    };
    const auto radius = [&](const MatrixXd &K, const Schedule &s) { // EQ-CERT-1
        const auto E = c2d(state_matrix(g.problem, s), B, ts);
        if (!delayed) { // the prediction takes the delay out
            return spectral_radius(E.Phi - E.Gamma * K);
        }
        const Eigen::Index n     = B.rows();
        MatrixXd           Z     = MatrixXd::Zero(n + 2, n + 2);
        Z.topLeftCorner(n, n)    = E.Phi;
        Z.topRightCorner(n, 2)   = E.Gamma;
        Z.bottomLeftCorner(2, n) = -K;
        return spectral_radius(Z);
    };
    return sweep(g, certified_range_A(d.drive.motor), ts, radius, poles);
}

SampledLoop sweep_nodo(const Design &d)
{
    const double              ts      = control_period_s(d.drive);
    const bool                encoder = d.drive.nodo.form == NodoForm::encoder;
    const bool                shaft   = law_design(d.drive).shaft_states;
    const ObserverModel       model   = shaft ? shaft_observer_model(d.l, believed_shaft(d.drive))
                                              : nodo_model(d.l, d.drive.nodo.form);
    const MatrixXd           &C       = model.C;
    const MatrixXd            I       = MatrixXd::Identity(C.cols(), C.cols());
    const std::vector<double> speeds  = speed_grid(d);

    const auto loop = [&](const MatrixXd &L, const Schedule &s) -> MatrixXd {
        return state_matrix(d.nodo.problem, s).transpose() - L * C;
    };
    const auto poles = [&](const MatrixXd &L, const Schedule &s) {
        return encoder ? encoder_form_poles(model, L, s[0], ts) : eigenvalues(loop(L, s));
    };
    const auto radius = [&](const MatrixXd &L, const Schedule &s) {
        if (!encoder) { // EQ-CERT-2
            return spectral_radius(I + ts * loop(L, s));
        }
        double worst = 0.0;
        for (const double w : speeds) { // EQ-CERT-3: observer, law and motor at a steady state
            const OperatingPoint at{w, s[0], mtpa_id_A(d.l, s[0])};
            const LoopGains      gains{d.nosc.gain[0], L};
            const SampledModel   m =
                shaft ? sampled_shaft_model(d, d.l, believed_shaft(d.drive), at, gains)
                        : sampled_model(d.l, d.l, gains, at, ts);
            worst = std::max(worst, spectral_radius(m.A));
        }
        return worst;
    };
    return sweep(d.nodo, certified_range_A(d.drive.motor), ts, radius, poles);
}

/// "2", or "1,0" in two variables.
std::string term_name(const GainSeries &g, std::size_t n)
{
    return fmt::format("{}", fmt::join(g.series.terms[n].powers, ","));
}

/// `sampled` names the matrix of the spectral radius.
void judge(const char *name, const char *sampled, const GainSeries &g, const SampledLoop &loop,
           std::vector<std::string> &failures)
{
    for (std::size_t n = 0; n < g.residuals.size(); n++) {
        if (!(g.residuals[n] <= residual_limit)) {
            failures.push_back(
                fmt::format("{}: relative residual {:.1e} of order {} exceeds {:.0e}", name,
                            g.residuals[n], term_name(g, n), residual_limit));
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
            sampled, loop.range_A, loop.spectral_radius, loop.fastest_pole_ts));
    }
}

} // namespace

void certify_loop(Design &d, const LoopFamily &family, const std::vector<TripMargin> &trips)
{
    d.certificate.loop        = examine(family, d.drive);
    d.certificate.loop->trips = trips;
    if (d.harmonics) {
        d.certificate.loop->slowest_mode_s = learning_mode_s;
    }
    judge(*d.certificate.loop, control_period_s(d.drive), d.certificate.failures);
}

std::string verdict_words(const Design &d)
{
    if (d.certificate.passed()) {
        return "certified";
    }
    return d.drive.reproduces.empty() ? "not certified"
                                      : "not certified, faithful to " + d.drive.reproduces;
}

std::string verdict_lines(const Verdict &v)
{
    std::string s;
    for (const Channel &c : v.channels) {
        s += fmt::format(" * checked    {:<11} sensitivity peak {:.3g} at {:.0f} Hz, sampled "
                         "spectral radius {:.4f}\n",
                         c.name + ":", c.worst.peak, c.worst.peak_Hz, c.worst.spectral_radius);
    }
    if (v.box) {
        s += fmt::format(" *            motors:     stable in {:.2f} of EQ-CERT-5's box\n",
                         v.box->share);
    }
    return v.shaft ? s + fmt::format(" *            shaft:      {}\n", shaft_words(*v.shaft)) : s;
}

void certify(Design &design)
{
    Certificate &certificate = design.certificate;
    certificate              = {};
    MatrixXd B               = MatrixXd::Zero(design.nosc.problem.A0.rows(), 2);
    B.topRows(3)             = nosc_input_matrix(design.l); // the states of a shaft have no input
    certificate.nosc         = sweep_controller(design, design.nosc, B);
    judge("nosc", "nosc", design.nosc, certificate.nosc, certificate.failures);
    if (design.position) {
        certificate.position =
            sweep_controller(design, *design.position, position_input_matrix(design.l));
        judge("position", "position", *design.position, *certificate.position,
              certificate.failures);
    }
    if (!law_design(design.drive).own_observer) {
        certificate.nodo = sweep_nodo(design);
        const bool whole = design.drive.nodo.form == NodoForm::encoder; // EQ-CERT-3, else EQ-CERT-2
        judge("nodo", whole ? "nosc, nodo and motor" : "nodo", design.nodo, certificate.nodo,
              certificate.failures);
    }
}

} // namespace sdre
