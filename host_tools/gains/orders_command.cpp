// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "gains/commands.hpp"
#include "gains/order_study.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string csv;
    int         highest = 3;
    bool        json    = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.number("--highest", o.highest, {0, 8}, "highest order (default 3)");
    list.text("--csv", o.csv, "write every grid point");
    list.flag("--json", o.json, "one JSON object");
}

int run(const Options &o)
{
    const OrderStudy study = study_orders(read_drive_file(o.drive), o.highest);
    if (!o.csv.empty()) {
        write_files({{o.csv, orders_csv(study)}});
    }
    fmt::print("{}", o.json ? orders_json(study) : orders_text(study));
    return exit_ok;
}

} // namespace

Command orders_command()
{
    return command<Options>("orders",
                            "print how far every order of the two series is from the exact gains",
                            declare, run, "sdre-gains orders my_motor.toml");
}

} // namespace sdre
