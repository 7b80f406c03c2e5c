// SPDX-License-Identifier: MIT
#include "sil/eval/random_motors.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/json.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "common/random.hpp"
#include "common/toml_reader.hpp"
#include "design/sampled_model.hpp"
#include "sil/setup/board_reader.hpp"

namespace sdre {
namespace {

LoopGains gains_at(const law_noc_config_t &config, double iq_A)
{
    LoopGains                   g{Eigen::MatrixXd(2, 3), Eigen::MatrixXd::Zero(7, 3)};
    const nodo_encoder_gains_t &nodo  = config.nodo;
    const double                range = static_cast<double>(nodo.iq_max_A);
    const double                iq    = std::clamp(iq_A, -range, range);
    for (int row = 0; row < 2; row++) {
        for (int column = 0; column < 3; column++) {
            g.Lambda(row, column) =
                static_cast<double>(config.near_optimal.nosc.lambda[0][row][column]);
        }
    }
    for (int n = nodo.order; n >= 0; n--) {
        for (int row = 0; row < 7; row++) {
            for (int column = 0; column < 3; column++) {
                g.L(row, column) =
                    g.L(row, column) * iq + static_cast<double>(nodo.gain[n][row][column]);
            }
        }
    }
    return g;
}

/// Largest spectral radius of the true motor under the controller, over the speeds of the scenario.
double linear_radius(const Scenario &s, const law_noc_config_t &config)
{
    const double            ts    = control_period_s(s.drive);
    const TrueMotor         motor = true_motor(s.drive, scaled(s.drive.motor, s.plant_scale));
    const ReducedParameters model = reduced_parameters(scaled(s.drive.motor, s.controller_scale));
    double                  worst = 0.0;
    for (const Step &step : s.speed_reference) {
        for (const double iq_A : {0.0, 0.5 * s.drive.motor.max_current_A}) {
            const OperatingPoint at{step.value, iq_A, mtpa_id_A(model, iq_A)};
            worst = std::max(
                worst,
                spectral_radius(sampled_model(motor, model, gains_at(config, iq_A), at, ts).A));
        }
    }
    return worst;
}

std::string explain(const Scenario &s, const drive_config_t &config)
{
    const double gain = s.plant_scale.at("pm_flux_Wb") / s.plant_scale.at("inertia_kgm2");
    std::string  text = fmt::format("acceleration per ampere is {:.2f} x what is believed", gain);
    if (const auto *noc = constants_of<law_noc_config_t>(config)) {
        const double radius = linear_radius(s, *noc);
        text +=
            fmt::format(", spectral radius of the linear loop {:.4f}: {}", radius,
                        radius < 1.0 ? "stable for small signals, lost in saturation" : "unstable");
    }
    return text;
}

} // namespace

std::vector<std::string> judge(const Scenario &s, const SimulationResult &result,
                               const std::vector<Metrics>    &metrics,
                               const std::vector<NoiseLimit> &limits)
{
    std::vector<std::string> reasons;
    if (result.fault != 0) {
        reasons.push_back(
            fmt::format("fault at {:.4f} s: {}", result.fault_time_s, fault_name(result.fault)));
    }
    double peak_A = 0.0;
    for (const TraceRow &row : result.trace) {
        peak_A = std::max(peak_A, row.peak_current_A);
    }
    const double limit_A = allowed_current_ratio * s.drive.motor.max_current_A;
    if (!(peak_A <= limit_A)) {
        reasons.push_back(fmt::format("{:.2f} A, allowed {:.2f} A", peak_A, limit_A));
    }
    for (const Metrics &m : metrics) {
        if (!m.settling_time_s) {
            reasons.push_back(fmt::format("{}: not in its band at the end, ripple {:.2g} rad/s",
                                          m.name, m.ripple_e_radps));
        }
    }
    const std::vector<std::string> loud = noise_reasons(metrics, limits);
    reasons.insert(reasons.end(), loud.begin(), loud.end());
    return reasons;
}

MotorScale draw_motor(const MotorRanges &r, std::uint64_t seed, int motor)
{
    Uniform    draw(seed, static_cast<std::uint64_t>(motor));
    MotorScale scale;
    scale["stator_resistance_Ohm"] = draw.next(r.resistance.lo, r.resistance.hi);
    scale["d_axis_inductance_H"]   = draw.next(r.inductance.lo, r.inductance.hi);
    scale["q_axis_inductance_H"]   = draw.next(r.inductance.lo, r.inductance.hi);
    scale["pm_flux_Wb"]            = draw.next(r.flux.lo, r.flux.hi);
    scale["inertia_kgm2"]          = draw.next(r.inertia.lo, r.inertia.hi);
    return scale;
}

namespace {

/// The shaft of the drive file keeps its resonance with another inertia. A shaft of the scenario keeps its stiffness.
void keep_resonance(Scenario &s)
{
    const MotorEffects own = effects_of_drive(s.drive);
    MotorEffects      &e   = s.motor_effects;
    if (e.load_inertia_share == own.load_inertia_share &&
        e.shaft_stiffness_Nmprad == own.shaft_stiffness_Nmprad &&
        e.shaft_damping_Nms == own.shaft_damping_Nms) {
        const MotorEffects kept  = effects_of_drive(s.drive, s.plant_scale.at("inertia_kgm2"));
        e.shaft_stiffness_Nmprad = kept.shaft_stiffness_Nmprad;
        e.shaft_damping_Nms      = kept.shaft_damping_Nms;
    }
}

} // namespace

RandomMotors run_random_motors(const Scenario &scenario, int count)
{
    if (!scenario.motor_ranges) {
        throw InputError(fmt::format("scenario {}: [motor_ranges] is missing", scenario.name));
    }
    const Controller              controller = prepare_controller(scenario);
    const std::vector<NoiseLimit> limits     = noise_limits(scenario, controller);
    std::vector<MotorFailure>     runs(static_cast<std::size_t>(count));
    Progress                      progress(runs.size(), "motors");

    parallel_for(runs.size(), [&](std::size_t i) {
        Scenario  one   = scenario;
        const int motor = static_cast<int>(i) + 1;
        one.plant_scale = draw_motor(*scenario.motor_ranges, scenario.seed, motor);
        keep_resonance(one);
        one.seed                      = static_cast<std::uint64_t>(motor);
        const SimulationResult result = simulate(one, controller);
        runs[i]                       = {motor, result.fault != 0, one.plant_scale,
                                         judge(one, result, measure(one, result.trace), limits)};
        if (!runs[i].reasons.empty()) {
            runs[i].reasons.push_back(explain(one, controller.config));
        }
        progress.step();
    });

    RandomMotors out;
    out.count = count;
    for (const MotorFailure &run : runs) {
        out.scales.push_back(run.scale);
    }
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(out.failures),
                 [](const MotorFailure &run) { return !run.reasons.empty(); });
    return out;
}

