// SPDX-License-Identifier: MIT
/// A tool is a list of commands; each declares its options and runs. Only command_line.cpp knows the parser.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"

namespace CLI {
class App;
}

namespace sdre {

/// Exit codes that every command shares.
enum ExitCode { exit_ok = 0, exit_bad_input = 1, exit_design_failed = 2 };

/// The options of one command, bound to variables that live until it has run. A name without dashes is a position.
class OptionList {
public:
    explicit OptionList(CLI::App &app) : app_(&app) {}

    void required(const std::string &name, std::string &value, const std::string &help);
    void required(const std::string &name, std::vector<std::string> &values,
                  const std::string &help);
    void text(const std::string &name, std::string &value, const std::string &help);
    void choice(const std::string &name, std::string &value, const std::set<std::string> &allowed,
                const std::string &help);
    void number(const std::string &name, int &value, Range allowed, const std::string &help);
    void number(const std::string &name, double &value, Range allowed, const std::string &help);
    void flag(const std::string &name, bool &value, const std::string &help);
    /// One value each time the option is given.
    void repeated(const std::string &name, std::vector<std::string> &values,
                  const std::string &help);
    void repeated(const std::string &name, std::vector<int> &values, Range allowed,
                  const std::string &help);
    /// The two must not be given together.
    void exclude(const std::string &name, const std::string &other);
    /// After the command line is read: what was given, as a command line, but the option `except`.
    std::vector<std::string> given(const std::string &except) const;

private:
    CLI::App *app_;
};

struct Command {
    std::string                       name;
    std::string                       help;
    std::function<void(OptionList &)> declare;
    std::function<int()>              run;     ///< the exit code; errors.hpp lists the exceptions
    std::string                       example; ///< a line for a shell
};

/// A command from its options and what it does with them:
/// command<Options>("report", "print ..", declare, run, "tool report file") with declare(OptionList &, Options &) and
/// run(const Options &).
template <typename Options, typename Declare, typename Run>
Command command(const std::string &name, const std::string &help, Declare declare, Run run,
                const std::string &example)
{
    const auto options = std::make_shared<Options>();
    return {name, help, [options, declare](OptionList &list) { declare(list, *options); },
            [options, run] { return run(*options); }, example};
}

struct Tool {
    std::string          name;
    std::string          about;
    std::vector<Command> commands;
};

/// main(): parses, runs the command, turns exceptions into one line on stderr and an exit code. A standard output that
/// did not take everything is bad input too.
int run_tool(const Tool &tool, int argc, char **argv);

} // namespace sdre
