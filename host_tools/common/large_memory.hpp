// SPDX-License-Identifier: MIT
/// Memory that may be larger than the machine's. From a certain size on it is an unnamed file. The
/// system keeps that file in memory while there is room, and otherwise on the disk.
#pragma once

#include <cstddef>
#include <new>

namespace sdre {

/// From here on a file. Chosen: some hundred thousand rows of a trace, more than any shipped scenario has.
constexpr std::size_t large_memory_B = std::size_t{1} << 26;

/// InputError when the disk of the temporary files has no room.
void *large_memory_get(std::size_t bytes);
void  large_memory_put(void *memory, std::size_t bytes);

/// For std::vector.
template <typename T> struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <typename U> LargeAllocator(const LargeAllocator<U> & /*other*/) {}

    T *allocate(std::size_t n)
    {
        if (n > static_cast<std::size_t>(-1) / sizeof(T)) {
            throw std::bad_alloc();
        }
        return static_cast<T *>(large_memory_get(n * sizeof(T)));
    }
    void deallocate(T *memory, std::size_t n)
    {
        large_memory_put(memory, n * sizeof(T));
    }
    friend bool operator==(const LargeAllocator & /*a*/, const LargeAllocator & /*b*/)
    {
        return true;
    }
    friend bool operator!=(const LargeAllocator & /*a*/, const LargeAllocator & /*b*/)
    {
        return false;
    }
};

} // namespace sdre
