// SPDX-License-Identifier: MIT
#include "drive/mtpa_fit.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

constexpr double golden_section = 0.6180339887498949;
constexpr int    halvings       = 45; // of an interval: to a billionth
// Chosen: 16 currents from a sixteenth of the limit on.
constexpr int points = 16;
// Chosen: below, a drive has little copper loss to save.
constexpr double least_torque = 0.25; // of the rated one
// Chosen: k from a thousandth of the limit (45 degrees) to twenty times it (no d current), 18 % apart.
constexpr double least_k = 1e-3;
constexpr double most_k  = 20.0;
constexpr int    k_steps = 60;
// The angle of the current from the q axis. A machine without a magnet and with little saliency stays below.
constexpr double most_angle_rad = 1.45;

constexpr double steps_per_current = 20.0;
constexpr double most_excess       = 2.0; // of the least current: no curve to choose takes as much

/// Where f is least in an interval in which it falls, then rises.
template <typename F> double least(double lo, double hi, const F &f)
{
    double a  = hi - golden_section * (hi - lo);
    double b  = lo + golden_section * (hi - lo);
    double fa = f(a);
    double fb = f(b);
    for (int i = 0; i < halvings; i++) {
        if (fa < fb) {
            hi = b;
            b  = a;
            fb = fa;
            a  = hi - golden_section * (hi - lo);
            fa = f(a);
        } else {
            lo = a;
            a  = b;
            fa = fb;
            b  = lo + golden_section * (hi - lo);
            fb = f(b);
        }
    }
    return 0.5 * (lo + hi);
}

MtpaPoint at_angle(const FluxMap &map, int pole_pairs, double current_A, double angle_rad)
{
    const double id_A = -current_A * std::sin(angle_rad);
    const double iq_A = current_A * std::cos(angle_rad);
    return {current_A, id_A, iq_A, torque_Nm(pole_pairs, map.at(id_A, iq_A), id_A, iq_A)};
}

std::vector<MtpaPoint> loaded_points(const FluxMap &map, const Motor &m)
{
    std::vector<MtpaPoint> all;
    for (int i = 1; i <= points; i++) {
        all.push_back(most_torque(map, m.pole_pairs, m.max_current_A * i / points));
    }
    const double from = std::min(least_torque * m.rated_torque_Nm, all.back().torque_Nm);
    all.erase(all.begin(), std::find_if(all.begin(), all.end(), [from](const MtpaPoint &p) {
                  return p.torque_Nm >= from;
              }));
    return all;
}

double largest_of(const FluxMap &map, const Motor &m, const std::vector<MtpaPoint> &at,
                  const MtpaCurve &curve)
{
    double most = 0.0;
    for (const MtpaPoint &p : at) {
        most = std::max(most, excess_current(map, m.pole_pairs, curve, p));
    }
    return most;
}

struct Fitted {
    MtpaCurve curve;
    double    excess;
};

Fitted fit(const FluxMap &map, const Motor &m, const std::vector<MtpaPoint> &at, bool second_order)
{
    const auto curve = [&](double log_k) {
        return MtpaCurve{std::exp(log_k) * m.max_current_A, second_order};
    };
    const auto   excess      = [&](double log_k) { return largest_of(map, m, at, curve(log_k)); };
    const double step        = std::log(most_k / least_k) / k_steps;
    double       best        = std::log(least_k);
    double       least_found = excess(best);
    for (int i = 1; i <= k_steps; i++) {
        const double log_k = std::log(least_k) + i * step;
        const double found = excess(log_k);
        if (found < least_found) {
            best        = log_k;
            least_found = found;
        }
    }
    const double fine = least(best - step, best + step, excess);
    return {curve(fine), excess(fine)};
}

} // namespace

double torque_Nm(int pole_pairs, const FluxAt &f, double id_A, double iq_A)
{
    return 1.5 * pole_pairs * (f.d_Wb * iq_A - f.q_Wb * id_A);
}

MtpaPoint most_torque(const FluxMap &map, int pole_pairs, double current_A)
{
    const double angle = least(0.0, most_angle_rad, [&](double x) {
        return -at_angle(map, pole_pairs, current_A, x).torque_Nm;
    });
    return at_angle(map, pole_pairs, current_A, angle);
}

double curve_id_A(const MtpaCurve &curve, double iq_A)
{
    const double square = iq_A * iq_A;
    return curve.second_order ? -0.5 * square / curve.k_A
                              : -square / (curve.k_A + std::hypot(curve.k_A, iq_A));
}

double excess_current(const FluxMap &map, int pole_pairs, const MtpaCurve &curve,
                      const MtpaPoint &at)
{
    const auto reaches = [&](double iq_A) {
        const double id_A = curve_id_A(curve, iq_A);
        return torque_Nm(pole_pairs, map.at(id_A, iq_A), id_A, iq_A) >= at.torque_Nm;
    };
    const double step = at.current_A / steps_per_current;
    double       hi   = step; // the torque of a curve may fall again, so the first place counts
    while (!reaches(hi) && hi < most_excess * at.current_A) {
        hi += step;
    }
    double lo = hi - step;
    for (int i = 0; i < halvings; i++) {
        const double iq_A         = 0.5 * (lo + hi);
        (reaches(iq_A) ? hi : lo) = iq_A;
    }
    return std::hypot(hi, curve_id_A(curve, hi)) / at.current_A - 1.0;
}

MtpaPoint least_current(const FluxMap &map, int pole_pairs, double torque, double most_A)
{
    double lo = 0.0;
    double hi = most_A;
    for (int i = 0; i < halvings; i++) {
        const double r                                                 = 0.5 * (lo + hi);
        (most_torque(map, pole_pairs, r).torque_Nm < torque ? lo : hi) = r;
    }
    return most_torque(map, pole_pairs, hi);
}

double largest_excess(const FluxMap &map, const Motor &motor, const MtpaCurve &curve)
{
    return largest_of(map, motor, loaded_points(map, motor), curve);
}

MtpaCurve fit_mtpa(const FluxMap &map, const Motor &motor, MtpaForms forms)
{
    const std::vector<MtpaPoint> at = loaded_points(map, motor);
    if (forms != MtpaForms::both) {
        return fit(map, motor, at, forms == MtpaForms::second_order).curve;
    }
    const Fitted exact  = fit(map, motor, at, false);
    const Fitted second = fit(map, motor, at, true);
    return second.excess < exact.excess ? second.curve : exact.curve;
}

} // namespace sdre
