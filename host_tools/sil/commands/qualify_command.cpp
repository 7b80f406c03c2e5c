// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "sil/commands/commands.hpp"
#include "sil/qualify/qualify.hpp"

namespace sdre {
namespace {

constexpr int short_seeds  = 3;
constexpr int short_motors = 40;
constexpr int short_side   = 5;

struct Options {
    std::string drive;
    std::string json;
    std::string html;
    int         seeds  = 0;
    int         motors = -1;
    int         noise  = 4;
    bool        quick  = false;
    bool        alone  = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--json", o.json, "write the table");
    list.text("--html", o.html, "the same as a page");
    list.number("--seeds", o.seeds, {1, 100000}, "worst of so many seeds (default 10)");
    list.number("--motors", o.motors, {0, 1000000}, "random motors (default 1000)");
    list.number("--noise", o.noise, {1, 100},
                "largest noise of v_q, per cent of the circle (default 4)");
    list.flag("--short", o.quick, "3 seeds, 40 motors, no comparison: seconds");
    list.flag("--alone", o.alone, "without the comparison with pi_foc and ladrc");
}

int run(const Options &o)
{
    QualifyOptions q;
    if (o.quick) {
        q.seeds   = short_seeds;
        q.motors  = short_motors;
        q.side    = short_side;
        q.against = false;
    }
    q.noise_share                  = 0.01 * o.noise;
    q.seeds                        = o.seeds > 0 ? o.seeds : q.seeds;
    q.motors                       = o.motors >= 0 ? o.motors : q.motors;
    q.against                      = q.against && !o.alone;
    const Qualification     result = qualify(read_drive_file(o.drive), q);
    std::vector<OutputFile> files;
    if (!o.json.empty()) {
        files.push_back({o.json, qualification_json(result)});
    }
    if (!o.html.empty()) {
        files.push_back({o.html, qualification_html(result)});
    }
    write_files(files);
    fmt::print("{}", qualification_text(result));
    return result.good() ? exit_ok : exit_fault;
}

} // namespace

Command qualify_command()
{
    return command<Options>("qualify",
                            "put a drive through everything at its own scale; exit code 4 when it "
                            "is not good",
                            declare, run, "sdre-sil qualify my_motor.toml --html my_motor.html");
}

} // namespace sdre
