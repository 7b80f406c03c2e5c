// SPDX-License-Identifier: MIT
/// Other programs, with the standard streams of this one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sdre {

/// Runs a program to its end; without a slash it is searched in PATH.
/// @return its exit code, -1 when it did not start or a signal ended it.
int run_program(const std::vector<std::string> &arguments);

/// A program in the directory of this one; empty when there is none.
std::filesystem::path program_beside(const std::string &name);

/// A word of a line that a person copies into a shell: in quotes when the shell would split or change it.
std::string shell_word(const std::string &text);

} // namespace sdre
