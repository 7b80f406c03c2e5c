// SPDX-License-Identifier: MIT
// Runs trip.c and line.c with an interrupt at every memory access, of a register or a variable. The
// compiler marks the accesses with ThreadSanitizer's calls. At each of them the control interrupt
// interrupts the background, or INT13 interrupts the tick. The registers model only what the trip
// needs: TZFRC, TZCLR, the input, the enable pin.
#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sil/f28335/registers.hpp"

extern "C" {
#include "sil/f28335/f28335_names.h"

#include "board.h"

void trip_init(void);
void trip_check(void);
void trip_latch(uint16_t fault);
void trip_overdue(void);
void line_init(bool uses_direction, std::uint32_t cycles_per_bit);
void line_send(std::uint16_t octet);
void line_release(void);
void f28335_asm(const char *text);
void __tsan_init(void);
void __tsan_func_entry(void *);
void __tsan_func_exit(void);
void __tsan_read1(void *);
void __tsan_read2(void *);
void __tsan_read4(void *);
void __tsan_write1(void *);
void __tsan_write2(void *);
void __tsan_write4(void *);
}

namespace {

using namespace sdre::f28335;
using Action = std::function<void()>;

constexpr unsigned one_shot = 4;
constexpr Uint32   gate_pin = 0x40;
constexpr Uint32   trip_pin = 1U << 12;
constexpr Uint32   line_pin = 1U << 27;

volatile EPWM_REGS *const legs[] = {&EPwm1Regs, &EPwm2Regs, &EPwm3Regs,
                                    &EPwm6Regs}; ///< and the brake

bool   input_low = false;
Uint32 gate      = 0;
bool   sends     = false; ///< level of the direction pin

std::uint32_t cycles = 0;

/// Effect of the last access on the hardware.
void settle()
{
    for (volatile EPWM_REGS *leg : legs) {
        leg->TZFLG.all = static_cast<Uint16>(leg->TZFLG.all & ~leg->TZCLR.all);
        leg->TZCLR.all = 0;
        if (leg->TZFRC.bit.OST != 0U || (input_low && leg->TZSEL.bit.OSHT1 != 0U)) {
            leg->TZFLG.all = static_cast<Uint16>(leg->TZFLG.all | one_shot);
        }
        leg->TZFRC.all = 0;
    }
    gate |= GpioDataRegs.GPASET.all & gate_pin;
    gate &= ~GpioDataRegs.GPACLEAR.all;
    sends = (sends || (GpioDataRegs.GPASET.all & line_pin) != 0U) &&
            (GpioDataRegs.GPACLEAR.all & line_pin) == 0U;
    GpioDataRegs.GPASET.all   = 0;
    GpioDataRegs.GPACLEAR.all = 0;
    GpioDataRegs.GPADAT.all   = gate | (input_low ? 0U : trip_pin);
}

/// Something that comes at the so-manieth access from now on, once.
struct Interruption {
    int    at = -1;
    Action what;
};

std::vector<Interruption> interruptions;
int                       accesses = 0;
bool                      masked   = false;

void access()
{
    settle();
    if (masked) {
        return;
    }
    const int now = accesses++;
    for (Interruption &i : interruptions) {
        if (i.at == now) {
            i.at   = -1;
            masked = true;
            i.what();
            settle();
            masked = false;
        }
    }
}

/// Runs a call with these interruptions; how many accesses it has.
int run(const Action &call, std::vector<Interruption> with)
{
    interruptions = std::move(with);
    accesses      = 0;
    call();
    settle();
    interruptions.clear();
    return accesses;
}

void quietly(const Action &call)
{
    masked = true;
    call();
    settle();
    masked = false;
}

bool all_tripped()
{
    return std::all_of(std::begin(legs), std::end(legs),
                       [](auto *leg) { return (leg->TZFLG.all & one_shot) != 0U; });
}
bool any_tripped()
{
    return std::any_of(std::begin(legs), std::end(legs),
                       [](auto *leg) { return (leg->TZFLG.all & one_shot) != 0U; });
}
bool is_on()
{
    return gate != 0U && !any_tripped();
}
bool is_off()
{
    return gate == 0U && all_tripped();
}

enum class Before { on, asked, off };

void make(Before before)
{
    reset_registers();
    input_low = false;
    gate      = 0;
    quietly(trip_init);
    if (before != Before::off) {
        quietly(board_gate_enable);
    }
    if (before == Before::on) {
        quietly(trip_check);
        ASSERT_TRUE(is_on());
    }
}

/// Two control interrupts more: no half-way state, no fault that there was not; and the gates can be enabled again.
void expect_sound(const std::string &where, bool has_to_be_off, unsigned fault)
{
    quietly(trip_check);
    EXPECT_EQ(board_fault_read(), fault) << where;
    quietly(trip_check);
    EXPECT_EQ(board_fault_read(), fault) << where;
    EXPECT_NE(is_on(), is_off()) << where;
    EXPECT_TRUE(is_off() || !has_to_be_off) << where;
    if (!is_on()) {
        quietly(board_gate_enable);
        quietly(trip_check);
        EXPECT_TRUE(is_on()) << where;
        EXPECT_EQ(board_fault_read(), 0U) << where;
    }
}

void control_interrupt()
{
    trip_check();
}
void control_interrupt_that_asks()
{
    trip_check();
    board_gate_enable();
}

} // namespace

