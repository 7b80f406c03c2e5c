// SPDX-License-Identifier: MIT
#include "sil/serve/serve_arguments.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "common/data_files.hpp"
#include "drive/drive_file.hpp"

namespace sdre {
namespace {

constexpr int default_tcp     = 1502; // as Modbus's own 502, for which one has to be root
constexpr int default_control = 1503;
constexpr int ports           = 65535;
constexpr int last_node       = 127;

/// The bench of a second drive is beside that drive.
int control_beside(int tcp)
{
    return tcp > 0 && tcp < ports ? tcp + 1 : default_control;
}

} // namespace

std::optional<int> port(int given)
{
    return given == ServeArguments::no_port ? std::nullopt : std::optional<int>(given);
}

void declare_serve(OptionList &list, ServeArguments &a, const char *shipped)
{
    list.text("DRIVE", a.drive, fmt::format("drive file (TOML; default: the shipped {})", shipped));
    list.text("--machine", a.machine,
              "drive file of the motor and encoder disc on the bench (default: those of DRIVE)");
    list.number("--cogging", a.cogging, {0, 200},
                "amplitude of its cogging, thousandths of the rated torque (default 0)");
    list.text("--pty", a.pty, "Modbus RTU on a pseudo-terminal of this name");
    list.number(
        "--tcp", a.tcp, {0, ports},
        "Modbus/TCP on this port of 127.0.0.1 (default 1502, unless another way is given); 0: any");
    list.number("--rtu-tcp", a.rtu_tcp, {0, ports}, "RTU frames over TCP on this port");
    list.number("--control", a.control, {0, ports},
                "load, supply, faults and the motor itself on this port (default: the next after "
                "--tcp, 1503)");
    list.number("--speed-factor", a.speed_factor, {0.01, 100.0},
                "simulated seconds per second (default 1)");
    list.number("--for", a.end_s, {0.0, 1e9},
                "end after so many simulated seconds (default: never)");
    list.number("--seed", a.seed, {0, 1000000},
                "of the noise and of the rotor's angle (default 1)");
    list.number("--slcan-tcp", a.slcan_tcp, {0, ports},
                "the drive's CAN bus, as slcan over TCP on this port; 0: any");
    list.text("--slcan-pty", a.slcan_pty, "slcan on a pseudo-terminal of this name");
    list.number("--join", a.join, {1, ports},
                "the CAN bus of the drive whose --slcan-tcp has this port: both drives on one bus");
    list.number("--node", a.node, {1, last_node}, "node number of this drive on the CAN bus");
}

Drive served_drive(const ServeArguments &a, const char *shipped)
{
    return read_drive_file(a.drive.empty()
                               ? data_file(fmt::format("firmware/config/drives/{}.toml", shipped))
                               : std::filesystem::path(a.drive));
}

ServeOptions serve_options(const ServeArguments &a)
{
    ServeOptions s;
    s.pty          = a.pty;
    s.tcp          = port(a.tcp);
    s.rtu_tcp      = port(a.rtu_tcp);
    s.control      = port(a.control == ServeArguments::no_port ? control_beside(a.tcp) : a.control);
    s.speed_factor = a.speed_factor;
    if (!a.machine.empty()) {
        s.machine = read_drive_file(a.machine);
    }
    s.cogging_share = 1e-3 * a.cogging;
    s.end_s         = a.end_s;
    s.can           = {port(a.slcan_tcp), a.slcan_pty, port(a.join)};
    s.node          = a.node == ServeArguments::no_node ? std::nullopt : std::optional<int>(a.node);
    if (s.pty.empty() && !s.tcp && !s.rtu_tcp) {
        s.tcp = default_tcp;
    }
    return s;
}

void serve(Server &server, const Drive &machine)
{
    if (const double friction_Nm = bench_friction_Nm(machine); friction_Nm > 0.0) {
        fmt::print(
            "the drive file has no friction; on this bench it is {:.3g} N m, 2 % of the rated "
            "torque\n",
            friction_Nm);
    }
    fmt::print("{}Ctrl-C ends it\n", server.greeting());
    std::fflush(stdout);
    server.run();
}

} // namespace sdre
