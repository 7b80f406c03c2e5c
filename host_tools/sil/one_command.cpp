// SPDX-License-Identifier: MIT
/// One command of sdre-sil as a program: a first `./dev serve` or `./dev demo` builds no other.
#include "sil/commands/commands.hpp"

int main(int argc, char **argv)
{
    return sdre::run_tool({"sdre-sil",
                           "Closed-loop simulation of the sdre-drive control core.",
                           {sdre::SDRE_COMMAND()}},
                          argc, argv);
}
