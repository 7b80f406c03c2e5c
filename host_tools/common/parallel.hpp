// SPDX-License-Identifier: MIT
/// Independent runs on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace sdre {

/// Calls work(0) .. work(count - 1), each once, on as many threads as there are cores. The first exception by
/// number is thrown again when all are done.
void parallel_for(std::size_t count, const std::function<void(std::size_t)> &work);

} // namespace sdre
