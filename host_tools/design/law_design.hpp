// SPDX-License-Identifier: MIT
/// The design of one of the firmware's laws: how its constants are computed and how they are
/// written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/constants_text.hpp"
#include "design/design.hpp"
#include "design/shaft_model.hpp"

namespace sdre {

/// The key that trades a law's noise for its speed.
struct NoiseKnob {
    const char *law;                           ///< in drive files
    void (*turn)(Drive &drive, double factor); ///< above 1: faster and noisier
    std::string (*text)(const Drive &drive);   ///< key and value
};

/// A number of the drive file that a search varies: least + start x factor.
struct RivalKey {
    const char *key;
    double CascadeSpec::*value;
    double start; ///< chosen: in the middle of what is stable and quiet on the shipped motor
    double least   = 0.0;
    bool   is_rate = true; ///< `start` is a multiple of the sampling rate
};

/// A drive is compared with it (sil/qualify/rivals.hpp).
struct RivalLaw {
    const char *name;  ///< in drive files
    bool        usual; ///< a good drive is not behind it
    void (*use)(Drive &drive);
    std::vector<std::vector<RivalKey>> tunings; ///< a search for each
};

/// The sampled loop of a law that observes the angle, at a point with the gains there. A search moves its weights, and load steps are
/// predicted with it.
struct LinearLoop {
    SampledModel (*at)(const Design &design, const TrueMotor &motor, const Shaft &shaft,
                       const OperatingPoint &at, const LoopGains &gains);
    /// Constants that at() reads, into a design with its drive, its reduced parameters and the part of its configuration that no
    /// law changes. The drive's map is of the motor `of_map`. None: at() reads no constants, and knows no map.
    void (*believe)(Design &design, const Motor &of_map) = nullptr;
};

/// Currents that schedule the gain series, as reports name them.
struct Scheduling {
    std::vector<const char *> controller;
    std::vector<const char *> observer;
};

enum class Weights { none, by_physics, by_goals }; ///< ways in which `tune` finds them

struct LawDesign {
    const char *name; ///< of the firmware's object and of its header: "law_noc"
    const char *constants_type;
    bool (*is_for)(const Drive &drive); ///< whether the drive file requests it
    /// Gains, certificate and constants, into a design that has its drive, its reduced parameters and the part of its
    /// configuration that no law changes.
    void (*solve)(Design &design);
    std::string (*summary)(const Design &design); ///< lines of the comment above the tables
    /// Preprocessor conditions, of which none may hold for the control core.
    std::vector<std::string> (*mismatches)(const Design &design);
    Layout (*layout)(const Design &design); ///< how its arrays read in the table

    bool    own_observer = false; ///< solve() designs and certifies one, in place of nodo
    bool    shaft_states = false; ///< observer and gains have those of an elastic shaft
    Weights weights      = Weights::none;
    std::optional<LinearLoop> loop{};
    Scheduling                scheduling{}; ///< empty: no series for an order study
    std::string (*report_rows)(const Drive &drive) = nullptr; ///< settings beside the current loops
    double (*design_speed_e_radps)(const Drive &drive) = nullptr; ///< of its model of harmonics
    std::optional<NoiseKnob> noise_knob{};
    std::optional<RivalLaw>  rival{};
};

/// That of the drive. Every drive that read_drive_file() accepts has one.
const LawDesign &law_design(const Drive &drive);

std::vector<const RivalLaw *> rival_laws();

/// "noc, noc_h .. or ladrc": the laws with a noise_knob.
std::string noise_knob_laws();

/// Keeps the constants and points the configuration at them.
template <typename Constants> void keep_constants(Design &design, const Constants &constants)
{
    const auto kept  = std::make_shared<const Constants>(constants);
    design.constants = kept;
    set_law(design.config, *kept);
}

} // namespace sdre
