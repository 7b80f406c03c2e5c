// SPDX-License-Identifier: MIT
#include "drive/saturation_section.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "drive/drive_file.hpp"

namespace sdre {
namespace {

constexpr Range current_A{-1e4, 1e4};
constexpr Range inductance_H{1e-7, 10.0};
constexpr Range flux_Wb{-20.0, 20.0};
// Chosen: three points have a curvature; 33 sample the knee of any iron.
constexpr std::size_t least_points = 3;
constexpr std::size_t most_points  = 33;
// Chosen: a grid of the published machines is within 0.02 of sqrt(Ld Lq); a cross term of the wrong sign is beyond 0.1.
constexpr double reciprocity_share = 0.08;
// Chosen: of the largest q flux, what a table may have without q current.
constexpr double zero_share = 0.01;
// Chosen: a magnet between two temperatures and two sources of its flux.
constexpr double magnet_ratio = 1.3;
// Chosen: the slopes of a cubic piece are looked at in its corners and in its middle.
constexpr double half = 0.5;

std::vector<double> read_axis(TomlReader &t, const char *key)
{
    std::vector<std::size_t> lengths;
    for (std::size_t n = least_points; n <= most_points; n++) {
        lengths.push_back(n);
    }
    const std::vector<double> axis = t.numbers(key, lengths, current_A);
    for (std::size_t i = 1; i < axis.size(); i++) {
        if (axis[i] <= axis[i - 1]) {
            t.fail(key, fmt::format("= [.. {:g}, {:g} ..] is not allowed: must increase",
                                    axis[i - 1], axis[i]));
        }
    }
    return axis;
}

/// The grid has all currents within the limit; the machine generates as it motors.
void require_limit_inside(const TomlReader &t, const std::vector<double> &id_A,
                          const std::vector<double> &iq_A, double limit_A)
{
    if (iq_A.front() != 0.0) {
        t.fail("iq_A", fmt::format("begins with {:g}, which is not allowed: must begin with 0; "
                                   "negative q currents are the mirror image",
                                   iq_A.front()));
    }
    if (iq_A.back() < limit_A) {
        t.fail("iq_A", fmt::format("ends with {:g}, which is not allowed: must reach [motor] "
                                   "max_current_A = {:g}",
                                   iq_A.back(), limit_A));
    }
    if (id_A.front() > -limit_A || id_A.back() < 0.0) {
        t.fail("id_A", fmt::format("= {:g} .. {:g} is not allowed: must reach from -{:g}, the "
                                   "current limit, to 0",
                                   id_A.front(), id_A.back(), limit_A));
    }
}

struct Tables {
    std::vector<double> psi_d_Wb;
    std::vector<double> psi_q_Wb;
    const char         *d_key;
    const char         *q_key;
};

Tables read_fluxes(TomlReader &t, const std::vector<double> &iq_A, std::size_t cells)
{
    Tables f{t.numbers("psi_d_Wb", {cells}, flux_Wb), t.numbers("psi_q_Wb", {cells}, flux_Wb),
             "psi_d_Wb", "psi_q_Wb"};
    double most = 0.0;
    for (const double x : f.psi_q_Wb) {
        most = std::max(most, std::abs(x));
    }
    for (std::size_t row = 0; row < cells; row += iq_A.size()) {
        if (std::abs(f.psi_q_Wb[row]) > zero_share * most) {
            t.fail("psi_q_Wb",
                   fmt::format("[{}] = {:g} is not allowed: must be 0 without q current", row,
                               f.psi_q_Wb[row]));
        }
    }
    return f;
}

Tables read_inductances(TomlReader &t, const std::vector<double> &id_A,
                        const std::vector<double> &iq_A, double magnet_Wb)
{
    const std::size_t cells = id_A.size() * iq_A.size();
    Tables f{t.numbers("ld_H", {cells}, inductance_H), t.numbers("lq_H", {cells}, inductance_H),
             "ld_H", "lq_H"};
    for (std::size_t k = 0; k < cells; k++) {
        f.psi_d_Wb[k] = magnet_Wb + f.psi_d_Wb[k] * id_A[k / iq_A.size()];
        f.psi_q_Wb[k] *= iq_A[k % iq_A.size()];
    }
    return f;
}

/// A flux linkage rises with its own current, and the iron's energy has a minimum.
void require_rise(const TomlReader &t, const FluxMap &map, const Tables &keys, double id_A,
                  double iq_A)
{
    const FluxAt f  = map.at(id_A, iq_A);
    const auto   at = fmt::format("at id = {:g} A, iq = {:g} A", id_A, iq_A);
    if (!(f.dd_H > 0.0)) {
        t.fail(keys.d_key, fmt::format("is not allowed: {} the d flux does not rise with id; rows "
                                       "and columns exchanged, or an outlier?",
                                       at));
    }
    if (!(f.qq_H > 0.0)) {
        t.fail(keys.q_key, fmt::format("is not allowed: {} the q flux does not rise with iq; rows "
                                       "and columns exchanged, or an outlier?",
                                       at));
    }
    if (!(f.dd_H * f.qq_H > f.dq_H * f.qd_H)) {
        t.fail(keys.d_key, fmt::format("is not allowed with {}: {} the axes are coupled more than "
                                       "iron can couple them",
                                       keys.q_key, at));
    }
}

/// EQ-SATURATION-2, at a point of the grid.
void require_reciprocity(const TomlReader &t, const FluxMap &map, const Tables &keys, double id_A,
                         double iq_A)
{
    const FluxAt f     = map.at(id_A, iq_A);
    const double share = std::abs(f.dq_H - f.qd_H) / std::sqrt(f.dd_H * f.qq_H);
    if (!(share <= reciprocity_share)) {
        t.fail(keys.q_key,
               fmt::format("does not fit {}: at id = {:g} A, iq = {:g} A d psi_d / d iq = {:.3g} H "
                           "and d psi_q / d id = {:.3g} H; must agree within {:.3g} H",
                           keys.d_key, id_A, iq_A, f.dq_H, f.qd_H,
                           reciprocity_share * std::sqrt(f.dd_H * f.qq_H)));
    }
}

void require_iron(const TomlReader &t, const FluxMap &map, const Tables &keys)
{
    const std::vector<double> &d = map.id_A();
    const std::vector<double> &q = map.iq_A();
    for (std::size_t i = 0; i < d.size(); i++) {
        for (std::size_t j = 0; j < q.size(); j++) {
            require_rise(t, map, keys, d[i], q[j]);
            if (i + 1 < d.size() && j + 1 < q.size()) {
                require_rise(t, map, keys, half * (d[i] + d[i + 1]), half * (q[j] + q[j + 1]));
            }
        }
    }
    for (const double id_A : d) {
        for (const double iq_A : q) {
            require_reciprocity(t, map, keys, id_A, iq_A);
        }
    }
}

void require_magnet(const TomlReader &t, const FluxMap &map, const Motor &motor)
{
    const double given = motor.pm_flux_Wb;
    const double has   = map.magnet_Wb();
    if (has < 0.0 || (given > 0.0 && std::max(given, has) > magnet_ratio * std::min(given, has))) {
        t.fail("psi_d_Wb", fmt::format("is {:.4g} without current, which is not allowed: must be "
                                       "near [motor] pm_flux_Wb = {:g}",
                                       has, given));
    }
}

} // namespace

std::shared_ptr<const FluxMap> read_saturation(std::optional<TomlReader> t, const Motor &motor)
{
    if (!t) {
        return nullptr;
    }
    const std::vector<double> id_A = read_axis(*t, "id_A");
    const std::vector<double> iq_A = read_axis(*t, "iq_A");
    require_limit_inside(*t, id_A, iq_A, motor.max_current_A);
    const bool inductances = t->has("ld_H") || t->has("lq_H");
    if (inductances && (t->has("psi_d_Wb") || t->has("psi_q_Wb"))) {
        t->fail("ld_H", "is not allowed beside psi_d_Wb: give fluxes or inductances");
    }
    const Tables f = inductances ? read_inductances(*t, id_A, iq_A, motor.pm_flux_Wb)
                                 : read_fluxes(*t, iq_A, id_A.size() * iq_A.size());
    t->reject_unknown_keys();
    auto map = std::make_shared<const FluxMap>(id_A, iq_A, f.psi_d_Wb, f.psi_q_Wb);
    require_iron(*t, *map, f);
    require_magnet(*t, *map, motor);
    return map;
}

} // namespace sdre
