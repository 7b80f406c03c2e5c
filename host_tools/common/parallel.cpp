// SPDX-License-Identifier: MIT
#include "common/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
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
    try {
        for (std::size_t i = 1; i < std::min(cores, count); i++) {
            threads.emplace_back(worker);
        }
    } catch (const std::system_error &) { // no more threads to be had: those that are there do it
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
