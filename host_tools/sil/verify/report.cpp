// SPDX-License-Identifier: MIT
#include "sil/verify/report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/json.hpp"

namespace sdre {
namespace {

/// A value of the drive file and how well it is known.
struct Value {
    const char *key;
    const char *unit;
    double      believed;
    double      uncertainty;
    const char *next; ///< what to do when it is another
};

std::array<Value, believed_count> values_of(const Drive &d)
{
    const Motor       &m    = d.motor;
    const Uncertainty &u    = d.uncertainty;
    const double       ld   = m.d_axis_inductance_H;
    const double       lq   = m.q_axis_inductance_H;
    const double       own  = d.encoder.disc.own_rms_cnt;
    const double       dead = d.inverter.dead_time_s;
    const double       r    = m.stator_resistance_Ohm;
    const char        *commission =
        "`sdre-drive commission` finds it; then `sdre-gains from-commissioning`";
    return {{{"inertia", "kg m2", m.inertia_kgm2, m.inertia_kgm2 * u.inertia,
              "add what is coupled to the shaft, or `sdre-drive commission`"},
             {"pm_flux", "Wb", m.pm_flux_Wb, m.pm_flux_Wb * u.pm_flux, commission},
             {"d_inductance", "H", ld, ld * u.inductance, commission},
             {"q_inductance", "H", lq, lq * u.inductance, commission},
             {"resistance", "Ohm", r, r * u.resistance,
              "a cold or hot winding, a long cable; `sdre-drive commission` finds it"},
             {"friction", "N m", 0.0, m.rated_torque_Nm * u.friction,
              "bearings, seals, a brake that drags"},
             {"angle", "rad electrical", 0.0, u.angle_e_rad, "align again: docs/bring-up.md"},
             {"dead_time", "s", dead, dead * u.dead_time,
              "the gate driver's own delay belongs to it: docs/hardware.md"},
             {"disc", "counts rms", own, u.disc_own_cnt,
              "a dirty or decentred disc; or state its errors in [encoder.disc]"}}};
}

double physical(const Value &v, double difference)
{
    return v.believed + v.uncertainty * difference;
}

bool is_outside(const Judgement &j, std::size_t n)
{
    return j.figures[n] > j.hi[n] || (n != believed_count && j.figures[n] < j.lo[n]);
}

/// A change of twice the uncertainty would stay inside.
bool is_hidden(const Judgement &j, std::size_t n)
{
    return j.hi[n] >= 2.0;
}

std::string rows(const Drive &d, const Judgement &j)
{
    std::string text =
        fmt::format("{:<16}{:>12}{:>12}   {:<26}\n", "", "drive file", "found", "allowed");
    const auto values = values_of(d);
    for (std::size_t n = 0; n < believed_count; n++) {
        const Value      &v = values[n];
        const std::string allowed =
            fmt::format("{:.4g} .. {:.4g} {}", physical(v, j.lo[n]), physical(v, j.hi[n]), v.unit);
        text += fmt::format("{:<16}{:>12.4g}{:>12.4g}   {:<40}{}\n",
                            believed_name(static_cast<Believed>(n)), v.believed,
                            physical(v, j.figures[n]), allowed,
                            is_outside(j, n)  ? "OUTSIDE"
                            : is_hidden(j, n) ? "hardly seen"
                                              : "within");
    }
    const double most = std::exp(j.hi[believed_count]);
    return text + fmt::format("{:<16}{:>12}{:>12.3g}   {:<40}{}\n", "what is left", "",
                              std::exp(j.figures[believed_count]),
                              fmt::format("up to {:.3g}", most),
                              is_outside(j, believed_count) ? "OUTSIDE" : "within");
}

std::string verdict(const Drive &d, const Judgement &j)
{
    if (j.within()) {
        return "within: this machine behaves as its drive file says\n";
    }
    const char *const else_where =
        "a load on the shaft, an elastic coupling, cogging, saturated iron, another board?";
    if (j.cause == believed_count) {
        return fmt::format("OUTSIDE: no value of the drive file explains it: {}\n", else_where);
    }
    const Value       v    = values_of(d)[j.cause];
    const double      x    = j.figures[j.cause];
    const std::string rest = is_outside(j, believed_count)
                                 ? fmt::format("it does not explain all: {}\n", else_where)
                                 : "";
    return fmt::format("OUTSIDE: {} explains most of it: {:.4g} {} instead of {:.4g}, {:.1f} x its "
                       "stated uncertainty\n{}next: {}\n",
                       believed_name(static_cast<Believed>(j.cause)), physical(v, x), v.unit,
                       v.believed, std::abs(x), rest, v.next);
}

} // namespace

std::string judgement_text(const Drive &d, const Judgement &j)
{
    if (j.fault) {
        return fmt::format("{}: OUTSIDE: the drive has tripped: {}\n"
                           "next: docs/troubleshooting.md\n",
                           d.name, *j.fault);
    }
    return fmt::format(
        "{}: what a machine as its drive file says shows, and what this one does\n{}{}", d.name,
        rows(d, j), verdict(d, j));
}

std::string judgement_json(const Drive &d, const Judgement &j)
{
    Json figures = Json::object();
    if (!j.fault) {
        const auto values = values_of(d);
        for (std::size_t n = 0; n < believed_count; n++) {
            const Value &v = values[n];
            figures[v.key] = {{"unit", v.unit},
                              {"believed", v.believed},
                              {"found", physical(v, j.figures[n])},
                              {"least", physical(v, j.lo[n])},
                              {"most", physical(v, j.hi[n])},
                              {"within", !is_outside(j, n)},
                              {"hardly_seen", is_hidden(j, n)}};
        }
        figures["rest"] = {{"found", std::exp(j.figures.back())},
                           {"most", std::exp(j.hi.back())},
                           {"within", !is_outside(j, believed_count)}};
    }
    const bool known = !j.fault && !j.within() && j.cause < believed_count;
    return Json{{"drive", d.name},
                {"digest", drive_digest(d)},
                {"within", j.within()},
                {"fault", j.fault},
                {"cause", known ? Json(values_of(d)[j.cause].key) : Json()},
                {"figures", figures}}
        .text();
}

} // namespace sdre
