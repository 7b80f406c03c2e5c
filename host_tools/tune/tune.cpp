// SPDX-License-Identifier: MIT
#include "tune/tune.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/firmware_config.hpp"
#include "design/sampled_model.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double pi           = 3.14159265358979323846;
constexpr double horizon_s    = 0.06; // chosen: several times the settling times of interest
constexpr int    search_steps = 400;  // chosen: the simplex has shrunk below 1 % by then
constexpr int restarts = 3; // chosen: a fresh simplex around the best point escapes a collapsed one

/// The searched weights as base-10 logarithms.
enum Variable {
    speed_error,
    q_axis_error,
    load_drift,
    voltage_drift,
    speed_noise,
    current_noise,
    variables
};
using Point = std::array<double, variables>;

/// Chosen: in the middle of the region in which the shipped motors are stable.
constexpr Point  start{{0.3, 0.9, 9.0, 7.0, 2.0, 1.0}};
constexpr double start_step = 0.5; // decades

struct Sensors {
    double current_A; ///< standard deviation, noise and quantisation
    double angle_rad; ///< of the quantisation
};

Sensors sensors_of(const Drive &drive, const TuneSpec &spec)
{
    const double count_rad = 2.0 * pi * drive.motor.pole_pairs / (4.0 * drive.encoder.lines);
    return {std::hypot(spec.current_noise_A, spec.current_lsb_A / std::sqrt(12.0)),
            count_rad / std::sqrt(12.0)};
}

Drive with_weights(Drive drive, const TuneSpec &spec, const Point &x)
{
    const double  ts        = control_period_s(drive);
    const Sensors sensors   = sensors_of(drive, spec);
    const double  t_voltage = 1.0 / (spec.voltage_V * spec.voltage_V);
    const auto value = [&](Variable v) { return std::pow(10.0, x[static_cast<std::size_t>(v)]); };

    drive.nosc.T    = {t_voltage, t_voltage};
    drive.nosc.Q    = {value(speed_error) * 1e3 * t_voltage, value(q_axis_error) * 1e3 * t_voltage,
                       1.0 / (spec.d_axis_error_A * spec.d_axis_error_A)};
    drive.nodo.form = NodoForm::encoder;
    // A sampled sensor with standard deviation s is white noise of density s^2 Ts.
    drive.nodo.T = {sensors.current_A * sensors.current_A * ts,
                    sensors.current_A * sensors.current_A * ts,
                    sensors.angle_rad * sensors.angle_rad * ts};
    drive.nodo.Q = {value(load_drift),
                    value(voltage_drift),
                    value(voltage_drift),
                    value(speed_noise),
                    value(current_noise),
                    value(current_noise),
                    0.0};
    return drive;
}

Motor believed_motor(Motor m, const RobustnessCase &c)
{
    m.inertia_kgm2 *= c.mechanical;
    m.viscous_friction_Nms *= c.mechanical;
    m.stator_resistance_Ohm *= c.electrical;
    m.d_axis_inductance_H *= c.electrical;
    m.q_axis_inductance_H *= c.electrical;
    m.pm_flux_Wb *= c.electrical;
    return m;
}

/// The steady operating point that carries a load torque on the MTPA curve.
OperatingPoint operating_point(const ReducedParameters &l, double speed, double load_Nm)
{
    OperatingPoint at{speed, 0.0, 0.0};
    for (int i = 0; i < 50; i++) { // contraction factor below 0.5
        at.iq_A = (l[2] * speed + l[3] * load_Nm) / (l[1] + l[11] * at.id_A);
        at.id_A = mtpa_id_A(l, at.iq_A);
    }
    return at;
}

/// Covariance of x+ = A x + B n with the given noise variances, by doubling.
MatrixXd covariance(MatrixXd A, const MatrixXd &B, const VectorXd &variances)
{
    MatrixXd P = B * variances.asDiagonal() * B.transpose();
    for (int i = 0; i < 30 && A.norm() > 1e-12; i++) {
        P = P + A * P * A.transpose();
        A = A * A;
    }
    return P;
}

