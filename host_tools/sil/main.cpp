// SPDX-License-Identifier: MIT
/// sdre-sil: the control core in closed loop with a simulated motor.
#include "sil/commands/commands.hpp"

int main(int argc, char **argv)
{
    return sdre::run_tool(
        {"sdre-sil",
         "Closed-loop simulation of the sdre-drive control core.",
         {sdre::run_command(), sdre::compare_command(), sdre::motors_command(),
          sdre::bench_command(), sdre::qualify_command(), sdre::commission_command(),
          sdre::verify_command(), sdre::serve_command()}},
        argc, argv);
}
