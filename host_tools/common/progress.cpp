// SPDX-License-Identifier: MIT
#include "common/progress.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace sdre {
namespace {

// Chosen: what is done sooner needs no line, and an eye does not follow more.
constexpr std::chrono::milliseconds first{500};
constexpr std::chrono::milliseconds interval{100};
constexpr const char               *clear_line = "\r\x1b[K";

} // namespace

Progress::Progress(std::size_t total, std::string what)
    : total_(total), what_(std::move(what)), shown_(isatty(STDERR_FILENO) == 1),
      next_(std::chrono::steady_clock::now() + first)
{
}

Progress::~Progress()
{
    if (shown_) {
        std::fputs(clear_line, stderr);
    }
}

void Progress::step()
{
    const std::lock_guard<std::mutex> lock(mutex_);
    done_++;
    const auto now = std::chrono::steady_clock::now();
    if (shown_ && now >= next_) {
        next_                  = now + interval;
        const std::string line = fmt::format("{}{} of {} {}", clear_line, done_, total_, what_);
        std::fputs(line.c_str(), stderr);
    }
}

} // namespace sdre
