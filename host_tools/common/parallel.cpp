// SPDX-License-Identifier: MIT
#include "common/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace sdre {

void parallel_for(std::size_t count, const std::function<void(std::size_t)> &work)
{
    std::vector<std::exception_ptr> errors(count);
    std::atomic<std::size_t>        next{0};
    const auto                      worker = [&]() {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                errors[i] = std::current_exception();
            }
        }
    };
    std::vector<std::thread> threads;
    const std::size_t        cores = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t i = 1; i < std::min(cores, count); i++) {
        threads.emplace_back(worker);
    }
    worker();
    for (std::thread &thread : threads) {
        thread.join();
    }
    for (const std::exception_ptr &error : errors) {
        if (error) {
            std::rethrow_exception(error);
        }
    }
}

} // namespace sdre
