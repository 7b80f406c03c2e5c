// SPDX-License-Identifier: MIT
/// The control core's C headers, for C++, and the way from a configuration to the constants of its law.
#pragma once

extern "C" {
#include "drive_tick.h"
}

namespace sdre {

/// As the firmware has it.
inline float single(double x)
{
    return static_cast<float>(x);
}

/// The firmware's law that takes these constants; an overload for every law of laws.h.
inline const law_t *law_of(const law_noc_config_t *)
{
    return &law_noc;
}
inline const law_t *law_of(const law_noc_speed_config_t *)
{
    return &law_noc_speed;
}
inline const law_t *law_of(const law_noc_h_config_t *)
{
    return &law_noc_h;
}
inline const law_t *law_of(const law_noc_iron_config_t *)
{
    return &law_noc_iron;
}
inline const law_t *law_of(const law_noc_shaft_config_t *)
{
    return &law_noc_shaft;
}
inline const law_t *law_of(const law_conventional_config_t *)
{
    return &law_conventional;
}
inline const law_t *law_of(const law_dobc_config_t *)
{
    return &law_dobc;
}
inline const law_t *law_of(const law_pid_config_t *)
{
    return &law_pid;
}
inline const law_t *law_of(const law_pi_foc_config_t *)
{
    return &law_pi_foc;
}
inline const law_t *law_of(const law_ladrc_config_t *)
{
    return &law_ladrc;
}

/// The constants of the configuration's law when it is the one that takes this type, else nullptr.
template <typename Constants> const Constants *constants_of(const drive_config_t &config)
{
    const law_t *law = law_of(static_cast<const Constants *>(nullptr));
    return config.law == law ? static_cast<const Constants *>(config.constants) : nullptr;
}

/// Gives a configuration a law; the constants must outlive it.
template <typename Constants> void set_law(drive_config_t &config, const Constants &constants)
{
    config.law       = law_of(&constants);
    config.constants = &constants;
}

} // namespace sdre
