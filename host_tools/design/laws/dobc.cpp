// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/c_text.hpp"
#include "design/laws/servo.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::cdobc || drive.law == Law::gpiobc || drive.law == Law::hdobc;
}

/// The design's speeds are mechanical, the firmware's electrical.
dobc_config_t dobc_constants(const Motor &m, const DobcDesign &d)
{
    const ServoPlant p  = servo_plant(m);
    const double     np = m.pole_pairs;
    dobc_config_t    c{};
    c.n_x        = static_cast<int16_t>(d.l.size());
    c.direct_Vs  = single(m.viscous_friction_Nms * m.stator_resistance_Ohm / (p.kt_NmpA * np) +
                          m.pm_flux_Wb); // EQ-DOBC-1
    c.ld_H       = single(m.d_axis_inductance_H);
    c.k_omega_Vs = single(d.k1 / np);
    for (Eigen::Index i = 0; i < d.l.size(); i++) {
        c.k_x[i] = single(d.K(i));
        c.g[i]   = single(d.g(i) / np);
        c.h[i]   = single(d.h(i));
        for (Eigen::Index j = 0; j < d.l.size(); j++) {
            c.m[i][j] = single(d.M(i, j));
        }
    }
    return c;
}

void solve(Design &d)
{
    ServoDesign &servo = d.servo.emplace();
    servo.dobc         = design_dobc(d.drive.motor, d.drive.dobc, control_period_s(d.drive));
    if (!(servo.dobc->matching_error <= matching_error_limit)) {
        d.certificate.failures.push_back(fmt::format(
            "observer: coefficient matching is off by {:.1e}", servo.dobc->matching_error));
    }
    law_dobc_config_t c{};
    c.dobc  = dobc_constants(d.drive.motor, *servo.dobc);
    c.id_pi = d_axis_constants(d.drive);
    keep_constants(d, c);
    certify_servo(d);
}

std::string summary(const Design &d)
{
    return servo_summary(d, "EQ-DOBC-1 to 3 with gains of EQ-DOBC-5 to 7");
}

std::vector<std::string> mismatches(const Design &d)
{
    return {fmt::format("DOBC_N_X_MAX < {}", constants_of<law_dobc_config_t>(d.config)->dobc.n_x)};
}

/// The matrices have as many states as the law's observer.
Layout layout(const Design &d)
{
    const dobc_config_t &o = constants_of<law_dobc_config_t>(d.config)->dobc;
    std::string          m;
    for (int i = 0; i < o.n_x; i++) {
        m += c_list(o.m[i], o.n_x) + ",\n";
    }
    return {{"dobc.k_x", c_field("k_x", c_list(o.k_x, o.n_x))},
            {"dobc.m", c_block("m", m)},
            {"dobc.g", c_field("g", c_list(o.g, o.n_x))},
            {"dobc.h", c_field("h", c_list(o.h, o.n_x))}};
}

} // namespace

const LawDesign dobc_design = [] {
    LawDesign d{"law_dobc", "law_dobc_config_t", is_for, solve, summary, mismatches, layout};
    d.design_speed_e_radps = [](const Drive &drive) { return drive.dobc.design_speed_e_radps; };
    return d;
}();

} // namespace sdre
