// SPDX-License-Identifier: MIT
/// The options of `serve` that each board has.
#pragma once

#include <string>

#include "common/command_line.hpp"
#include "sil/serve/server.hpp"

namespace sdre {

struct ServeArguments {
    static constexpr int no_port = -1; ///< not given
    static constexpr int no_node = 0;

    std::string drive;
    std::string machine;
    std::string pty;
    int         tcp          = no_port;
    int         rtu_tcp      = no_port;
    int         control      = no_port;
    double      speed_factor = 1.0;
    double      end_s        = 0.0;
    int         cogging      = 0;
    int         seed         = 1;
    int         slcan_tcp    = no_port;
    int         join         = no_port;
    int         node         = no_node;
    std::string slcan_pty;
};

/// @param shipped Name of the drive when none is given.
void declare_serve(OptionList &list, ServeArguments &a, const char *shipped);

/// The drive that is served.
Drive served_drive(const ServeArguments &a, const char *shipped);

/// Reads the file of the machine.
ServeOptions serve_options(const ServeArguments &a);

/// Port of an option; none: it was not given.
std::optional<int> port(int given);

/// Prints what a person needs to connect, and serves until the end.
/// @param machine The motor on the bench.
void serve(Server &server, const Drive &machine);

} // namespace sdre
