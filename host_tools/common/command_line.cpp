// SPDX-License-Identifier: MIT
#include "common/command_line.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/version.hpp"

namespace sdre {
namespace {

CLI::Range range_of(Range allowed)
{
    return {static_cast<int>(allowed.lo), static_cast<int>(allowed.hi)};
}

std::string names_of(const std::vector<Command> &commands)
{
    std::vector<std::string> names;
    for (const Command &command : commands) {
        names.push_back(command.name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Message for a wrong command line. The parser reports missing arguments before unknown ones, and
/// a slip in a name is both.
std::string complaint(const CLI::App &app, const Tool &tool, const CLI::ParseError &error)
{
    const std::vector<std::string> unknown = app.remaining(true);
    if (unknown.empty()) {
        return error.what();
    }
    if (app.get_subcommands().empty()) {
        return fmt::format("{}: there is no such {}; subcommands: {}", unknown[0],
                           unknown[0][0] == '-' ? "option" : "subcommand", names_of(tool.commands));
    }
    return fmt::format("{}: was not expected; options: {} {} --help", unknown[0], tool.name,
                       app.get_subcommands()[0]->get_name());
}

[[noreturn]] void fail_to_print(int error)
{
    throw InputError(fmt::format("standard output: cannot write: {}", std::strerror(error)));
}

/// A full disk shows when the buffer is written, not when the text is printed.
void require_printed()
{
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
        fail_to_print(errno);
    }
}

/// A text that fills the buffer shows it at once.
int run_printing(const Command &command)
{
    try {
        return command.run();
    } catch (const std::system_error &e) {
        if (std::ferror(stdout) != 0) {
            fail_to_print(e.code().value());
        }
        throw;
    }
}

int parse_and_run(const Tool &tool, int argc, char **argv)
{
    CLI::App app{tool.about};
    app.require_subcommand(1);
    app.set_version_flag("--version", fmt::format("{} {}", tool.name, tool_version));
    const Command *chosen = nullptr;
    for (const Command &command : tool.commands) {
        CLI::App  *sub = app.add_subcommand(command.name, command.help);
        OptionList options(*sub);
        command.declare(options);
        sub->footer(fmt::format("Example:\n  {}", command.example));
        sub->final_callback([&chosen, &command] { chosen = &command; });
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        if (e.get_exit_code() != 0) {
            throw InputError(complaint(app, tool, e));
        }
        const int code = app.exit(e); // --help, --version
        require_printed();
        return code;
    }
    const int code = run_printing(*chosen);
    require_printed();
    return code;
}

} // namespace

void OptionList::required(const std::string &name, std::string &value, const std::string &help)
{
    app_->add_option(name, value, help)->required();
}

void OptionList::required(const std::string &name, std::vector<std::string> &values,
                          const std::string &help)
{
    app_->add_option(name, values, help)->required();
}

void OptionList::text(const std::string &name, std::string &value, const std::string &help)
{
    app_->add_option(name, value, help);
}

void OptionList::choice(const std::string &name, std::string &value,
                        const std::set<std::string> &allowed, const std::string &help)
{
    app_->add_option(name, value, help)->check(CLI::IsMember(allowed));
}

void OptionList::number(const std::string &name, int &value, Range allowed, const std::string &help)
{
    app_->add_option(name, value, help)->check(range_of(allowed));
}

void OptionList::number(const std::string &name, double &value, Range allowed,
                        const std::string &help)
{
    app_->add_option(name, value, help)->check(CLI::Range(allowed.lo, allowed.hi));
}

void OptionList::flag(const std::string &name, bool &value, const std::string &help)
{
    app_->add_flag(name, value, help);
}

void OptionList::repeated(const std::string &name, std::vector<std::string> &values,
                          const std::string &help)
{
    app_->add_option(name, values, help)->allow_extra_args(false);
}

void OptionList::repeated(const std::string &name, std::vector<int> &values, Range allowed,
                          const std::string &help)
{
    app_->add_option(name, values, help)->allow_extra_args(false)->check(range_of(allowed));
}

void OptionList::exclude(const std::string &name, const std::string &other)
{
    app_->get_option(name)->excludes(app_->get_option(other));
}

std::vector<std::string> OptionList::given(const std::string &except) const
{
    std::vector<std::string> all;
    for (const CLI::Option *const option : app_->get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || name == except) {
            continue;
        }
        const bool is_flag = option->get_expected_min() == 0;
        for (const std::string &value : option->results()) {
            if (!option->get_positional()) {
                all.push_back(name);
            }
            if (!is_flag) {
                all.push_back(value);
            }
        }
    }
    return all;
}

int run_tool(const Tool &tool, int argc, char **argv)
{
    try {
        return parse_and_run(tool, argc, argv);
    } catch (const DesignError &e) {
        fmt::print(stderr, "{}: {}\n", tool.name, e.what());
        return exit_design_failed;
    } catch (const std::exception &e) {
        fmt::print(stderr, "{}: {}\n", tool.name, e.what());
        return exit_bad_input;
    }
}

} // namespace sdre
