// SPDX-License-Identifier: MIT
/// The two ways a host tool fails. main() maps them to exit codes 1 and 2.
#pragma once

#include <stdexcept>

namespace sdre {

/// The user's input is wrong: one line naming file, key, value and what is allowed. Exit code 1.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The input is well formed but no acceptable design exists. Exit code 2.
class DesignError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace sdre
