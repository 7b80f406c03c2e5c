// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "sil/commands/commands.hpp"
#include "sil/eval/bench.hpp"

namespace sdre {
namespace {

struct Options {
    std::string scenario;
};

void declare(OptionList &list, Options &o)
{
    list.text("SCENARIO", o.scenario, "scenario file (default: Fig. 5)");
}

int run(const Options &o)
{
    fmt::print("{}", bench_text(o.scenario.empty() ? default_bench_scenario()
                                                   : std::filesystem::path(o.scenario)));
    return exit_ok;
}

} // namespace

Command bench_command()
{
    return command<Options>("bench", "print the speed of the simulation", declare, run,
                            "sdre-sil bench");
}

} // namespace sdre
