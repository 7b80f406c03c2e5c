// SPDX-License-Identifier: MIT
/// The SCI loader of an F28335's boot ROM, from the reset to the branch into the program that it has loaded.
///
/// "A" locks the rate. From then on every octet is answered with itself. The stream has words, low octet first: 08AAh, 8
/// reserved words, the entry, then blocks. A block has a length, an address and as many words. A length of 0 ends the
/// stream. Entry and addresses have two words, the high one first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace sdre {

class BootRom {
public:
    /// The answer to an octet; none while the rate is not locked, or when the stream has ended.
    std::optional<std::uint8_t> answer(std::uint8_t octet);
    /// The stream has ended, or its first word is another key: the ROM then starts what is in the flash.
    bool over() const
    {
        return over_;
    }
    bool loaded() const
    {
        return over_ && loaded_;
    }
    /// The RAM that the stream has written.
    const std::map<std::uint32_t, std::uint16_t> &memory() const
    {
        return memory_;
    }
    std::uint32_t entry() const
    {
        return entry_;
    }
    /// One line about what became of the stream.
    std::string said() const;

private:
    void take_word(std::uint16_t word);
    void take_block_word(std::uint16_t word);
    void store(std::uint16_t word);

    bool                                   locked_ = false;
    bool                                   over_   = false;
    bool                                   loaded_ = false;
    std::optional<std::uint8_t>            low_;       ///< first octet of a word
    std::size_t                            words_ = 0; ///< before the first block
    std::size_t                            head_  = 0; ///< words of the block's head that have come
    std::uint16_t                          left_  = 0; ///< words of the block that are to come
    std::uint32_t                          at_    = 0;
    std::uint32_t                          entry_ = 0;
    std::map<std::uint32_t, std::uint16_t> memory_;
    std::size_t                            lost_ = 0; ///< words for addresses that are no RAM
};

} // namespace sdre