extern "C" {

void f28335_asm(const char *)
{
    access();
}
std::uint32_t f28335_board_cycles(void)
{
    return cycles;
}
Uint16 f28335_scitxbuf_access(void)
{
    return 0;
}
void __tsan_init(void) {}
void __tsan_func_entry(void *) {}
void __tsan_func_exit(void) {}
void __tsan_read1(void *)
{
    access();
}
void __tsan_read2(void *)
{
    access();
}
void __tsan_read4(void *)
{
    access();
}
void __tsan_write1(void *)
{
    access();
}
void __tsan_write2(void *)
{
    access();
}
void __tsan_write4(void *)
{
    access();
}
}

TEST(TripInterleaving, TheBackgroundsTripLatchesNothingAndIsWhole)
{
    int places = 0;
    for (const Before before : {Before::on, Before::asked, Before::off}) {
        make(before);
        const int last = run(board_gate_trip, {});
        places += last;
        EXPECT_TRUE(is_off());
        for (int n = 0; n < last; n++) {
            make(before);
            run(board_gate_trip, {{n, control_interrupt}});
            EXPECT_TRUE(is_off());
            expect_sound("one at " + std::to_string(n), true, 0);
        }
    }
    EXPECT_GE(places, 3 * 9) << "the accesses are not marked";
}

// The tick asks for the gates while the background opens them: whole, either way.
TEST(TripInterleaving, ATickThatAsksMeanwhileGetsAllGatesOrNone)
{
    make(Before::on);
    const int last = run(board_gate_trip, {});
    for (const Before before : {Before::on, Before::asked, Before::off}) {
        for (int n = 0; n < last; n++) {
            for (int m = n; m < last + 12; m++) {
                make(before);
                run(board_gate_trip, {{n, control_interrupt_that_asks}, {m, control_interrupt}});
                expect_sound(std::to_string(n) + ", " + std::to_string(m), false, 0);
            }
        }
    }
}

TEST(TripInterleaving, InputThatFallsOpensTheBridgeAndIsReported)
{
    const std::vector<Action> calls{board_gate_trip, trip_check, board_gate_enable};
    for (const Before before : {Before::on, Before::asked, Before::off}) {
        for (const Action &call : calls) {
            make(before);
            const int last = run(call, {});
            for (int n = 0; n <= last; n++) {
                make(before);
                bool was_on = false;
                run(call, {{n, [&] {
                                was_on    = is_on();
                                input_low = true;
                            }}});
                input_low = true;
                settle();
                EXPECT_TRUE(all_tripped()) << n;
                quietly(trip_check);
                EXPECT_TRUE(is_off()) << n;
                EXPECT_NE(board_fault_read() & BOARD_FAULT_INPUT, 0) << n;
                if (was_on && call.target<void (*)()>() != nullptr &&
                    *call.target<void (*)()>() == trip_check) {
                    EXPECT_NE(board_fault_read() & BOARD_FAULT_TRIP, 0) << n;
                }
                input_low = false;
                settle();
                EXPECT_TRUE(is_off()) << "after a pulse, " << n;
            }
        }
    }
}

