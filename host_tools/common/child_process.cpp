// SPDX-License-Identifier: MIT
#include "common/child_process.hpp"

#include <cstdio>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sdre {

int run_program(const std::vector<std::string> &arguments)
{
    std::vector<char *> argv;
    for (const std::string &argument : arguments) {
        argv.push_back(const_cast<char *>(argument.c_str())); // posix_spawn does not write to them
    }
    argv.push_back(nullptr);
    std::fflush(nullptr); // what this program has printed comes first
    pid_t child  = 0;
    int   status = 0;
    if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0 ||
        waitpid(child, &status, 0) != child) {
        return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::filesystem::path program_beside(const std::string &name)
{
    std::error_code             none;
    const std::filesystem::path own  = std::filesystem::read_symlink("/proc/self/exe", none);
    std::filesystem::path       file = own.parent_path() / name;
    return !own.empty() && std::filesystem::exists(file, none) ? file : std::filesystem::path();
}

std::string shell_word(const std::string &text)
{
    constexpr const char *plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=+,@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) {
        return text;
    }
    std::string quoted = "'";
    for (const char c : text) {
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return quoted + "'";
}

} // namespace sdre
