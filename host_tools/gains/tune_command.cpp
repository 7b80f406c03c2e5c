// SPDX-License-Identifier: MIT
#include <cmath>

#include <fmt/format.h>

#include "common/child_process.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "gains/added_note.hpp"
#include "gains/commands.hpp"
#include "tune/added_section.hpp"
#include "tune/auto_tune.hpp"
#include "tune/drive_text.hpp"
#include "tune/goals.hpp"
#include "tune/tune.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string spec;
    std::string out;
    bool        alone = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--spec", o.spec, "specification (TOML); without one the goals follow from physics");
    list.text("--out", o.out, "drive file to write instead");
    list.flag("--no-qualify", o.alone, "without the trials at the end");
}

void say_progress(int evaluations, double worst)
{
    fmt::print(stderr, "{} evaluations, worst result {:.3f} of its goal\n", evaluations, worst);
}

/// Weights, their goals, and a line about them.
struct Tuned {
    TuneResult  result;
    TuneSpec    spec;
    std::string remark;
    bool        met = true; ///< the specification, if there is one
};

// Chosen: weights have three digits.
constexpr double met_within = 1.02;

Tuned by_specification(const Options &o, const Drive &drive)
{
    Tuned t;
    t.spec = read_tune_spec(o.spec);
    if (has_resonance(t.spec) && !law_design(drive).shaft_states) {
        throw InputError(fmt::format(
            "{}: [[case]] resonance is not allowed: only law = \"noc_shaft\" has one", o.spec));
    }
    t.spec = with_shaft_cases(t.spec, drive);
    require_torque(drive, t.spec.load_before_Nm + t.spec.load_step_Nm,
                   fmt::format("{}: load_before_Nm + load_step_Nm", o.spec));
    t.result                      = tune_drive(drive, t.spec, say_progress);
    const Certificate certificate = design_drive(t.result.drive).certificate;
    if (!certificate.passed()) {
        throw DesignError(
            fmt::format("{}: the best weights found are not certified, nothing written: {}", o.spec,
                        fmt::join(certificate.failures, "; ")));
    }
    t.met    = t.result.worst_ratio <= met_within;
    t.remark = t.met ? fmt::format("the specification is met, worst result at {:.2f} of it",
                                   t.result.worst_ratio)
                     : fmt::format("certified, and THE SPECIFICATION IS NOT MET: worst result at "
                                   "{:.2f} of it\nnext: larger values in {}, a higher pwm_kHz, or "
                                   "finer sensors",
                                   t.result.worst_ratio, shell_word(o.spec));
    return t;
}

Tuned by_physics(const Options &o, const Drive &drive)
{
    try {
        const AutoTuneResult r = auto_tune(drive, say_progress);
        return {r.tuned, r.goals, "certified; " + r.binding};
    } catch (const InputError &e) {
        throw InputError(fmt::format("{}: {}", o.drive, e.what()));
    } catch (const DesignError &e) {
        throw DesignError(fmt::format("{}: {}, nothing written", o.drive, e.what()));
    }
}

/// Noise of v_q that the goals allow, per cent of the circle.
int noise_percent(const TuneSpec &goals, const Drive &drive)
{
    const double circle_V = drive.inverter.dc_link_V / std::sqrt(3.0);
    return static_cast<int>(std::ceil(100.0 * goals.voltage_noise_V / circle_V));
}

/// `sdre-sil qualify --short` on the result, which prints what it finds.
int qualified(const std::string &file, int noise)
{
    const std::filesystem::path tool = program_beside("sdre-sil");
    if (tool.empty()) {
        fmt::print("not tried: there is no sdre-sil beside this tool; next: sdre-sil qualify {}\n",
                   shell_word(file));
        return exit_ok;
    }
    std::vector<std::string> arguments{tool.string(), "qualify", file, "--short"};
    if (noise > 0) {
        arguments.insert(arguments.end(), {"--noise", fmt::format("{}", noise)});
    }
    return run_program(arguments) == 0 ? exit_ok : exit_design_failed;
}

/// [position] and [torque], where the start weights were not certified and the found ones are: `new` left them out then.
std::string added_sections(const Drive &before, const Drive &found, const std::string &text,
                           const std::string &file)
{
    if (law_design(before).weights != Weights::by_goals || is_certified(before)) {
        return "";
    }
    std::string added;
    if (takes_positions(before.law) && !before.position) {
        added +=
            text_or_note("position", "positions", position_section(found, text, file), "still no");
    }
    if (takes_torque(before) && !before.torque) {
        added += text_or_note("torque", "torques", torque_section(found, text + added, file),
                              "still no");
    }
    return added;
}

int run(const Options &o)
{
    const Drive   drive   = read_drive_file(o.drive);
    const Weights weights = law_design(drive).weights;
    if (weights == Weights::none || (weights == Weights::by_physics && !o.spec.empty())) {
        throw InputError(
            fmt::format("{}: law = \"{}\" has no weights to tune", o.drive, law_name(drive.law)));
    }
    const std::string text = read_text_file(o.drive);
    require_rewritable(o.drive, text, drive);
    const Tuned       tuned    = o.spec.empty() ? by_physics(o, drive) : by_specification(o, drive);
    const std::string out      = o.out.empty() ? o.drive : o.out;
    std::string       sections = tuned_sections(tuned.result, tuned.spec);
    sections += added_sections(drive, tuned.result.drive, with_sections(text, sections), out);
    write_files({{out, with_sections(text, sections)}});
    fmt::print("{}{}{}: written; {}\n", sections, pwm_note(drive.inverter), out, tuned.remark);
    const int missed = tuned.met ? exit_ok : exit_design_failed;
    if (o.alone) {
        fmt::print("not tried; next: sdre-sil qualify {}\n", shell_word(out));
        return missed;
    }
    const int tried = qualified(out, o.spec.empty() ? 0 : noise_percent(tuned.spec, drive));
    return tried == exit_ok ? missed : tried;
}

} // namespace

Command tune_command()
{
    return command<Options>("tune",
                            "find weights from physical specifications, write them to the drive "
                            "file and qualify it; exit "
                            "code 2 when it is not good",
                            declare, run, "sdre-gains tune my_motor.toml --out my_motor.toml");
}

} // namespace sdre
