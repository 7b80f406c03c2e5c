// SPDX-License-Identifier: MIT
/// A client that loads images of constants into the drive's flash.
#pragma once

#include <cstring>

#include "loaded_image.hpp"

extern "C" {
#include "app_control.h"
#include "app_loader.h"
#include "app_modes.h"
#include "app_registers.h"
#include "crc32.h"
}

namespace sdre {

class LoadingClient : public ServedClient {
protected:
    int loader(unsigned number)
    {
        return input(APP_LOADER_FIRST + number);
    }
    /// Object 80h of function 43/14.
    std::string name()
    {
        const Octets answer = ask({43, 14, 4, 0x80});
        return answer.size() > 9 ? std::string(answer.begin() + 9, answer.end()) : "";
    }
    bool command(unsigned what, const Words &behind = {})
    {
        Words words{static_cast<std::uint16_t>(what)};
        words.insert(words.end(), behind.begin(), behind.end());
        return write(APP_LOADER_FIRST, words);
    }
    /// A command and the end of its work.
    bool work(unsigned what, const Words &behind, int state)
    {
        if (!command(what, behind)) {
            return false;
        }
        pass(erased_s);
        return loader(APP_LOADER_STATE) == state;
    }
    void enter()
    {
        ASSERT_TRUE(command(APP_LOADER_ENTER));
        pass(0.1);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_IDLE);
    }
    bool put(const Words &words)
    {
        for (std::size_t at = 0; at < words.size(); at += APP_LOADER_DATA) {
            Words part{0, static_cast<std::uint16_t>(at)};
            part.insert(part.end(), words.begin() + static_cast<std::ptrdiff_t>(at),
                        words.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                                            at + APP_LOADER_DATA, words.size())));
            if (!write(APP_LOADER_FIRST + APP_LOADER_OFFSET_HI, part)) {
                return false;
            }
        }
        return true;
    }
    bool commit(const Words &words, int state = APP_LOADER_STORED)
    {
        const auto          count = static_cast<std::uint32_t>(words.size());
        const std::uint32_t crc   = crc32_words(CRC32_START, words.data(), count);
        return work(APP_LOADER_COMMIT,
                    {0, static_cast<std::uint16_t>(count), static_cast<std::uint16_t>(crc >> 16U),
                     static_cast<std::uint16_t>(crc)},
                    state);
    }
    float loader_float(unsigned number)
    {
        const std::uint32_t bits = static_cast<std::uint32_t>(loader(number)) << 16U |
                                   static_cast<std::uint32_t>(loader(number + 1));
        float value = 0.0F;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    std::string field_name()
    {
        std::string s;
        for (unsigned n = 0; n < APP_LOADER_NAME_WORDS; n++) {
            const int word = loader(APP_LOADER_FIELD_NAME + n);
            s += static_cast<char>(word >> 8);
            s += static_cast<char>(word & 0xFF);
        }
        return s.c_str();
    }
    void load(const Words &words)
    {
        enter();
        ASSERT_TRUE(work(APP_LOADER_BEGIN, {0, static_cast<std::uint16_t>(words.size())},
                         APP_LOADER_WRITING));
        ASSERT_TRUE(put(words));
        ASSERT_TRUE(commit(words));
        ASSERT_TRUE(command(APP_LOADER_LEAVE));
        pass(0.5);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    }
};

} // namespace sdre
