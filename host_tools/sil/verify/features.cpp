// SPDX-License-Identifier: MIT
#include "sil/verify/features.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "design/motor_model.hpp"

namespace sdre {
namespace {

// Chosen: 6.4 ms at 5 kHz average the edges of the disc, and a step has several.
constexpr std::size_t block = 32;
// A voltage acts from the next sample on. Speed and currents of the scope belong to that instant, of laws that predict
// them.
constexpr std::size_t lag = 1;

using Samples = std::vector<double>;

double mean(const Samples &x, std::size_t from, std::size_t to)
{
    return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(from),
                           x.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
           static_cast<double>(to - from);
}

double log_deviation(const Samples &x)
{
    const double m   = mean(x, 0, x.size());
    double       sum = 0.0;
    for (const double value : x) {
        sum += (value - m) * (value - m);
    }
    return 0.5 * std::log(sum / static_cast<double>(x.size()) + 1e-12);
}

/// Speed, currents and one voltage of a record.
struct Signals {
    Samples omega_e_radps;
    Samples iq_A;
    Samples id_A;
    Samples v_V;
    bool    is_d;
};

class Blocks {
public:
    Blocks(const Drive &drive, double period_s, std::vector<double> &out)
        : motor_(drive.motor), period_s_(period_s), out_(out)
    {
    }

    void add(const Signals &s, bool with_torque) const
    {
        for (std::size_t from = lag; from + block < s.v_V.size(); from += block) {
            out_.push_back(voltage(s, from));
            if (with_torque) {
                out_.push_back(torque(s, from));
            }
        }
    }

private:
    double slope(const Samples &x, std::size_t from) const
    {
        return (x[from + block] - x[from]) / (static_cast<double>(block) * period_s_);
    }

    template <typename Value> static double mean_of(std::size_t from, const Value &value)
    {
        double sum = 0.5 * (value(from) + value(from + block));
        for (std::size_t k = from + 1; k < from + block; k++) {
            sum += value(k);
        }
        return sum / static_cast<double>(block);
    }

    double voltage(const Signals &s, std::size_t from) const
    {
        const Motor &m = motor_;
        const double v = mean(s.v_V, from - lag, from - lag + block);
        if (s.is_d) {
            return v - m.d_axis_inductance_H * slope(s.id_A, from) -
                   mean_of(from, [&](std::size_t k) {
                       return m.stator_resistance_Ohm * s.id_A[k] -
                              s.omega_e_radps[k] * m.q_axis_inductance_H * s.iq_A[k];
                   });
        }
        return v - m.q_axis_inductance_H * slope(s.iq_A, from) - mean_of(from, [&](std::size_t k) {
                   return m.stator_resistance_Ohm * s.iq_A[k] +
                          s.omega_e_radps[k] * (m.d_axis_inductance_H * s.id_A[k] + m.pm_flux_Wb);
               });
    }

    double torque(const Signals &s, std::size_t from) const
    {
        const double pairs = motor_.pole_pairs;
        return mean_of(from,
                       [&](std::size_t k) {
                           return torque_Nm(motor_, s.id_A[k], s.iq_A[k]) -
                                  motor_.viscous_friction_Nms * s.omega_e_radps[k] / pairs;
                       }) -
               motor_.inertia_kgm2 / pairs * slope(s.omega_e_radps, from);
    }

    const Motor         &motor_;
    double               period_s_;
    std::vector<double> &out_;
};

void add_steady(const Blocks &blocks, const Shot &shot, const Record &r, std::vector<double> &out)
{
    const Samples omega(r.values[0].size(), shot.from_e_radps);
    blocks.add({omega, r.values[0], r.values[1], r.values[2], false}, true);
    blocks.add({omega, r.values[0], r.values[1], r.values[3], true}, false);
    for (const Samples &x : r.values) {
        out.push_back(log_deviation(x));
    }
}

void add_moving(const Blocks &blocks, const Shot &shot, const Record &r, std::vector<double> &out)
{
    const Samples &omega = r.values[0];
    blocks.add({omega, r.values[1], r.values[2], r.values[3], shot.signals[3] == "VD"}, true);
    const bool   up   = shot.to_e_radps > shot.from_e_radps;
    const double most = up ? *std::max_element(omega.begin(), omega.end())
                           : *std::min_element(omega.begin(), omega.end());
    out.push_back(most - shot.to_e_radps);
}

} // namespace

Eigen::VectorXd features_of(const Drive &d, const Programme &p, const Records &records)
{
    std::vector<double> out;
    const Blocks        blocks(d, p.period_s, out);
    for (std::size_t k = 0; k < p.shots.size(); k++) {
        const Shot &shot = p.shots[k];
        (shot.steady() ? add_steady : add_moving)(blocks, shot, records.shots[k], out);
    }
    return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

} // namespace sdre
