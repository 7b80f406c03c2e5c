// SPDX-License-Identifier: MIT
/// The application on a board that samples anything, with a line on which anything is said: Modbus requests, and noise.
#include <cstdlib>

#include "bytes.hpp"
#include "fake_board.h"

extern "C" {
#include "app.h"
#include "app_control.h"
#include "app_modbus.h"
#include "board_config.h"
#include "gain_tables.h"
}

namespace {

constexpr unsigned most_octets = 40; // of one message

void require(bool condition)
{
    if (!condition) {
        std::abort();
    }
}

/// Octets of the input on the line; with `crc` as a frame that a server believes.
void say(fuzz::Bytes &in, bool crc)
{
    std::uint16_t  octets[most_octets];
    int            line[most_octets + 2];
    const unsigned count = 1 + in.octet() % most_octets;
    for (unsigned n = 0; n < count; n++) {
        octets[n] = n == 0 && crc ? board_config.modbus_address : in.octet();
        line[n]   = octets[n];
    }
    const std::uint16_t sum = app_modbus_crc(octets, static_cast<std::uint16_t>(count));
    line[count]             = sum & 0xFF;
    line[count + 1]         = sum >> 8;
    fake_board_receive(line, static_cast<int>(crc ? count + 2 : count));
}

/// Makes one reading of the board any.
void sample(fuzz::Bytes &in, int which)
{
    board_sample_t      &s         = fake_board.sample;
    const auto           any       = static_cast<std::uint16_t>(in.word());
    std::uint16_t *const numbers[] = {&s.ia_cnt,          &s.ib_cnt,       &s.dc_link_cnt,
                                      &s.temperature_cnt, &s.position_cnt, &s.edge_age_cnt,
                                      &s.index_cnt,       &s.phase_errors};
    if (which < 8) {
        *numbers[which] = any;
    } else {
        s.index_seen = (any & 1U) != 0U;
        s.edge_seen  = (any & 2U) != 0U;
        s.valid      = (any & 28U) != 0U;
    }
}

bool may_switch(app_mode_t mode)
{
    return mode == APP_MODE_ALIGN || mode == APP_MODE_RUN || mode == APP_MODE_PRECHARGE ||
           mode == APP_MODE_STOP || mode == APP_MODE_COMMISSION;
}

void run(int ticks)
{
    for (int n = 0; n < ticks; n++) {
        fake_board.tick();
        app_background();
        while (fake_board_sent() >= 0) { // the master reads
        }
        const app_status_t status = app_status_read();
        require(fake_board.duty.a_cnt <= board_config.board.duty_full_cnt &&
                fake_board.duty.b_cnt <= board_config.board.duty_full_cnt &&
                fake_board.duty.c_cnt <= board_config.board.duty_full_cnt);
        require((status.mode == APP_MODE_FAULT) == (status.fault != APP_FAULT_NONE));
        require(!fake_board.gate || status.shorted || may_switch(status.mode));
        require(status.mode == APP_MODE_FAULT || app_drive()->state != DRIVE_FAULT);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Bytes in(data, size);
    fake_board_reset();
    app_config_t config    = board_config;
    config.boot_ticks      = 2; // an input is short
    config.calibrate_ticks = 8;
    fake_board_erase_store();
    require(app_init(&config, &gain_tables_drive) == CTL_OK);
    app_take_parameters(APP_PARAMETERS_NOT_ASKED);
    fake_board.tick             = app_tick;
    std::uint16_t target_number = 0;
    while (in.any()) {
        const std::uint8_t what = in.octet();
        switch (what >> 5) {
        case 0:
        case 1:
            say(in, what >> 5 == 0);
            break;
        case 2:
            sample(in, (what & 31) % 9);
            break;
        case 3:
            fake_board_fail(in.octet() & 15U);
            break;
        case 4: { // what an operator does
            static constexpr std::uint16_t words[] = {0, 2, 6, 7, 15, 128, 15 + 256, 15};
            static constexpr std::int16_t  ways[]  = {3, 8, 6, -1};
            app_objects_t                  command = app_control_default(&gain_tables_drive);
            const float                    share   = in.share();
            command.omega_e_radps                  = 800.0F * share;
            command.controlword                    = words[what & 7U];
            command.mode_of_operation              = ways[(what >> 3U) & 3U];
            command.bounds                         = {3.0F, 150.0F};
            command.target_cnt    = static_cast<std::int32_t>(3e3F * share); // a set-point
            command.target_number = ++target_number;
            static_cast<void>(app_command_write(&command));
            break;
        }
        case 5:
            fake_board.sample.position_cnt = static_cast<std::uint16_t>(
                (fake_board.sample.position_cnt + (what & 31U)) % board_config.board.positions);
            break;
        default:
            run((what & 63) * 4);
        }
        run(1);
    }
    return 0;
}