int RandomMotors::tripped() const
{
    return static_cast<int>(std::count_if(failures.begin(), failures.end(),
                                          [](const MotorFailure &f) { return f.tripped; }));
}

std::string random_motors_text(const Scenario &scenario, const RandomMotors &runs)
{
    std::string s = fmt::format("{} on {}: {} of {} motors failed, {:.2f} % good, {} tripped\n",
                                scenario.name, scenario.drive.name, runs.failures.size(),
                                runs.count, 100.0 * runs.good() / runs.count, runs.tripped());
    for (const MotorFailure &f : runs.failures) {
        s += fmt::format("motor {}: R {:.2f}, Ld {:.2f}, Lq {:.2f}, flux {:.2f}, J {:.2f}\n",
                         f.motor, f.scale.at("stator_resistance_Ohm"),
                         f.scale.at("d_axis_inductance_H"), f.scale.at("q_axis_inductance_H"),
                         f.scale.at("pm_flux_Wb"), f.scale.at("inertia_kgm2"));
        for (const std::string &reason : f.reasons) {
            s += fmt::format("  {}\n", reason);
        }
    }
    return s;
}

std::string random_motors_csv(const RandomMotors &runs)
{
    std::string s =
        "motor,resistance,d_axis_inductance,q_axis_inductance,flux,inertia,failed,reasons\n";
    auto failure = runs.failures.begin();
    for (std::size_t i = 0; i < runs.scales.size(); i++) {
        const MotorScale &scale = runs.scales[i];
        const bool        failed =
            failure != runs.failures.end() && failure->motor == static_cast<int>(i) + 1;
        s += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},\"{}\"\n", i + 1,
                         scale.at("stator_resistance_Ohm"), scale.at("d_axis_inductance_H"),
                         scale.at("q_axis_inductance_H"), scale.at("pm_flux_Wb"),
                         scale.at("inertia_kgm2"), failed ? 1 : 0,
                         failed ? fmt::format("{}", fmt::join(failure->reasons, "; ")) : "");
        failure += failed ? 1 : 0;
    }
    return s;
}

std::string random_motors_json(const Scenario &scenario, const RandomMotors &runs)
{
    Json failures = Json::array();
    for (const MotorFailure &f : runs.failures) {
        failures.push_back({{"motor", f.motor}, {"scale", f.scale}, {"reasons", f.reasons}});
    }
    return Json{{"scenario", scenario.name}, {"drive", scenario.drive.name},
                {"motors", runs.count},      {"failed", runs.failures.size()},
                {"tripped", runs.tripped()}, {"failures", failures}}
        .text();
}

std::vector<OutputFile> failed_motor_files(const std::filesystem::path &scenario_file,
                                           const std::filesystem::path &drive_file,
                                           const RandomMotors          &runs,
                                           const std::filesystem::path &directory)
{
    std::error_code error;
    std::filesystem::create_directories(directory, error); // write_files() names what is wrong
    std::vector<OutputFile> files;
    for (const MotorFailure &f : runs.failures) {
        toml::table t = parse_toml_file(scenario_file);
        t.erase("motor_ranges");
        t.insert_or_assign("seed", f.motor);
        toml::table scale;
        for (const auto &[key, factor] : f.scale) {
            scale.insert_or_assign(key, factor);
        }
        t.insert_or_assign("plant_scale", scale);
        const std::filesystem::path drive =
            drive_file.empty()
                ? scenario_drive_path(scenario_file, *t["drive"].value<std::string>())
                : drive_file;
        t.insert_or_assign("drive", std::filesystem::proximate(drive, directory).generic_string());
        std::ostringstream text;
        for (const std::string &reason : f.reasons) {
            text << "# " << reason << "\n";
        }
        text << t << "\n";
        files.push_back(
            {directory / fmt::format("{}_motor_{}.toml", scenario_file.stem().string(), f.motor),
             text.str()});
    }
    return files;
}

} // namespace sdre