void load_step(const SampledModel &m, const TuneSpec &spec, CaseResult &result)
{
    VectorXd  x     = VectorXd::Zero(m.A.rows());
    const int steps = static_cast<int>(horizon_s / m.ts_s);
    for (int k = 1; k <= steps; k++) {
        x                  = m.A * x + m.b_load * spec.load_step_Nm;
        result.dip_e_radps = std::max(result.dip_e_radps, std::abs(x(0)));
        result.voltage_V   = std::max(result.voltage_V, (m.C_voltage * x).norm());
        if (!(std::abs(x(0)) <= spec.band_e_radps)) {
            result.settling_time_s = k * m.ts_s;
        }
    }
}

CaseResult evaluate_case(const Drive &drive, const TuneSpec &spec, const RobustnessCase &c)
{
    const double            ts      = control_period_s(drive);
    const ReducedParameters l       = reduced_parameters(drive.motor);
    const ReducedParameters lc      = reduced_parameters(believed_motor(drive.motor, c));
    const Sensors           sensors = sensors_of(drive, spec);
    const Eigen::Vector2d   T_nosc(drive.nosc.T[0], drive.nosc.T[1]);
    const Eigen::Vector3d   T_nodo(drive.nodo.T[0], drive.nodo.T[1], drive.nodo.T[2]);

    const SdreProblem control  = nosc_problem(lc, drive.nosc);
    const SdreProblem observer = nodo_problem(lc, drive.nodo);
    const MatrixXd    X        = solve_care(control.A0, control.G, control.Q).X;
    const MatrixXd    Y        = solve_care(observer.A0, observer.G, observer.Q).X;
    const LoopGains   gains{
        T_nosc.cwiseInverse().asDiagonal() * nosc_input_matrix(lc).transpose() * X,
        Y * nodo_model(lc, NodoForm::encoder).C.transpose() * T_nodo.cwiseInverse().asDiagonal()};

    CaseResult           result;
    const OperatingPoint at =
        operating_point(l, spec.speed_e_radps, spec.load_before_Nm + 0.5 * spec.load_step_Nm);
    const SampledModel m = sampled_model(l, lc, gains, at, ts);
    for (const double speed : {0.0, spec.speed_e_radps, drive.motor.rated_speed_e_radps}) {
        const SampledModel other = sampled_model(l, lc, gains, {speed, at.iq_A, at.id_A}, ts);
        result.spectral_radius   = std::max(result.spectral_radius, spectral_radius(other.A));
    }
    // The certificate asks for stability up to twice the current limit and to the trip speed.
    const double         iq_far = 2.0 * drive.motor.max_current_A;
    const OperatingPoint far{trip_speed_ratio * drive.motor.rated_speed_e_radps, iq_far,
                             mtpa_id_A(l, iq_far)};
    if (c.mechanical == 1.0 && c.electrical == 1.0) {
        const double radius = spectral_radius(sampled_model(l, l, gains, far, ts).A);
        if (!(radius < 1.0)) {
            result.spectral_radius = std::max(1.0, radius);
        }
    }
    if (result.spectral_radius < 1.0) {
        load_step(m, spec, result);
        const double   i2 = sensors.current_A * sensors.current_A;
        const MatrixXd P  = covariance(
             m.A, m.B_noise, Eigen::Vector3d(i2, i2, sensors.angle_rad * sensors.angle_rad));
        const MatrixXd V = m.C_voltage * P * m.C_voltage.transpose();
        result.voltage_V += 3.0 * std::sqrt(V.trace());
        result.ripple_e_radps = 3.0 * std::sqrt(std::max(P(0, 0), 0.0));
    }
    return result;
}

// Far above the ratio of any stable design, so that none looks worse than these.
constexpr double unstable    = 1e9;
constexpr double no_solution = 1e12; ///< of the Riccati equations

/// Largest result / specification of one case; `unstable` and above when the loop is.
double ratio(const CaseResult &r, const RobustnessCase &c, const TuneSpec &spec)
{
    if (!(r.spectral_radius < 1.0)) {
        return unstable * r.spectral_radius;
    }
    return std::max({r.dip_e_radps / c.dip_e_radps, r.settling_time_s / c.settling_time_s,
                     r.ripple_e_radps / c.ripple_e_radps,
                     (1.0 - spec.largest_pole) / (1.0 - r.spectral_radius),
                     r.voltage_V / spec.voltage_headroom_V});
}

struct Score {
    double worst = 0.0; ///< largest ratio
    double value =
        0.0; ///< what is minimised: the worst ratio, and a little of every case's so that none idles
    std::vector<CaseResult> cases;
};

