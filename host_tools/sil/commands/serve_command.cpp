// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/commands/commands.hpp"
#include "sil/commands/image_program.hpp"
#include "sil/serve/serve_arguments.hpp"

namespace sdre {
namespace {

constexpr const char *shipped   = "ipmsm_390w";
constexpr int         ports     = 65535;
constexpr int         no_node   = 0;
constexpr int         last_node = 127;

struct Options {
    ServeArguments common;
    BoardOption    board;
    std::string    flash;
    int            slcan_tcp = ServeArguments::no_port;
    int            join      = ServeArguments::no_port;
    int            node      = no_node;
    std::string    slcan_pty;
    bool           boot_rom = false;
};

/// Options of the virtual F28335 alone, and what the simulation of the other board lacks for them.
constexpr std::pair<const char *, const char *> of_f28335[] = {
    {"--slcan-tcp", "CAN bus"}, {"--slcan-pty", "CAN bus"}, {"--join", "CAN bus"},
    {"--node", "CAN bus"},      {"--flash", "kept flash"},  {"--boot-rom", "boot ROM"}};

void declare(OptionList &list, Options &o)
{
    declare_serve(list, o.common, shipped);
    list.number("--slcan-tcp", o.slcan_tcp, {0, ports},
                "the drive's CAN bus, as slcan over TCP on this port; 0: any");
    list.text("--slcan-pty", o.slcan_pty, "slcan on a pseudo-terminal of this name");
    list.number("--join", o.join, {1, ports},
                "the CAN bus of the drive whose --slcan-tcp has this port: both drives on one bus");
    list.number("--node", o.node, {1, last_node}, "node number of this drive on the CAN bus");
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
    s.can          = {port(o.slcan_tcp), o.slcan_pty, port(o.join)};
    s.node         = o.node == no_node ? std::nullopt : std::optional<int>(o.node);
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
