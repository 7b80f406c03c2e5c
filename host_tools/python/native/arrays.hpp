// SPDX-License-Identifier: MIT
/// NumPy arrays that own what they show.
#pragma once

#include <memory>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

namespace sdre {

/// Row by row.
template <typename T>
nanobind::ndarray<nanobind::numpy, T, nanobind::c_contig>
numpy_array(std::vector<T> values, std::initializer_list<std::size_t> shape)
{
    auto              kept = std::make_unique<std::vector<T>>(std::move(values));
    T                *data = kept->data();
    nanobind::capsule owner(kept.get(), [](void *p) noexcept {
        delete static_cast<std::vector<T> *>(p); // NumPy calls it after the last reference is gone
    });
    kept.release();
    return {data, shape, owner};
}

} // namespace sdre
