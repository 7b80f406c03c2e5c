// SPDX-License-Identifier: MIT
/// Every trial of the plan run and judged, random motors, and the usual drive beside it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "design/law_design.hpp"
#include "sil/qualify/map.hpp"
#include "sil/qualify/plan.hpp"
#include "sil/qualify/torques.hpp"

namespace sdre {

struct QualifyOptions {
    int  seeds   = 10;
    int  motors  = 1000;
    int  side    = 9;    ///< speeds of the map, and torques at each
    bool against = true; ///< compare the load step with pi_foc and ladrc
    /// Largest noise of v_q, of the circle. Chosen: `tune` aims at 0.03 of its linear model.
    double noise_share = 0.04;
};

/// Worst of all seeds.
struct TrialResult {
    std::string              what;
    int                      faults = 0; ///< seeds that tripped
    std::optional<double>    settling_time_s;
    double                   dip_e_radps     = 0.0;
    double                   ripple_e_radps  = 0.0;
    double                   peak_current_A  = 0.0;
    double                   voltage_noise_V = 0.0; ///< of v_q
    double                   vd_noise_V      = 0.0;
    std::vector<std::string> reasons; ///< why it is not good; empty when it is
};

struct MotorShare {
    int    count = 0;
    int    good  = 0;
    double share() const
    {
        return count > 0 ? static_cast<double>(good) / count : 1.0;
    }
};

/// Chosen: ratio of two load steps that cannot be told apart.
constexpr double same_within = 1.05;

/// Another law on the same sensors, tuned by a search (rivals.hpp).
struct Rival {
    const RivalLaw                              *law = nullptr;
    std::vector<std::pair<const char *, double>> settings;        ///< keys of a drive file
    int                                          evaluations = 0; ///< of the search
    std::optional<TrialResult> load_step; ///< none: no tuning found is as quiet and settles
};

struct Qualification {
    std::string drive;
    Inverter    inverter;
    double      limit_A          = 0.0;
    double      circle_V         = 0.0;
    bool        certified        = false;
    double      periods_per_edge = 1.0; ///< at half the rated speed; 1: every period has an edge
    double      lines            = 0.0; ///< of the encoder
    std::vector<TrialResult>   trials;
    std::optional<TorqueTrial> torques; ///< of a drive that takes them
    PlaneMap                   map;
    MotorShare                 motors;  ///< R, L, flux +-30 %, J x0.5 .. 2
    MotorShare                 wide;    ///< R, L, flux +-50 %, J x0.5 .. 3; for information
    std::vector<Rival>         rivals;  ///< pi_foc and ladrc
    std::vector<std::string>   reasons; ///< what is not good, all of it

    bool good() const
    {
        return reasons.empty();
    }
};

Qualification qualify(const Drive &drive, const QualifyOptions &options);

std::string qualification_text(const Qualification &q);
std::string qualification_json(const Qualification &q);
/// One page without anything from outside.
std::string qualification_html(const Qualification &q);

} // namespace sdre