Score score(const Drive &drive, const TuneSpec &spec, const Point &x)
{
    Score       s;
    const Drive candidate = with_weights(drive, spec, x);
    for (const RobustnessCase &c : spec.cases) {
        double r = no_solution;
        try {
            s.cases.push_back(evaluate_case(candidate, spec, c));
            r = ratio(s.cases.back(), c, spec);
        } catch (const DesignError &) {
            s.cases.emplace_back(); // no solution there: stay away
        }
        s.worst = std::max(s.worst, r);
        s.value += 0.1 * r / static_cast<double>(spec.cases.size());
    }
    s.value += s.worst;
    return s;
}

struct Vertex {
    Point  x{};
    double value = 0.0;
};

Point along(const Point &from, const Point &to, double t)
{
    Point p{};
    for (std::size_t i = 0; i < p.size(); i++) {
        p[i] = from[i] + t * (to[i] - from[i]);
    }
    return p;
}

/// Nelder-Mead with the standard coefficients.
template <typename Function> Vertex minimise(const Point &x0, const Function &f)
{
    std::vector<Vertex> simplex{{x0, f(x0)}};
    for (std::size_t i = 0; i < x0.size(); i++) {
        Point x = x0;
        x[i] += start_step;
        simplex.push_back({x, f(x)});
    }
    const auto better = [](const Vertex &a, const Vertex &b) { return a.value < b.value; };
    for (int step = 0; step < search_steps; step++) {
        std::stable_sort(simplex.begin(), simplex.end(), better);
        Vertex &worst = simplex.back();
        Point   centre{};
        for (std::size_t v = 0; v + 1 < simplex.size(); v++) {
            for (std::size_t i = 0; i < centre.size(); i++) {
                centre[i] += simplex[v].x[i] / static_cast<double>(simplex.size() - 1);
            }
        }
        const auto vertex_at = [&](double t) {
            const Point x = along(centre, worst.x, t);
            return Vertex{x, f(x)};
        };
        const Vertex reflected = vertex_at(-1.0);
        if (better(reflected, simplex.front())) {
            const Vertex expanded = vertex_at(-2.0);
            worst                 = better(expanded, reflected) ? expanded : reflected;
        } else if (better(reflected, simplex[simplex.size() - 2])) {
            worst = reflected;
        } else {
            const Vertex contracted = vertex_at(better(reflected, worst) ? -0.5 : 0.5);
            if (better(contracted, worst)) {
                worst = contracted;
                continue;
            }
            for (std::size_t v = 1; v < simplex.size(); v++) {
                simplex[v].x     = along(simplex.front().x, simplex[v].x, 0.5);
                simplex[v].value = f(simplex[v].x);
            }
        }
    }
    return *std::min_element(simplex.begin(), simplex.end(), better);
}

double rounded(double x)
{
    const double scale = std::pow(10.0, std::floor(std::log10(x)) - 2.0);
    return std::round(x / scale) * scale; // three digits say what a search can know
}

} // namespace

TuneResult tune_drive(const Drive &drive, const TuneSpec &spec, const TuneProgress &progress)
{
    TuneResult result;
    double     best = 1e300;
    const auto f    = [&](const Point &x) {
        const Score s = score(drive, spec, x);
        result.evaluations++;
        best = std::min(best, s.worst);
        if (result.evaluations % 100 == 0) {
            progress(result.evaluations, best);
        }
        return s.value;
    };
    Vertex found{start, 0.0};
    for (int i = 0; i < restarts; i++) {
        found = minimise(found.x, f);
    }
    const Score s = score(drive, spec, found.x);
    if (!(s.worst < unstable)) {
        throw DesignError("no stable design found for these specifications");
    }
    result.drive = with_weights(drive, spec, found.x);
    for (double &q : result.drive.nosc.Q) {
        q = rounded(q);
    }
    for (double &q : result.drive.nodo.Q) {
        q = q > 0.0 ? rounded(q) : 0.0;
    }
    for (double &t : result.drive.nodo.T) {
        t = rounded(t);
    }
    result.cases       = s.cases;
    result.worst_ratio = s.worst;
    return result;
}

