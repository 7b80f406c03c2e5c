// SPDX-License-Identifier: MIT
#include "drive/uncertainty.hpp"

namespace sdre {
namespace {

// Twice a share still has to leave a motor.
constexpr Range share{0.001, 0.4};
constexpr Range friction_share{0.001, 0.2};
constexpr Range offset_e_rad{0.001, 0.2};
constexpr Range own_cnt{0.001, 0.1};

} // namespace

Uncertainty read_uncertainty(std::optional<TomlReader> t)
{
    Uncertainty u;
    if (!t) {
        return u;
    }
    u.inertia      = t->number_or("inertia", share, u.inertia);
    u.pm_flux      = t->number_or("pm_flux", share, u.pm_flux);
    u.inductance   = t->number_or("inductance", share, u.inductance);
    u.resistance   = t->number_or("resistance", share, u.resistance);
    u.dead_time    = t->number_or("dead_time", share, u.dead_time);
    u.friction     = t->number_or("friction", friction_share, u.friction);
    u.angle_e_rad  = t->number_or("angle_e_rad", offset_e_rad, u.angle_e_rad);
    u.disc_own_cnt = t->number_or("disc_own_cnt", own_cnt, u.disc_own_cnt);
    t->reject_unknown_keys();
    return u;
}

} // namespace sdre
