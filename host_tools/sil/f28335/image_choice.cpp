// SPDX-License-Identifier: MIT
// Adds the time of the CRC over the stored images. On the device it is most of the start-up time.
#include <algorithm>

#include "sil/f28335/device.hpp"
#include "sil/f28335/firmware.hpp"

extern "C" {
#include "app_image.h"
#include "store.h"

const std::uint16_t *f28335_board_store(std::uint16_t slot);
bool f28335_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive,
                         const board_identity_t *board);
int  firmware_main(void);
}

namespace {

// Estimated: 16 bits with a shift, a test and an exclusive or of 32 bits each, from the flash.
constexpr std::int64_t cycles_per_word = 200;

std::int64_t summed_words()
{
    std::int64_t words = 0;
    for (std::uint16_t slot = 0; slot < 2; slot++) {
        const std::uint16_t *const head  = f28335_board_store(slot);
        const std::int64_t         count = (std::int64_t{head[2]} << 16) | head[3];
        words += head[0] == STORE_MARK && count <= std::int64_t{store_room()} ? count : 0;
    }
    return words;
}

} // namespace

bool f28335_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive,
                         const board_identity_t *board)
{
    sdre::f28335::Device::current().spend_cycles(cycles_per_word * summed_words());
    return app_image_choose(chosen, app, drive, board);
}

sdre::f28335::Firmware sdre::f28335::whole_firmware()
{
    return {firmware_main, firmware_start, firmware_pass};
}
