// SPDX-License-Identifier: MIT
/// The example at the end of each command's help.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "temp_dir.hpp"

namespace support {

/// Names of the commands that a tool's help lists.
inline std::vector<std::string> commands_of(const std::string &program)
{
    const std::string        text = run_command({program, "--help"}).out;
    std::istringstream       rows(text.substr(text.find("Subcommands:")));
    std::vector<std::string> names;
    std::string              row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
        if (row.size() > 2 && row[2] != ' ') {
            names.push_back(row.substr(2, row.find(' ', 2) - 2));
        }
    }
    return names;
}

/// Each command has an example. Without its files the tool misses one of them, so the options are the command's.
inline void expect_examples(const std::string &program, const std::string &tool)
{
    const TempDir dir;
    for (const std::string &name : commands_of(program)) {
        const std::string text = run_command({program, name, "--help"}).out;
        const std::size_t at   = text.find("\nExample:\n  " + tool + " " + name);
        ASSERT_NE(at, std::string::npos) << text;
        const std::string line = text.substr(text.find(tool, at) + tool.size());
        if (line.find(".toml") == std::string::npos && line.find(".json") == std::string::npos) {
            continue; // runs without a file
        }
        const CommandResult r = run_command(
            {"/bin/sh", "-c", "cd \"$1\" && exec \"$2\" " + line, "sh", dir.path(), program});
        EXPECT_EQ(r.exit_code, 1) << line;
        EXPECT_TRUE(r.err.find(": no such file") != std::string::npos ||
                    r.err.find(": cannot") != std::string::npos)
            << line << r.err;
    }
}

} // namespace support
