// SPDX-License-Identifier: MIT
/// Runs a program without a shell and keeps what it says.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "temp_dir.hpp"

namespace support {

struct CommandResult {
    int         exit_code = -1; ///< -1: killed by a signal
    std::string out;
    std::string err;
};

inline CommandResult run_command(std::vector<std::string> arguments)
{
    const TempDir              dir;
    const std::string          out = (dir / "out").string();
    const std::string          err = (dir / "err").string();
    std::vector<char *>        argv;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
    for (std::string &argument : arguments) {
        argv.push_back(argument.data());
    }
    argv.push_back(nullptr);

    pid_t     child   = 0;
    int       status  = 0;
    const int spawned = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (spawned != 0 || waitpid(child, &status, 0) != child) {
        throw std::runtime_error("cannot run " + arguments[0]);
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

/// True for a text of one line that ends with a line feed.
inline bool is_one_line(const std::string &text)
{
    return text.size() > 1 && text.back() == '\n' &&
           std::count(text.begin(), text.end(), '\n') == 1;
}

/// A refusal: this exit code, nothing on stdout, one line on stderr that starts with the tool's name
/// and contains every given piece.
inline void expect_refused(const CommandResult &result, int exit_code, const std::string &tool,
                           const std::vector<std::string> &pieces = {})
{
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_EQ(result.err.rfind(tool + ": ", 0), 0U) << result.err;
    for (const std::string &piece : pieces) {
        EXPECT_NE(result.err.find(piece), std::string::npos) << piece << " not in: " << result.err;
    }
}

} // namespace support
