// SPDX-License-Identifier: MIT
/// sdre-gains: drive file -> gains, report, firmware tables.
#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/version.hpp"
#include "design/design.hpp"
#include "emit/emit_tables.hpp"
#include "emit/report.hpp"
#include "gains/care_command.hpp"
#include "gains/order_study.hpp"
#include "tune/tune.hpp"

namespace {

enum ExitCode { exit_ok = 0, exit_bad_input = 1, exit_design_failed = 2, exit_check_mismatch = 3 };

struct Options {
    std::string drive;
    std::string problem;
    std::string out;
    std::string check;
    std::string spec;
    std::string csv;
    int         highest     = 3;
    bool        json        = false;
    bool        uncertified = false;
};

int run_generate(const Options &options)
{
    if (options.out.empty() == options.check.empty()) {
        throw sdre::InputError("generate: give either --out DIR or --check DIR");
    }
    const sdre::Design design    = sdre::design_drive(sdre::read_drive_file(options.drive));
    const bool         certified = design.certificate.passed();
    if (!certified && !options.uncertified) {
        throw sdre::DesignError(fmt::format("{}: not certified: {}", options.drive,
                                            fmt::join(design.certificate.failures, "; ")));
    }
    const char           *verdict = certified ? "certified" : "NOT CERTIFIED";
    const sdre::TableText text    = sdre::table_text(design);
    if (!options.out.empty()) {
        sdre::write_tables(text, options.out);
        fmt::print("{}: {}; wrote gain_tables.h and gain_tables.c to {}\n", design.drive.name,
                   verdict, options.out);
        return exit_ok;
    }
    const std::string difference = sdre::compare_tables(text, options.check);
    if (!difference.empty()) {
        fmt::print(stderr, "sdre-gains: {}\n", difference);
        return exit_check_mismatch;
    }
    fmt::print("{}: {}; {} matches\n", design.drive.name, verdict, options.check);
    return exit_ok;
}

int run_report(const Options &options)
{
    const sdre::Design design = sdre::design_drive(sdre::read_drive_file(options.drive));
    fmt::print("{}", options.json ? sdre::report_json(design) : sdre::report_text(design));
    return exit_ok;
}

int run_orders(const Options &options)
{
    const sdre::OrderStudy study =
        sdre::study_orders(sdre::read_drive_file(options.drive), options.highest);
    if (!options.csv.empty()) {
        sdre::write_files({{options.csv, sdre::orders_csv(study)}});
    }
    fmt::print("{}", options.json ? sdre::orders_json(study) : sdre::orders_text(study));
    return exit_ok;
}

int run_tune(const Options &options)
{
    const sdre::Drive drive = sdre::read_drive_file(options.drive);
    if (drive.law != sdre::Law::noc) {
        throw sdre::InputError(fmt::format("{}: law = \"{}\" has no weights to tune", options.drive,
                                           sdre::law_name(drive.law)));
    }
    const sdre::TuneSpec spec = sdre::read_tune_spec(options.spec);
    const std::string    text = sdre::read_text_file(options.drive);
    sdre::require_rewritable(options.drive, text);
    const auto progress = [](int evaluations, double worst) {
        fmt::print(stderr, "{} evaluations, worst result {:.3f} of its specification\n",
                   evaluations, worst);
    };
    const sdre::TuneResult  result      = sdre::tune_drive(drive, spec, progress);
    const sdre::Certificate certificate = sdre::design_drive(result.drive).certificate;
    if (!certificate.passed()) {
        throw sdre::DesignError(
            fmt::format("{}: the best weights found are not certified, nothing written: {}",
                        options.spec, fmt::join(certificate.failures, "; ")));
    }
    const std::string sections = sdre::tuned_sections(result, spec);
    const std::string out      = options.out.empty() ? options.drive : options.out;
    sdre::write_files({{out, sdre::with_sections(text, sections)}});
    fmt::print("{}{}: written; worst result / specification {:.2f}{}\n", sections, out,
               result.worst_ratio, result.worst_ratio > 1.0 ? " (not all are met)" : "");
    return exit_ok;
}

int run_care(const Options &options)
{
    const sdre::CareSolution solution =
        sdre::solve_care_problem(sdre::read_care_problem(options.problem));
    fmt::print("{}", options.json ? sdre::care_json(solution) : sdre::care_text(solution));
    return exit_ok;
}

int run(int argc, char **argv)
{
    Options  options;
    CLI::App app{
        "Gain design for sdre-drive: Riccati and Lyapunov solutions as certified firmware tables."};
    app.require_subcommand(1);
    app.set_version_flag("--version", fmt::format("sdre-gains {}", sdre::tool_version));

    CLI::App *generate = app.add_subcommand(
        "generate", "write gain_tables.h and .c, or compare them with the drive file");
    generate->add_option("DRIVE", options.drive, "drive file (TOML)")->required();
    generate->add_option("--out", options.out, "directory to write to");
    generate->add_option("--check", options.check,
                         "directory to compare with; exit code 3 on a mismatch");

    generate->add_flag("--uncertified", options.uncertified,
                       "write even what is not certified, with the reasons in the file");

    CLI::App *report = app.add_subcommand("report", "print gains, poles and the certificate");
    report->add_option("DRIVE", options.drive, "drive file (TOML)")->required();
    report->add_flag("--json", options.json, "one JSON object");

    CLI::App *orders = app.add_subcommand(
        "orders", "print how far every order of the two series is from the exact gains");
    orders->add_option("DRIVE", options.drive, "drive file (TOML)")->required();
    orders->add_option("--highest", options.highest, "highest order (default 3)")
        ->check(CLI::Range(0, 8));
    orders->add_option("--csv", options.csv, "write every grid point");
    orders->add_flag("--json", options.json, "one JSON object");

    CLI::App *tune = app.add_subcommand(
        "tune", "find weights from physical specifications and write them to the drive file");
    tune->add_option("DRIVE", options.drive, "drive file (TOML)")->required();
    tune->add_option("--spec", options.spec, "specification (TOML)")->required();
    tune->add_option("--out", options.out, "drive file to write instead");

    CLI::App *care = app.add_subcommand("care", "solve A'X + XA - XBR^-1B'X + Q = 0");
    care->add_option("PROBLEM", options.problem, "JSON file with A, Q and B, R (or G)")->required();
    care->add_flag("--json", options.json, "one JSON object");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        if (e.get_exit_code() == 0) {
            return app.exit(e); // --help, --version
        }
        throw sdre::InputError(e.what());
    }
    if (*generate) {
        return run_generate(options);
    }
    if (*orders) {
        return run_orders(options);
    }
    if (*tune) {
        return run_tune(options);
    }
    return *report ? run_report(options) : run_care(options);
}

} // namespace

int main(int argc, char **argv)
{
    try {
        return run(argc, argv);
    } catch (const sdre::DesignError &e) {
        fmt::print(stderr, "sdre-gains: {}\n", e.what());
        return exit_design_failed;
    } catch (const std::exception &e) {
        fmt::print(stderr, "sdre-gains: {}\n", e.what());
        return exit_bad_input;
    }
}
