// SPDX-License-Identifier: MIT
/// Specifications of `sdre-gains tune`.
#include "reader.hpp"
#include "tune/tune_spec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    return fuzz::read(data, size,
                      [](const auto &file) { static_cast<void>(sdre::read_tune_spec(file)); });
}
