// SPDX-License-Identifier: MIT
#include "drive/mechanics.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace sdre {
namespace {

constexpr Range resonance_Hz{1.0, 2e3};
constexpr Range damping{1e-3, 0.5};
constexpr Range share{0.01, 0.99};

// Chosen: couplings from a long belt to a short metal bellows, and from metal to elastomer.
constexpr double unknown_from_Hz       = 40.0;
constexpr double unknown_to_Hz         = 600.0;
constexpr double unknown_least_damping = 0.02;
constexpr double unknown_most_damping  = 0.1;
constexpr double known_within          = 0.05; // of a resonance that was measured

void read_elastic(TomlReader &t, Mechanics &m)
{
    m.from_Hz = t.number_or("resonance_from_Hz", resonance_Hz, unknown_from_Hz);
    m.to_Hz   = t.number_or("resonance_to_Hz", resonance_Hz, unknown_to_Hz);
    if (!(m.to_Hz > m.from_Hz)) {
        t.fail("resonance_to_Hz", fmt::format("= {:g} is not allowed: must be above "
                                              "resonance_from_Hz = {:g}",
                                              m.to_Hz, m.from_Hz));
    }
    m.least_damping      = t.number_or("damping", damping, unknown_least_damping);
    m.most_damping       = std::max(m.least_damping, unknown_most_damping);
    m.load_inertia_share = t.number_or("load_inertia_share", share, m.load_inertia_share);
}

void read_known(TomlReader &t, Mechanics &m)
{
    m.coupling           = Coupling::known;
    m.resonance_Hz       = t.number("resonance_Hz", resonance_Hz);
    m.from_Hz            = m.resonance_Hz * (1.0 - known_within);
    m.to_Hz              = m.resonance_Hz * (1.0 + known_within);
    m.least_damping      = t.number("damping", damping);
    m.most_damping       = m.least_damping;
    m.load_inertia_share = t.number("load_inertia_share", share);
}

} // namespace

Mechanics read_mechanics(std::optional<TomlReader> t)
{
    Mechanics m;
    if (!t) {
        return m;
    }
    if (t->has("coupling")) {
        const std::string coupling = t->text("coupling");
        if (coupling != "rigid" && coupling != "elastic") {
            t->fail("coupling",
                    fmt::format("= \"{}\" is not allowed: must be \"rigid\" or \"elastic\"; a "
                                "known one has resonance_Hz instead",
                                coupling));
        }
        if (coupling == "elastic") {
            m.coupling = Coupling::elastic;
            read_elastic(*t, m);
        }
    } else {
        read_known(*t, m);
    }
    t->reject_unknown_keys();
    return m;
}

} // namespace sdre
