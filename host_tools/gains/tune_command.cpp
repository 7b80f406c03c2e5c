// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/design.hpp"
#include "gains/commands.hpp"
#include "tune/drive_text.hpp"
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
    list.required("--spec", o.spec, "specification (TOML)");
    list.text("--out", o.out, "drive file to write instead");
}

int run(const Options &o)
{
    const Drive drive = read_drive_file(o.drive);
    if (drive.law != Law::noc) {
        throw InputError(
            fmt::format("{}: law = \"{}\" has no weights to tune", o.drive, law_name(drive.law)));
    }
    const TuneSpec    spec = read_tune_spec(o.spec);
    const std::string text = read_text_file(o.drive);
    require_rewritable(o.drive, text);
    const auto progress = [](int evaluations, double worst) {
        fmt::print(stderr, "{} evaluations, worst result {:.3f} of its specification\n",
                   evaluations, worst);
    };
    const TuneResult  result      = tune_drive(drive, spec, progress);
    const Certificate certificate = design_drive(result.drive).certificate;
    if (!certificate.passed()) {
        throw DesignError(
            fmt::format("{}: the best weights found are not certified, nothing written: {}", o.spec,
                        fmt::join(certificate.failures, "; ")));
    }
    const std::string sections = tuned_sections(result, spec);
    const std::string out      = o.out.empty() ? o.drive : o.out;
    write_files({{out, with_sections(text, sections)}});
    fmt::print("{}{}: written; worst result / specification {:.2f}{}\n", sections, out,
               result.worst_ratio, result.worst_ratio > 1.0 ? " (not all are met)" : "");
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
