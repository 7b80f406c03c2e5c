// SPDX-License-Identifier: MIT
/// The elastic shafts of [mechanics] as cases of the search.
#pragma once

#include "design/sampled_model.hpp"
#include "drive/drive_file.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// Largest spectral radius with these shafts (EQ-CERT-9) and the gains of order 0; 0 of a rigid coupling. The points are standstill, and
/// half the rated speed with the largest current. Half of the decay that the shaft has by itself is added.
double radius_with_shafts(const Drive &drive, const LoopGains &gains);

/// Goal of the settling time behind a shaft of this resonance: twice that of a rigid coupling. It is
/// never less than 1.6 oscillations of a known shaft, or 8 of an unknown one.
double shaft_settling_s(const Mechanics &mechanics, double rigid_s, double resonance_Hz);

/// The load step that is farthest beyond its goal.
struct ShaftStep {
    double ratio =
        0.0; ///< of its settling time, or of the ripple, to the goal; 0 of a rigid coupling
    double settling_time_s = 0.0;
    double resonance_Hz    = 0.0;
};

/// The nominal load step with some of these shafts, at the least damping ratio. The goal is shaft_settling_s(). Three
/// standard deviations of the speed may be 0.4 of the band.
ShaftStep shaft_step(const Drive &drive, const TuneSpec &spec, const LoopGains &gains,
                     const OperatingPoint &at);

} // namespace sdre
