// SPDX-License-Identifier: MIT
/// Bits that are flipped in a running program, each in a process of its own that starts from the same instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "common/random.hpp"

namespace support {

struct BitFlip {
    std::size_t place = 0; ///< of the bits
    int         code  = 0; ///< with which the process ended; -1: by a signal
};

/// SDRE_BIT_FLIPS of these bits, or `short_form`, evenly drawn. `flip_and_go_on` is called in the child and must not return.
template <typename Child>
std::vector<BitFlip> flip_bits(std::size_t bits, int short_form, const Child &flip_and_go_on)
{
    const sdre::EvenNumbers even(7, sdre::NoiseStream::start_angle);
    const char *const       wanted = std::getenv("SDRE_BIT_FLIPS");
    const int               flips  = wanted != nullptr ? std::atoi(wanted) : short_form;
    std::vector<BitFlip>    all;
    for (int n = 0; n < flips; n++) {
        const double from_0_to_1 = 0.5 + 0.5 * even.at(static_cast<std::uint64_t>(n));
        const auto   place =
            static_cast<std::size_t>(from_0_to_1 * (static_cast<double>(bits) - 1.0));
        const pid_t child = fork();
        if (child == 0) {
            flip_and_go_on(place);
        }
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) != child) {
            throw std::runtime_error("no process for a flip");
        }
        all.push_back({place, WIFEXITED(status) ? WEXITSTATUS(status) : -1});
    }
    return all;
}

} // namespace support