std::string tuned_sections(const TuneResult &r, const TuneSpec &spec)
{
    const Drive  &d       = r.drive;
    const Sensors sensors = sensors_of(d, spec);
    std::string   s       = fmt::format(
                "# The weights below were found by `sdre-gains tune` ({} evaluations) on the sampled "
                        "closed loop,\n"
                        "# for a load step of {:g} N m at {:g} rad/s. Linear model, believed parameters scaled:\n",
                r.evaluations, spec.load_step_Nm, spec.speed_e_radps);
    for (std::size_t i = 0; i < r.cases.size(); i++) {
        const CaseResult     &c = r.cases[i];
        const RobustnessCase &w = spec.cases[i];
        s += fmt::format("#   J, B x{:g}, R, L, flux x{:g}: dip {:.2f} (wanted {:g}), settled "
                         "{:.1f} ms ({:g}), 3 sigma {:.2f} ({:g}) rad/s, "
                         "{:.0f} V ({:g}), pole {:.3f}\n",
                         w.mechanical, w.electrical, c.dip_e_radps, w.dip_e_radps,
                         1e3 * c.settling_time_s, 1e3 * w.settling_time_s, c.ripple_e_radps,
                         w.ripple_e_radps, c.voltage_V, spec.voltage_headroom_V, c.spectral_radius);
    }
    s += fmt::format("[nosc]\norder = {}\n", d.nosc.order);
    s += fmt::format("Q = [{:.3g}, {:.3g}, {:.3g}] # speed, i_q: searched; i_d: 1 / ({:g} A)^2\n",
                     d.nosc.Q[0], d.nosc.Q[1], d.nosc.Q[2], spec.d_axis_error_A);
    s += fmt::format("T = [{:.3g}, {:.3g}] # v_q, v_d: 1 / ({:g} V)^2\n\n", d.nosc.T[0],
                     d.nosc.T[1], spec.voltage_V);
    s += fmt::format("[nodo]\nform = \"encoder\"\norder = {}\n", d.nodo.order);
    s += fmt::format("# d_w, d_q = d_d (drift of the disturbances), w, i_q = i_d: searched; theta' "
                     "= w is exact: 0\n");
    s += fmt::format("Q = [{:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, 0.0]\n", d.nodo.Q[0],
                     d.nodo.Q[1], d.nodo.Q[2], d.nodo.Q[3], d.nodo.Q[4], d.nodo.Q[5]);
    s += fmt::format("# variance x period of one sample: currents {:.3g} A, angle {:.3g} rad (a "
                     "count / sqrt 12)\n",
                     sensors.current_A, sensors.angle_rad);
    s += fmt::format("T = [{:.3g}, {:.3g}, {:.3g}]\n", d.nodo.T[0], d.nodo.T[1], d.nodo.T[2]);
    return s;
}

namespace {

std::vector<std::string> lines_of(const std::string &text)
{
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        lines.push_back(text.substr(at, end - at));
        at = end;
    }
    return lines;
}

bool starts_with(const std::string &line, const char *prefix)
{
    return line.rfind(prefix, 0) == 0;
}

bool is_tuned_header(const std::string &line)
{
    return starts_with(line, "[nosc]") || starts_with(line, "[nodo]");
}

bool is_old_note(const std::string &line)
{
    return starts_with(line, "# The weights below were found by") ||
           starts_with(line, "# for a load step of") || starts_with(line, "#   J, B x");
}

} // namespace

void require_rewritable(const std::filesystem::path &file, const std::string &text)
{
    for (const char *header : {"[nosc]", "[nodo]"}) {
        const std::vector<std::string> lines = lines_of(text);
        if (std::none_of(lines.begin(), lines.end(),
                         [header](const std::string &line) { return starts_with(line, header); })) {
            throw InputError(fmt::format("{}: {} must stand at the start of a line, so that its "
                                         "weights can be replaced",
                                         file.string(), header));
        }
    }
}

std::string with_sections(const std::string &text, const std::string &sections)
{
    std::string out;
    std::string
         pending; // comments and blank lines that may belong to the section after the tuned ones
    bool skipping = false;
    bool inserted = false;
    for (const std::string &line : lines_of(text)) {
        if (is_old_note(line)) {
            continue;
        }
        if (line[0] == '[') {
            skipping = is_tuned_header(line);
            out += skipping ? "" : pending;
            pending.clear();
        }
        if (skipping && !inserted) {
            out += sections;
            inserted = true;
        }
        if (!skipping) {
            out += line;
        } else if (line[0] == '#' || line[0] == '\n') {
            pending += line;
        } else {
            pending.clear();
        }
    }
    return pending.find('#') == std::string::npos ? out : out + pending;
}

} // namespace sdre
