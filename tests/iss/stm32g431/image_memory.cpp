// SPDX-License-Identifier: MIT
#include "stm32g431/image_memory.hpp"

#include <stdexcept>

namespace iss::stm32g431 {
namespace {

std::uint32_t loaded_word(const ElfImage &image, std::uint32_t address)
{
    for (const ElfSegment &s : image.segments) {
        if (address >= s.address && address + 4U <= s.address + s.octets.size()) {
            std::uint32_t word = 0;
            std::memcpy(&word, &s.octets[address - s.address], sizeof word);
            return word;
        }
    }
    throw std::runtime_error("layout: nothing is loaded at " + std::to_string(address));
}

} // namespace

ImageMemory::ImageMemory(const Core &core, const ElfImage &image, const ElfImage &layout)
    : core_(core), image_(image), layout_(layout)
{
    for (const char *const object : {"shared", "tick_side"}) {
        if (layout_word(std::string("of_") + object, 0) != image_.sizes.at(object)) {
            throw std::runtime_error(std::string("layout: the image has another ") + object);
        }
    }
}

std::uint32_t ImageMemory::layout_word(const std::string &name, std::uint32_t at) const
{
    return loaded_word(layout_, layout_.symbols.at("layout_" + name) + 4U * at);
}

void ImageMemory::read(const char *object, const char *name, void *to, std::size_t octets) const
{
    if (layout_word(name, 1) != octets) {
        throw std::runtime_error(std::string("layout: the image has another size of ") + name);
    }
    core_.read_octets(image_.symbols.at(object) + layout_word(name, 0), to, octets);
}

} // namespace iss::stm32g431
