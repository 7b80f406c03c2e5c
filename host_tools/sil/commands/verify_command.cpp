// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "sil/commands/commands.hpp"
#include "sil/verify/detections.hpp"
#include "sil/verify/records_file.hpp"
#include "sil/verify/report.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string records;
    std::string programme;
    std::string json;
    int         samples = 512;
    int         trials  = 0;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text(
        "--records", o.records,
        "what `sdre-drive verify` has recorded; without it a machine that is as the file says");
    list.text("--programme", o.programme, "instead: write the programme for a machine (JSON)");
    list.exclude("--programme", "--records");
    list.number("--samples", o.samples, {128, 4096}, "of the scope's records (default 512)");
    list.number(
        "--trials", o.trials, {1, 10000},
        "instead: change each value by twice its uncertainty on so many simulated machines, "
        "print how often it is found and named");
    list.text("--json", o.json, "write the table");
    list.exclude("--programme", "--json");
    for (const char *other : {"--records", "--programme", "--json"}) {
        list.exclude("--trials", other);
    }
}

Records records_of(const Options &o, const Drive &d, const Programme &p)
{
    if (!o.records.empty()) {
        return read_records_file(o.records, d, p);
    }
    return rehearse(machine_on_bench(d, {}, 0), controller_of(d), p);
}

int run(const Options &o)
{
    const Drive     drive     = read_drive_file(o.drive);
    const Programme programme = verify_programme(drive, o.samples);
    if (!o.programme.empty()) {
        write_files({{o.programme, programme_json(drive, programme)}});
        return exit_ok;
    }
    if (o.trials > 0) {
        fmt::print("{}", detections_text(drive, run_detections(drive, programme, o.trials)));
        return exit_ok;
    }
    const Records records = records_of(o, drive, programme); // bad ones before the long part
    Judgement     judgement;
    judgement.fault = records.fault; // nothing to be compared then
    if (!records.fault) {
        judgement = Expectation(drive, programme).judge(records);
    }
    if (!o.json.empty()) {
        write_files({{o.json, judgement_json(drive, judgement)}});
    }
    fmt::print("{}", judgement_text(drive, judgement));
    return judgement.within() ? exit_ok : exit_fault;
}

} // namespace

Command verify_command()
{
    return command<Options>("verify",
                            "compare records of a machine with simulations of its drive file; exit "
                            "code 4 when they do not agree",
                            declare, run,
                            "sdre-sil verify my_motor.toml --programme programme.json");
}

} // namespace sdre
