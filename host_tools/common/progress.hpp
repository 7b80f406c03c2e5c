// SPDX-License-Identifier: MIT
/// One line on stderr that counts up while many runs are under way, on a terminal only.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace sdre {

class Progress {
public:
    /// "12 of 100 seeds" is total = 100, what = "seeds".
    Progress(std::size_t total, std::string what);
    /// Clears the line.
    ~Progress();
    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    /// One more is done; from any thread.
    void step();

private:
    std::size_t                           total_;
    std::string                           what_;
    bool                                  shown_;
    std::mutex                            mutex_;
    std::size_t                           done_ = 0;
    std::chrono::steady_clock::time_point next_;
};

} // namespace sdre
