// SPDX-License-Identifier: MIT
/// The load step of a specification on a sampled loop.
#pragma once

#include "design/sampled_model.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

struct LoadStep {
    double dip_e_radps     = 0.0;
    double settling_time_s = 0.0; ///< the whole simulated time when it does not settle
    double voltage_V       = 0.0; ///< largest
};

/// Followed for some time constants of the slowest mode.
LoadStep load_step(const SampledModel &loop, const TuneSpec &spec);
/// Followed for so many periods.
LoadStep load_step(const SampledModel &loop, const TuneSpec &spec, int periods);

} // namespace sdre
