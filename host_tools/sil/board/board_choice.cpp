// SPDX-License-Identifier: MIT
#include "sil/board/board_choice.hpp"

#include "c28_cpu.h"
#include "sil/board/fake_board.hpp"

using sdre::f28335::FakeBoard;

namespace {

FakeBoard *the_fake = nullptr; // board.h's functions are plain, so they need one
bool       hang     = false;

} // namespace

namespace sdre::f28335 {

FakeBoardChoice::FakeBoardChoice(FakeBoard &fake)
{
    the_fake = &fake;
}

FakeBoardChoice::~FakeBoardChoice()
{
    the_fake = nullptr;
}

void hang_ticks(bool now)
{
    hang = now;
}

} // namespace sdre::f28335

extern "C" {

bool            f28335_board_fits(const board_setup_t *setup);
bool            f28335_board_loader_is_wanted(void);
void            f28335_board_restart(bool loader);
uint16_t       *f28335_board_kept(void);
bool            f28335_board_line_fits(const board_line_t *line);
void            f28335_board_line_set(const board_line_t *line);
const uint16_t *f28335_board_store(uint16_t slot);
bool            f28335_board_store_erase(uint16_t slot);
bool            f28335_board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words,
                                           uint16_t count);
bool            f28335_board_init(const board_setup_t *setup);
void            f28335_board_start(void (*tick)(void), uint16_t updates_per_period);
const board_sample_t *f28335_board_sample(void);
void                  f28335_board_duty_write(const board_duty_t *duty);
void                  f28335_board_brake_write(bool release);
void                  f28335_board_chopper_write(bool on);
void                  f28335_board_gate_enable(void);
void                  f28335_board_gate_trip(void);
uint16_t              f28335_board_fault_read(void);
board_reset_t         f28335_board_reset_cause(void);
uint32_t              f28335_board_cycles(void);
bool                  f28335_board_memory_is_whole(void);
void                  f28335_board_watchdog_serve(void);
bool                  f28335_board_serial_read(uint16_t *octet);
bool                  f28335_board_serial_write(uint16_t octet);
bool                  f28335_board_can_fits(uint16_t rate_kbps);
void                  f28335_board_can_set(uint16_t rate_kbps);
void                  f28335_board_can_listen(const uint16_t *ids, uint16_t count);
bool                  f28335_board_can_read(board_can_frame_t *frame);
void                  f28335_board_can_arm();
bool                  f28335_board_can_triggered();
bool                  f28335_board_can_write(const board_can_frame_t *frame);
uint16_t              f28335_board_can_state(void);
uint16_t              f28335_board_inputs(void);

// The fake has no store and never restarts.

bool board_fits(const board_setup_t *setup)
{
    return f28335_board_fits(setup);
}

bool board_loader_is_wanted(void)
{
    return the_fake == nullptr && f28335_board_loader_is_wanted();
}

void board_restart(bool loader)
{
    if (the_fake == nullptr) {
        f28335_board_restart(loader);
    }
}

uint16_t *board_kept(void)
{
    return f28335_board_kept(); // plain memory: the fake may have it too
}

bool board_line_fits(const board_line_t *line)
{
    return f28335_board_line_fits(line);
}

void board_line_set(const board_line_t *line)
{
    if (the_fake == nullptr) {
        f28335_board_line_set(line);
    }
}

const uint16_t *board_store(uint16_t slot)
{
    return the_fake == nullptr ? f28335_board_store(slot) : nullptr;
}

bool board_store_erase(uint16_t slot)
{
    return the_fake == nullptr && f28335_board_store_erase(slot);
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    return the_fake == nullptr && f28335_board_store_program(slot, offset, words, count);
}

bool board_init(const board_setup_t *setup)
{
    if (the_fake == nullptr) {
        return f28335_board_init(setup);
    }
    the_fake->init(*setup);
    return true;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    if (the_fake != nullptr) {
        the_fake->start(tick, updates_per_period);
    } else {
        f28335_board_start(tick, updates_per_period);
    }
}

const board_sample_t *board_sample(void)
{
    while (the_fake == nullptr && hang) {
        f28335_asm(" NOP");
    }
    return the_fake != nullptr ? &the_fake->sample() : f28335_board_sample();
}

void board_duty_write(const board_duty_t *duty)
{
    if (the_fake != nullptr) {
        the_fake->write_duty(*duty);
    } else {
        f28335_board_duty_write(duty);
    }
}

void board_brake_write(bool release)
{
    if (the_fake != nullptr) {
        the_fake->write_brake(release);
    } else {
        f28335_board_brake_write(release);
    }
}

void board_chopper_write(bool on)
{
    if (the_fake != nullptr) {
        the_fake->write_chopper(on);
    } else {
        f28335_board_chopper_write(on);
    }
}

void board_gate_enable(void)
{
    if (the_fake != nullptr) {
        the_fake->enable_gates(true);
    } else {
        f28335_board_gate_enable();
    }
}

void board_gate_trip(void)
{
    if (the_fake != nullptr) {
        the_fake->enable_gates(false);
    } else {
        f28335_board_gate_trip();
    }
}

uint16_t board_fault_read(void)
{
    return the_fake != nullptr ? static_cast<uint16_t>(BOARD_FAULT_NONE)
                               : f28335_board_fault_read();
}

board_reset_t board_reset_cause(void)
{
    return the_fake != nullptr ? BOARD_RESET_PIN : f28335_board_reset_cause();
}

uint32_t board_cycles(void)
{
    return the_fake != nullptr ? the_fake->cycles() : f28335_board_cycles();
}

bool board_memory_is_whole(void)
{
    return the_fake != nullptr || f28335_board_memory_is_whole();
}

void board_watchdog_serve(void)
{
    if (the_fake == nullptr) {
        f28335_board_watchdog_serve();
    }
}

bool board_serial_read(uint16_t *octet)
{
    return the_fake == nullptr && f28335_board_serial_read(octet);
}

bool board_serial_write(uint16_t octet)
{
    return the_fake != nullptr || f28335_board_serial_write(octet); // the fake has no client
}

bool board_can_fits(uint16_t rate_kbps)
{
    return f28335_board_can_fits(rate_kbps);
}

void board_can_set(uint16_t rate_kbps)
{
    if (the_fake == nullptr) {
        f28335_board_can_set(rate_kbps);
    }
}

void board_can_listen(const uint16_t *ids, uint16_t count)
{
    if (the_fake == nullptr) {
        f28335_board_can_listen(ids, count);
    }
}

bool board_can_read(board_can_frame_t *frame)
{
    return the_fake == nullptr && f28335_board_can_read(frame);
}

void board_can_arm()
{
    if (the_fake == nullptr) {
        f28335_board_can_arm();
    }
}

bool board_can_triggered()
{
    return the_fake == nullptr && f28335_board_can_triggered();
}

bool board_can_write(const board_can_frame_t *frame)
{
    return the_fake != nullptr || f28335_board_can_write(frame);
}

uint16_t board_can_state()
{
    return the_fake != nullptr ? std::uint16_t{0} : f28335_board_can_state();
}

uint16_t board_inputs()
{
    return the_fake != nullptr ? std::uint16_t{0} : f28335_board_inputs();
}
}
