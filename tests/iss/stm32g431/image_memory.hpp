// SPDX-License-Identifier: MIT
/// The application's variables in the memory of a running image.
#pragma once

#include <cstring>
#include <string>

#include "core.hpp"

namespace iss::stm32g431 {

class ImageMemory {
public:
    /// @param layout layout.c, compiled. std::runtime_error when it is not of this image.
    ImageMemory(const Core &core, const ElfImage &image, const ElfImage &layout);

    /// A value by its name in layout.c, which has the type's size.
    template <typename T> T get(const char *object, const char *name) const
    {
        T value{};
        read(object, name, &value, sizeof value);
        return value;
    }

private:
    void          read(const char *object, const char *name, void *to, std::size_t octets) const;
    std::uint32_t layout_word(const std::string &name, std::uint32_t at) const;

    const Core     &core_;
    const ElfImage &image_;
    const ElfImage &layout_;
};

} // namespace iss::stm32g431
