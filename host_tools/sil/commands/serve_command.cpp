// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "common/data_files.hpp"
#include "common/errors.hpp"
#include "drive/drive_file.hpp"
#include "sil/commands/commands.hpp"
#include "sil/serve/server.hpp"

namespace sdre {
namespace {

constexpr int default_tcp     = 1502; // as Modbus's own 502, for which one has to be root
constexpr int default_control = 1503;
constexpr int ports           = 65535;
constexpr int any_port        = -1; // not given
constexpr int no_node         = 0;
constexpr int last_node       = 127;

struct Options {
    std::string drive;
    std::string machine;
    std::string pty;
    std::string flash;
    int         tcp       = any_port;
    int         rtu_tcp   = any_port;
    int         control   = any_port;
    int         slcan_tcp = any_port;
    int         join      = any_port;
    int         node      = no_node;
    std::string slcan_pty;
    double      speed_factor = 1.0;
    double      end_s        = 0.0;
    int         cogging      = 0;
    int         seed         = 1;
    bool        boot_rom     = false;
};

void declare(OptionList &list, Options &o)
{
    list.text("DRIVE", o.drive, "drive file (TOML; default: the shipped ipmsm_390w)");
    list.text("--machine", o.machine,
              "drive file of the motor and encoder disc on the bench (default: those of DRIVE)");
    list.number("--cogging", o.cogging, {0, 200},
                "amplitude of its cogging, thousandths of the rated torque (default 0)");
    list.text("--pty", o.pty, "Modbus RTU on a pseudo-terminal of this name");
    list.number(
        "--tcp", o.tcp, {0, ports},
        "Modbus/TCP on this port of 127.0.0.1 (default 1502, unless another way is given); 0: any");
    list.number("--rtu-tcp", o.rtu_tcp, {0, ports}, "RTU frames over TCP on this port");
    list.number("--control", o.control, {0, ports},
                "load, supply, faults and the motor itself on this port (default: the next after "
                "--tcp, 1503)");
    list.number("--slcan-tcp", o.slcan_tcp, {0, ports},
                "the drive's CAN bus, as slcan over TCP on this port; 0: any");
    list.text("--slcan-pty", o.slcan_pty, "slcan on a pseudo-terminal of this name");
    list.number("--join", o.join, {1, ports},
                "the CAN bus of the drive whose --slcan-tcp has this port: both drives on one bus");
    list.number("--node", o.node, {1, last_node}, "node number of this drive on the CAN bus");
    list.text("--flash", o.flash,
              "file that keeps the drive's flash: parameters and image last over its end");
    list.number("--speed-factor", o.speed_factor, {0.01, 100.0},
                "simulated seconds per second (default 1)");
    list.number("--for", o.end_s, {0.0, 1e9},
                "end after so many simulated seconds (default: never)");
    list.flag("--boot-rom", o.boot_rom,
              "begin as the boot ROM's serial loader on the pseudo-terminal, until it has loaded a "
              "program; then the firmware starts");
    list.number("--seed", o.seed, {0, 1000000},
                "of the noise and of the rotor's angle (default 1)");
}

std::optional<int> port(int given)
{
    return given == any_port ? std::nullopt : std::optional<int>(given);
}

/// The bench of a second drive is beside that drive.
int control_beside(int tcp)
{
    return tcp > 0 && tcp < ports ? tcp + 1 : default_control;
}

int run(const Options &o)
{
    ServeOptions s;
    s.pty          = o.pty;
    s.tcp          = port(o.tcp);
    s.rtu_tcp      = port(o.rtu_tcp);
    s.control      = port(o.control == any_port ? control_beside(o.tcp) : o.control);
    s.can          = {port(o.slcan_tcp), o.slcan_pty, port(o.join)};
    s.node         = o.node == no_node ? std::nullopt : std::optional<int>(o.node);
    s.flash        = o.flash;
    s.speed_factor = o.speed_factor;
    if (!o.machine.empty()) {
        s.machine = read_drive_file(o.machine);
    }
    s.cogging_share = 1e-3 * o.cogging;
    s.end_s         = o.end_s;
    s.boot_rom      = o.boot_rom;
    if (o.boot_rom && s.pty.empty()) {
        throw InputError("--boot-rom: the ROM loads by a serial line; name one with --pty");
    }
    if (s.pty.empty() && !s.tcp && !s.rtu_tcp) {
        s.tcp = default_tcp;
    }
    const auto  drive = o.drive.empty() ? data_file("firmware/config/drives/ipmsm_390w.toml")
                                        : std::filesystem::path(o.drive);
    const Drive own   = read_drive_file(drive);
    Server      server(own, static_cast<std::uint64_t>(o.seed), s);
    if (const double friction_Nm = bench_friction_Nm(s.machine.value_or(own)); friction_Nm > 0.0) {
        fmt::print(
            "the drive file has no friction; on this bench it is {:.3g} N m, 2 % of the rated "
            "torque\n",
            friction_Nm);
    }
    fmt::print("{}Ctrl-C ends it\n", server.greeting());
    std::fflush(stdout);
    server.run();
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
