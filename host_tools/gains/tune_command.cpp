// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "gains/commands.hpp"
#include "tune/auto_tune.hpp"
#include "tune/drive_text.hpp"
#include "tune/goals.hpp"
#include "tune/tune.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string spec;
    std::string out;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--spec", o.spec, "specification (TOML); without one the goals follow from physics");
    list.text("--out", o.out, "drive file to write instead");
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
};

Tuned by_specification(const Options &o, const Drive &drive)
{
    Tuned t;
    t.spec = read_tune_spec(o.spec);
    require_torque(drive, t.spec.load_before_Nm + t.spec.load_step_Nm,
                   fmt::format("{}: load_before_Nm + load_step_Nm", o.spec));
    t.result                      = tune_drive(drive, t.spec, say_progress);
    const Certificate certificate = design_drive(t.result.drive).certificate;
    if (!certificate.passed()) {
        throw DesignError(
            fmt::format("{}: the best weights found are not certified, nothing written: {}", o.spec,
                        fmt::join(certificate.failures, "; ")));
    }
    t.remark = fmt::format("worst result / specification {:.2f}{}", t.result.worst_ratio,
                           t.result.worst_ratio > 1.0 ? " (not all are met)" : "");
    return t;
}

Tuned by_physics(const Options &o, const Drive &drive)
{
    try {
        const AutoTuneResult r = auto_tune(drive, say_progress);
        return {r.tuned, r.goals, r.binding};
    } catch (const InputError &e) {
        throw InputError(fmt::format("{}: {}", o.drive, e.what()));
    } catch (const DesignError &e) {
        throw DesignError(fmt::format("{}: {}, nothing written", o.drive, e.what()));
    }
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
    require_rewritable(o.drive, text);
    const Tuned       tuned    = o.spec.empty() ? by_physics(o, drive) : by_specification(o, drive);
    const std::string sections = tuned_sections(tuned.result, tuned.spec);
    const std::string out      = o.out.empty() ? o.drive : o.out;
    write_files({{out, with_sections(text, sections)}});
    fmt::print("{}{}{}: written; {}\n", sections, pwm_note(drive.inverter), out, tuned.remark);
    return exit_ok;
}

} // namespace

Command tune_command()
{
    return command<Options>(
        "tune", "find weights from physical specifications and write them to the drive file",
        declare, run);
}

} // namespace sdre
