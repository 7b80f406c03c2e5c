// SPDX-License-Identifier: MIT
/// From a drive description to gains, limits and their certificate: the whole off-line job in one call.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/loop_check.hpp"
#include "design/motor_model.hpp"
#include "design/noc_h/harmonic_design.hpp"
#include "design/series_error.hpp"
#include "design/servo/dobc_design.hpp"
#include "design/verdict.hpp"
#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

/// How one sampled loop behaves over its certified range, of every scheduling current alike.
struct SampledLoop {
    double range_A =
        0.0; ///< scheduling current in +-range_A; beyond series_range_A the gain is held
    double series_range_A  = 0.0; ///< the series itself is used in +-series_range_A
    double worst_pole_1ps  = 0.0; ///< largest real part of the continuous poles over the range
    double fastest_pole_ts = 0.0; ///< largest |pole| times the control period
    double spectral_radius = 0.0; ///< of the sampled loop, worst over the range; stable below 1
    std::vector<double>
        series_error; ///< [n]: order n against the exact SDRE gain, worst in +-series_range_A
    std::vector<double> series_error_full; ///< the same in +-range_A, series not held
};

struct Certificate {
    SampledLoop                nosc;
    SampledLoop                nodo;
    std::optional<SampledLoop> position; ///< error dynamics of the position, where the drive has it
    std::optional<Verdict> loop; ///< motor, observer and law together; laws that have such a model
    std::vector<std::string> failures; ///< one line each; empty = certified

    bool passed() const
    {
        return failures.empty();
    }
};

/// One of paper B's laws.
struct ServoDesign {
    std::optional<DobcDesign> dobc; ///< none for the PID
};

/// How the loop of noc_h behaves from standstill to the trip speed, over the observer's current range.
struct HarmonicCheck {
    double    spectral_radius     = 0.0; ///< worst, at:
    double    worst_speed_e_radps = 0.0;
    double    worst_iq_A          = 0.0;
    double    worst_residual      = 0.0; ///< of all Riccati and Lyapunov equations
    LoopCheck speed_loop;                ///< sensitivity at the weights' speed, no load
};

struct Design {
    Drive                     drive;
    Precision                 precision = Precision::quick; ///< of the Riccati equation's solver
    ReducedParameters         l{};
    GainSeries                nosc;     ///< and in the certificate: laws of near optimal control
    GainSeries                nodo;     ///< the same, but for noc_h
    std::optional<GainSeries> position; ///< drives with [position]; a state more
    std::optional<GainSeries> torque;   ///< laws that follow a torque; 2 x 2, of order 0
    std::optional<HarmonicDesign> harmonics; ///< noc_h only
    HarmonicCheck                 harmonic_check;
    std::optional<ServoDesign>    servo;    ///< laws of paper B
    drive_config_t                config{}; ///< what the firmware gets, in its own single precision
    std::shared_ptr<const void>   constants; ///< what config.constants points to
    Certificate                   certificate;
};

/// Relative residual above which a solution is refused.
constexpr double residual_limit = 1e-10;
/// The series is used up to where its gain is this far (relative, norm-wise) from the exact SDRE gain.
constexpr double series_error_limit = 0.1;

/// Largest peak sensitivity of a certified loop. Chosen: a phase margin of 19 degrees is then left; paper B's repaired
/// design has 2.55, the printed one 122.
constexpr double peak_sensitivity_limit = 3.0;
/// Share of the box of EQ-CERT-5 in which a loop has to be stable. Chosen: R, L, flux x0.76 .. 1.18, J x0.76 .. 1.55 all at
/// once; a data sheet's tolerances are 10 to 20 %.
constexpr double box_share_limit = 0.4;
/// The same of one parameter at a time: all of R, L, flux x0.5 .. 1.5, J x0.5 .. 3.
constexpr double alone_share_limit = 1.0;
/// Relative error above which coefficient matching is refused.
constexpr double matching_error_limit = 1e-9;

/// Solves both problems and certifies them. DesignError when a Riccati or Lyapunov equation has no
/// acceptable solution; a failed certificate is reported in Design::certificate, not thrown.
///
/// `extended` is for tables that are written: several times slower, the same to nine digits. Only then law noc gets the range
/// of inertias that it may believe (EQ-CERT-10).
Design design_drive(const Drive &drive, Precision precision = Precision::quick);

} // namespace sdre
