// SPDX-License-Identifier: MIT
#include "tune/shaft_cases.hpp"

#include <algorithm>
#include <cmath>

#include "design/design.hpp"
#include "design/shaft_model.hpp"
#include "linalg/covariance.hpp"
#include "tune/load_step.hpp"
#include "tune/objective.hpp"

namespace sdre {
namespace {

constexpr double two_pi = 6.283185307179586;

constexpr double coarse_ratio =
    1.09; // chosen: three times as far apart as those of the certificate
// Chosen: the loop leaves a shaft at least this share of its own decay. Noise keeps a shaft with less in motion.
constexpr double own_decay = 0.5;

// Chosen: a load step that a drive cannot settle in this time is bad, however long it lasts.
constexpr double shaft_horizon_s = 0.15;
constexpr double step_ratio      = 1.35; // chosen: of the resonances whose load steps are followed
// Chosen: the energy of a known shaft can hardly be taken from it in fewer oscillations, and that of an unknown one takes more.
constexpr double known_oscillations   = 1.6;
constexpr double unknown_oscillations = 8.0;
constexpr double nominal_times        = 2.0;
// Chosen: noise that keeps a shaft in motion leaves the most of the band in which a speed is settled.
constexpr double shaft_ripple_share = 0.4;

Design design_of(const Drive &drive, const LoopGains &gains)
{
    Design design;
    design.drive = drive;
    design.l     = reduced_parameters(drive.motor);
    design.nosc.gain.push_back(gains.Lambda);
    return design;
}

/// At the least damping ratio.
std::vector<Shaft> hardest_shafts(const Mechanics &mechanics, double ratio)
{
    Mechanics m    = mechanics;
    m.most_damping = m.least_damping;
    return shafts_of(m, ratio);
}

/// Three standard deviations of the motor's speed.
double ripple_e_radps(const SampledModel &loop, const Sensors &sensors)
{
    if (!(spectral_radius(loop.A) < 1.0)) {
        return 0.0; // its settling time tells
    }
    const double          i2 = sensors.current_A * sensors.current_A;
    const Eigen::Vector3d variances(i2, i2, sensors.angle_rad * sensors.angle_rad);
    return 3.0 * std::sqrt(std::max(covariance(loop.A, loop.B_noise, variances)(0, 0), 0.0));
}

} // namespace

double shaft_settling_s(const Mechanics &m, double rigid_s, double resonance_Hz)
{
    const double oscillations =
        m.coupling == Coupling::known ? known_oscillations : unknown_oscillations;
    return std::max(nominal_times * rigid_s, oscillations / resonance_Hz);
}

double radius_with_shafts(const Drive &drive, const LoopGains &gains)
{
    const std::vector<Shaft> shafts = hardest_shafts(drive.mechanics, coarse_ratio);
    if (shafts.empty()) {
        return 0.0;
    }
    const Design    design = design_of(drive, gains);
    const TwoMasses masses(design);
    const double    ts    = control_period_s(drive);
    const double    half  = 0.5 * drive.motor.rated_speed_e_radps;
    double          worst = 0.0;
    for (const OperatingPoint &at : {masses.point(0.0, 0.0), masses.point(half, 1.0)}) {
        for (const Shaft &shaft : shafts) {
            const double own = two_pi * shaft.resonance_Hz * shaft.damping * ts;
            worst =
                std::max(worst, spectral_radius(masses.loop(shaft, at, gains).A) + own_decay * own);
        }
    }
    return worst;
}

ShaftStep shaft_step(const Drive &drive, const TuneSpec &spec, const LoopGains &gains,
                     const OperatingPoint &at)
{
    ShaftStep worst;
    if (drive.mechanics.coupling == Coupling::rigid) {
        return worst;
    }
    const Design    design = design_of(drive, gains);
    const TwoMasses masses(design);
    const int       periods = static_cast<int>(shaft_horizon_s / control_period_s(drive));
    const Sensors   sensors = sensors_of(drive, spec);
    for (const Shaft &shaft : hardest_shafts(drive.mechanics, step_ratio)) {
        const SampledModel loop = masses.loop(shaft, at, gains);
        const LoadStep     step = load_step(loop, spec, periods);
        const double       goal_s =
            shaft_settling_s(drive.mechanics, spec.cases[0].settling_time_s, shaft.resonance_Hz);
        const double ratio =
            std::max(step.settling_time_s / goal_s,
                     ripple_e_radps(loop, sensors) / (shaft_ripple_share * spec.band_e_radps));
        if (ratio > worst.ratio) {
            worst = {ratio, step.settling_time_s, shaft.resonance_Hz};
        }
    }
    return worst;
}

} // namespace sdre
