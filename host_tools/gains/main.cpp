// SPDX-License-Identifier: MIT
/// sdre-gains: drive file -> gains, report, firmware tables.
#include "gains/commands.hpp"

int main(int argc, char **argv)
{
    return sdre::run_tool(
        {"sdre-gains",
         "Gain design for sdre-drive: Riccati and Lyapunov solutions as certified firmware tables.",
         {sdre::generate_command(), sdre::image_command(), sdre::report_command(),
          sdre::describe_command(), sdre::orders_command(), sdre::new_command(),
          sdre::from_commissioning_command(), sdre::tune_command(), sdre::care_command()}},
        argc, argv);
}