// INT13 in the middle of what the tick does to the trip, or of the background's trip.
TEST(TripInterleaving, AnOverdueTickIsNotForgotten)
{
    for (const Before before : {Before::on, Before::asked, Before::off}) {
        make(before);
        const int last = run(board_gate_trip, {});
        for (int n = 0; n < last; n++) {
            make(before);
            run(board_gate_trip, {{n, trip_overdue}});
            EXPECT_TRUE(is_off());
            expect_sound("trip at " + std::to_string(n), true, BOARD_FAULT_OVERRUN);
        }
    }
    make(Before::off);
    const int last = run(board_gate_enable, {});
    for (int n = 0; n < last; n++) {
        make(Before::off);
        run(board_gate_enable, {{n, trip_overdue}});
        EXPECT_TRUE(is_off()) << n;
        quietly(trip_check);
        EXPECT_TRUE(is_off() || board_fault_read() == 0U) << n;
        expect_sound("enable at " + std::to_string(n), false, board_fault_read());
    }
}

// INT13 while the control interrupt or its tick latches a fault of its own: both are there.
TEST(TripInterleaving, FaultsOfBothInterruptsAreKept)
{
    const Action encoder = [] { trip_latch(BOARD_FAULT_ENCODER); };
    make(Before::on);
    const int last = run(encoder, {});
    for (int n = 0; n < last; n++) {
        make(Before::on);
        run(encoder, {{n, trip_overdue}});
        EXPECT_TRUE(is_off()) << n;
        EXPECT_EQ(board_fault_read(), BOARD_FAULT_OVERRUN | BOARD_FAULT_ENCODER) << n;
    }
}

// The next octet is written just when the bit time after the one before is over: the pin is high for it. The transmitter
// shows only after the write that it has something to send.
TEST(LineInterleaving, TheLineIsNotReleasedUnderAnOctet)
{
    const auto transmitter = [](bool empty) {
        SciaRegs.SCIFFTX.bit.TXFFST  = empty ? 0U : 1U;
        SciaRegs.SCICTL2.bit.TXEMPTY = empty ? 1U : 0U;
    };
    const Action control = [] {
        cycles += 200;
        line_release();
    };
    const auto between_two_octets = [&] {
        reset_registers();
        sends  = false;
        cycles = 0;
        transmitter(true);
        quietly([] {
            line_init(true, 100);
            line_send('a');
        });
        transmitter(true);
        quietly(line_release); // empty since 0
        ASSERT_TRUE(sends);
    };
    between_two_octets();
    const int last = run([] { line_send('b'); }, {});
    for (int n = 0; n <= last; n++) {
        between_two_octets();
        run([] { line_send('b'); }, {{n, control}});
        EXPECT_TRUE(sends) << n;
        quietly(control);
        EXPECT_TRUE(sends) << "not yet seen to send, " << n;
        transmitter(false);
        quietly(control);
        EXPECT_TRUE(sends) << n;
        transmitter(true);
        quietly(control);
        EXPECT_TRUE(sends) << n;
        quietly(control);
        EXPECT_FALSE(sends) << n;
    }
}

// The loader's background and a control interrupt that is late look at the same time.
TEST(LineInterleaving, ALookMayBeInterruptedByALook)
{
    for (int n = 0; n < 8; n++) {
        reset_registers();
        SciaRegs.SCICTL2.bit.TXEMPTY = 1U;
        sends                        = false;
        cycles                       = 0;
        quietly([] {
            line_init(true, 100);
            line_send('a');
        });
        cycles = 5000U * (static_cast<std::uint32_t>(n) + 1U); // later than any look before
        run(line_release, {{n, line_release}});
        EXPECT_TRUE(sends) << "released before a bit has passed, " << n;
    }
}
