// SPDX-License-Identifier: MIT
#include "tune/prediction.hpp"

#include "common/errors.hpp"
#include "design/law_design.hpp"
#include "tune/goals.hpp"
#include "tune/objective.hpp"

namespace sdre {

std::optional<Prediction> predicted(const Drive &drive)
{
    if (!law_design(drive).loop) {
        return {};
    }
    try {
        TuneSpec spec = goals_from_physics(drive);
        spec.cases.resize(1); // the nominal motor
        const Score s = score(drive, spec);
        if (s.worst >= unstable_score) {
            return {};
        }
        const CaseResult &r = s.cases.front();
        return Prediction{spec.speed_e_radps, spec.load_step_Nm, r.dip_e_radps,
                          r.settling_time_s,  spec.band_e_radps, r.ripple_e_radps,
                          r.voltage_noise_V};
    } catch (const InputError &) {
        return {};
    }
}

} // namespace sdre
