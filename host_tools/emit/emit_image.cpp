// SPDX-License-Identifier: MIT
#include "emit/emit_image.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/board/board_constants.hpp"
#include "design/board/identity.hpp"
#include "design/named_constants.hpp"

extern "C" {
#include "app_disc.h"
#include "crc32.h"
#include "drive_image.h"
#include "store.h"
}

namespace sdre {
namespace {

constexpr std::size_t hex_words = 16; // of a line

std::uint16_t high(std::uint32_t x)
{
    return static_cast<std::uint16_t>(x >> 16U);
}

std::uint16_t low(std::uint32_t x)
{
    return static_cast<std::uint16_t>(x & 0xFFFFU);
}

std::string hex_line(unsigned kind, unsigned address, const std::vector<std::uint16_t> &words)
{
    std::vector<unsigned> octets{static_cast<unsigned>(2 * words.size()), address >> 8U,
                                 address & 0xFFU, kind};
    for (const std::uint16_t word : words) {
        octets.push_back(static_cast<unsigned>(word) >> 8U);
        octets.push_back(word & 0xFFU);
    }
    unsigned    sum  = 0;
    std::string line = ":";
    for (const unsigned octet : octets) {
        line += fmt::format("{:02X}", octet);
        sum += octet;
    }
    return line + fmt::format("{:02X}\n", (0x100U - (sum & 0xFFU)) & 0xFFU);
}

std::unique_ptr<drive_image_t> image_of(const Design &design)
{
    auto                   image    = std::make_unique<drive_image_t>();
    BoardConstants         board    = board_constants(design.drive);
    const board_identity_t identity = board_identity_of(design.drive);
    if (!drive_image_copy(image.get(), &board.bind(), &design.config, &identity)) {
        throw DesignError(fmt::format("{}: its constants do not fit an image", design.drive.name));
    }
    return image;
}

} // namespace

std::vector<std::uint16_t> image_words(const Design &design)
{
    const auto                 image = image_of(design);
    std::vector<std::uint16_t> words(drive_image_write(image.get(), nullptr, 0));
    if (drive_image_write(image.get(), words.data(), static_cast<std::uint32_t>(words.size())) !=
        words.size()) {
        throw std::logic_error("image: two lengths");
    }
    return words;
}

std::vector<std::uint16_t> read_disc_map(const std::filesystem::path &file, const Drive &drive)
{
    const std::string          octets = read_text_file(file);
    std::vector<std::uint16_t> words;
    for (std::size_t n = 0; n + 1 < octets.size(); n += 2) {
        words.push_back(static_cast<std::uint16_t>((static_cast<unsigned char>(octets[n]) << 8U) |
                                                   static_cast<unsigned char>(octets[n + 1])));
    }
    if (words.size() < APP_DISC_HEAD_WORDS || words[0] != APP_DISC_FORMAT ||
        octets.size() % 2 != 0 ||
        words.size() != APP_DISC_HEAD_WORDS + (words[1] + std::size_t{1}) / 2) {
        throw InputError(fmt::format("{}: is no map of sdre-drive disc-map learn", file.string()));
    }
    const int positions = 4 * drive.encoder.lines;
    if (words[1] != positions) {
        throw InputError(fmt::format("{}: is of a disc with {} edges, and {} has {}", file.string(),
                                     words[1], drive.name, positions));
    }
    return words;
}

std::string image_list(const Design &design)
{
    constexpr int numbers =
        2 + DRIVE_IMAGE_DIGEST_WORDS + DRIVE_IMAGE_NAME_WORDS + BOARD_NAME_WORDS;
    const auto image     = image_of(design);
    auto       constants = named_constants(
        [&](fields_t &f) { drive_image_fields(&f, image.get(), design.config.law); });
    const auto is_text = [](const NamedConstant &c) {
        return c.name == "digest" || c.name == "name" || c.name == "board_name";
    };
    constants.erase(std::remove_if(constants.begin(), constants.end(), is_text), constants.end());
    return constants_list(constants, numbers);
}

std::string image_octets(const std::vector<std::uint16_t> &words)
{
    std::string octets;
    for (const std::uint16_t word : words) {
        octets += static_cast<char>(word >> 8U);
        octets += static_cast<char>(word & 0xFFU);
    }
    return octets;
}

std::string image_hex(const std::vector<std::uint16_t> &words, const Processor &processor)
{
    if (!processor.store_address) {
        throw InputError(fmt::format("--hex is not for the processor {}: its flash is loaded over "
                                     "the serial line (sdre-drive load)",
                                     processor.name));
    }
    const std::uint32_t        store_address = *processor.store_address;
    const auto                 count         = static_cast<std::uint32_t>(words.size());
    std::vector<std::uint16_t> all{STORE_MARK, STORE_IMAGE, high(count), low(count), 0, 1};
    const std::uint32_t        crc =
        crc32_words(crc32_words(CRC32_START, &all[1], 5), words.data(), count);
    all.push_back(high(crc));
    all.push_back(low(crc));
    all.insert(all.end(), words.begin(), words.end());

    std::string s = hex_line(4, 0, {high(store_address)});
    for (std::size_t n = 0; n < all.size(); n += hex_words) {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(n);
        const auto to =
            all.begin() + static_cast<std::ptrdiff_t>(std::min(n + hex_words, all.size()));
        s += hex_line(0, low(store_address + static_cast<std::uint32_t>(n)), {from, to});
    }
    return s + hex_line(1, 0, {});
}

} // namespace sdre
