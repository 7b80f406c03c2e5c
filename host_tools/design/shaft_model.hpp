// SPDX-License-Identifier: MIT
/// The sampled loop of the encoder form with the load behind an elastic shaft, and the resonances at which it is stable.
#pragma once

#include <string>
#include <vector>

#include "design/id_reference.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

struct Design;

/// Two masses: the load has a share of the inertia.
struct Shaft {
    double resonance_Hz       = 0.0;
    double damping            = 0.0; ///< ratio, of both masses against each other
    double load_inertia_share = 0.5;
};

/// EQ-CERT-9, the plant (w iq id theta w_load twist) of closed_loop().
HeldPlant held_with_shaft(const TrueMotor &motor, const OperatingPoint &at, double ts_s,
                          const Shaft &shaft);

/// A drive's loop with shafts; it refers to the design. Its d-current reference moves (EQ-CERT-6). It needs `drive`, `l` and the first term of `nosc`.
class TwoMasses {
public:
    explicit TwoMasses(const Design &design);

    /// The steady state at a speed and a share of the largest q current, -1 .. 1.
    OperatingPoint point(double speed_e_radps, double share) const;
    SampledModel   loop(const Shaft &shaft, const OperatingPoint &at, const LoopGains &gains) const;

private:
    const Design     &design_;
    TrueMotor         motor_;
    ReducedParameters model_;
    IdReference       references_;
};

/// The shafts that [mechanics] stands for. Resonances are `ratio` apart at most; none of a rigid coupling.
std::vector<Shaft> shafts_of(const Mechanics &mechanics, double ratio);

struct ResonanceRange {
    double from_Hz;
    double to_Hz;
};

struct ShaftVerdict {
    Mechanics                   mechanics;    ///< what was looked at
    std::vector<ResonanceRange> stable;       ///< with every damping ratio
    double                      radius = 0.0; ///< the largest spectral radius
    Shaft                       worst;        ///< where it is
    OperatingPoint              worst_at;

    bool everywhere() const
    {
        return radius < 1.0;
    }
};

/// Looks at the shafts of the drive's [mechanics]. The points are standstill without current, and half and whole rated speed with the
/// largest current, motoring and generating. The law must be noc in its encoder form, or noc_shaft.
ShaftVerdict examine_shaft(const Design &design);

/// The same as a part of the certificate, where the coupling is not rigid. The whole loop has been certified before.
void certify_shaft(Design &design);

/// At most 1 when the loop is stable with every shaft, as excess() of the whole verdict.
double shaft_excess(const ShaftVerdict &verdict);

/// "stable with every resonance of 40 .. 600 Hz, damping ratio 0.02 .. 0.1, 0.5 of the inertia behind", or with which it is not.
std::string shaft_words(const ShaftVerdict &verdict);

} // namespace sdre
