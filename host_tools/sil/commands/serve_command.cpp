// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/commands/commands.hpp"
#include "sil/commands/image_program.hpp"
#include "sil/serve/serve_arguments.hpp"

namespace sdre {
namespace {

constexpr const char *shipped = "ipmsm_390w";

struct Options {
    ServeArguments common;
    BoardOption    board;
    std::string    flash;
    bool           boot_rom = false;
};

/// Options of the virtual F28335 alone, and what the simulation of the other board lacks for them.
constexpr std::pair<const char *, const char *> of_f28335[] = {{"--flash", "kept flash"},
                                                               {"--boot-rom", "boot ROM"}};

void declare(OptionList &list, Options &o)
{
    declare_serve(list, o.common, shipped);
    list.text("--flash", o.flash,
              "file that keeps the drive's flash: parameters and image last over its end");
    list.flag("--boot-rom", o.boot_rom,
              "begin as the boot ROM's serial loader on the pseudo-terminal, until it has loaded a "
              "program; then the firmware starts");
    declare_board(list, o.board, {"f28335", board_with_image},
                  "what runs the firmware: f28335 (default; the drivers on a virtual device) or "
                  "stm32g431 (its image on a simulator, by the program sdre-iss)");
}

void serve_image(const Options &o)
{
    const std::vector<std::string> given = o.board.others();
    for (const auto &[option, what] : of_f28335) {
        if (std::find(given.begin(), given.end(), option) != given.end()) {
            throw InputError(
                fmt::format("{}: is not for --board {}, whose simulation has no {}; leave it out",
                            option, board_with_image, what));
        }
    }
    run_image_program("serve", given);
}

int run(const Options &o)
{
    if (o.board.name == board_with_image) {
        serve_image(o);
    }
    require_no_image(o.board);
    ServeOptions s = serve_options(o.common);
    s.flash        = o.flash;
    s.boot_rom     = o.boot_rom;
    if (o.boot_rom && s.pty.empty()) {
        throw InputError("--boot-rom: the ROM loads by a serial line; name one with --pty");
    }
    const Drive own = served_drive(o.common, shipped);
    Server      server(own, static_cast<std::uint64_t>(o.common.seed), s);
    serve(server, s.machine.value_or(own));
    return exit_ok;
}

} // namespace

Command serve_command()
{
    return command<Options>(
        "serve", "a virtual drive to connect to: the firmware on a virtual F28335, in real time",
        declare, run, "sdre-sil serve my_motor.toml --tcp 1502");
}

} // namespace sdre
