// SPDX-License-Identifier: MIT
// The image that is flashed, instruction by instruction, with the motor at rest: start, Modbus, loader, flash.
#include <gtest/gtest.h>

#include <cstdio>

#include "modbus_pdu.hpp"
#include "stm32g431/chip.hpp"
#include "stm32g431/still_circuit.hpp"

extern "C" {
#include "app_loader.h"
#include "app_modes.h"
#include "app_registers.h"
}

using namespace iss;
using namespace iss::stm32g431;

namespace {

using Words = std::vector<std::uint16_t>;
using sdre::Octets;

constexpr double answer_s   = 0.1;
constexpr double step_s     = 5e-4;
constexpr double ready_s    = 0.4; // boot 50 ms, offsets of the sensors 256 ms
constexpr double cut_step_s = 20e-6;

class IssImage : public ::testing::Test {
protected:
    /// The answer's PDU; empty when none came.
    Octets ask(const Octets &pdu)
    {
        Octets request{1};
        request.insert(request.end(), pdu.begin(), pdu.end());
        for (const std::uint8_t octet : sdre::rtu_frame(request)) {
            chip.serial().send(octet);
        }
        Octets come;
        for (const double end_s = chip.time_s() + answer_s; chip.time_s() < end_s;) {
            chip.run_for(step_s);
            const std::size_t before = come.size();
            for (int octet = chip.serial().take(); octet >= 0; octet = chip.serial().take()) {
                come.push_back(static_cast<std::uint8_t>(octet));
            }
            const auto content = sdre::rtu_content(come);
            if (content && come.size() == before) {
                return {content->begin() + 1, content->end()};
            }
        }
        return {};
    }
    int input(unsigned number)
    {
        return support::value_of(ask(support::read_pdu(4, number)));
    }
    bool write(unsigned first, const Words &words)
    {
        return support::is_written(ask(support::write_pdu(first, words)));
    }
    int window()
    {
        return support::value_of(ask(support::read_pdu(3, APP_REGISTERS_SPEED_WINDOW)));
    }
    /// Asks until the drive takes it: it has to be ready.
    void store_window(int tenths)
    {
        ASSERT_TRUE(write(APP_REGISTERS_SPEED_WINDOW, {static_cast<std::uint16_t>(tenths)}));
        bool taken = false;
        for (int n = 0; n < 20 && !taken; n++) {
            taken = write(APP_REGISTERS_STORE_PARAMETERS, {0x6576, 0x6173});
        }
        ASSERT_TRUE(taken);
    }
    int loader(unsigned number)
    {
        return input(APP_LOADER_FIRST + number);
    }
    void enter()
    {
        ASSERT_TRUE(write(APP_LOADER_FIRST, {APP_LOADER_ENTER}));
        chip.run_for(0.1);
        ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_IDLE);
    }
    /// After so long from the restart that stores a window, and then in the write of this number; 0: at once.
    struct Cut {
        double after_s  = 0.0;
        int    in_write = 0;
    };
    void cut(const std::vector<Cut> &cuts)
    {
        ASSERT_EQ(window(), 100);
        int before = 100;
        int taken  = 0;
        int torn   = 0;
        for (const auto [after_s, in_write] : cuts) {
            const int next   = before + 1;
            const int resets = chip.resets();
            store_window(next);
            while (chip.resets() == resets) {
                chip.run_for(cut_step_s);
            }
            chip.run_for(after_s);
            const int    reached = chip.flash().writes() + in_write;
            const double end_s   = chip.time_s() + 0.2;
            while (chip.flash().writes() < reached) {
                ASSERT_LT(chip.time_s(), end_s) << in_write;
                chip.run_for(cut_step_s);
            }
            chip.power_cycle();
            torn += chip.flash().torn() > 0 ? 1 : 0;
            chip.run_for(ready_s);
            const int now = window();
            ASSERT_TRUE(now == before || now == next)
                << now << " after " << after_s << ", in write " << in_write;
            EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 1) << in_write;
            EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_READY) << in_write;
            EXPECT_EQ(chip.resets(), 0) << in_write;
            taken += now == next ? 1 : 0;
            before = now;
        }
        std::printf(
            "%zu cuts: %d left the new ones, %d bits beyond correction, %d reads of these\n",
            cuts.size(), taken, torn, chip.flash().torn_reads());
        EXPECT_GE(taken, 1);
        EXPECT_GE(torn, 2);
        EXPECT_GE(chip.flash().torn_reads(), 1) << "each is an NMI";
        expect_no_findings();
    }
    /// The number of writes that one record takes.
    int writes_of_a_record()
    {
        chip.run_for(ready_s);
        const int before = chip.flash().writes();
        store_window(99);
        chip.run_for(0.2);
        store_window(100); // with the mark of the one before
        chip.run_for(0.2);
        return (chip.flash().writes() - before) / 2;
    }
    void expect_no_findings()
    {
        for (const std::string &line : chip.core().findings()) {
            ADD_FAILURE() << line;
        }
        EXPECT_FALSE(chip.core().halted());
    }

    StillCircuit circuit;
    ElfImage     image = read_elf(ISS_IMAGE);
    Chip         chip{image, circuit};
};

} // namespace

TEST_F(IssImage, StartsAndAnswersWithTheBridgeOff)
{
    chip.run_for(ready_s);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_READY);
    EXPECT_EQ(input(APP_REGISTERS_FAULT), APP_FAULT_NONE);
    const Octets board = ask({43, 14, 4, 0x83});
    EXPECT_NE(std::string(board.begin(), board.end()).find("b_g431b_esc1"), std::string::npos);
    EXPECT_FALSE(chip.gates_enabled());
    EXPECT_FALSE(circuit.gates);
    EXPECT_EQ(chip.resets(), 0);
    EXPECT_NEAR(static_cast<double>(circuit.periods), 20e3 * chip.time_s(), 20e3 * 0.02);
    std::printf("control interrupt at rest: %d cycles, at most %d\n", input(APP_REGISTERS_CYCLES),
                input(APP_REGISTERS_CYCLES_WORST));
    expect_no_findings();
}

TEST_F(IssImage, WritesItsFlashByTheLoader)
{
    chip.run_for(ready_s);
    enter();
    EXPECT_EQ(chip.resets(), 1);
    ASSERT_TRUE(write(APP_LOADER_FIRST, {APP_LOADER_BEGIN, 0, 100}));
    chip.run_for(0.2);
    ASSERT_EQ(loader(APP_LOADER_STATE), APP_LOADER_WRITING);
    for (unsigned at = 0; at < 100; at += 20) {
        Words part{0, static_cast<std::uint16_t>(at)};
        for (unsigned n = at; n < at + 20; n++) {
            part.push_back(static_cast<std::uint16_t>(0x1000 + n));
        }
        ASSERT_TRUE(write(APP_LOADER_FIRST + APP_LOADER_OFFSET_HI, part)) << at;
    }
    EXPECT_EQ(loader(APP_LOADER_PUT_LO), 100);
    ASSERT_TRUE(write(APP_LOADER_FIRST, {APP_LOADER_COMMIT, 0, 100, 1, 2}));
    chip.run_for(0.1);
    EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_SUM) << "the check sum is a wrong one";
    ASSERT_TRUE(write(APP_LOADER_FIRST, {APP_LOADER_LEAVE}));
    chip.run_for(ready_s);
    EXPECT_EQ(loader(APP_LOADER_STATE), APP_LOADER_AWAY);
    EXPECT_EQ(chip.resets(), 2);
    expect_no_findings();
}

TEST_F(IssImage, CodeInTheRamIsProtectedAndComparedWithTheFlash)
{
    chip.run_for(ready_s);
    const std::uint32_t first = image.symbols.at("image_ccm");
    const std::uint32_t end   = image.symbols.at("image_ccm_end");
    ASSERT_EQ(input(APP_REGISTERS_FAULT), APP_FAULT_NONE);
    const std::uint32_t pages = chip.protected_pages();
    for (std::uint32_t page = 0; page < 10; page++) { // of 1 KB
        EXPECT_EQ(pages >> page & 1U, ccm_base + (page + 1U) * 1024U > first ? 1U : 0U) << page;
    }
    chip.core().set_word(end - 4U, chip.core().word(end - 4U) ^ 0x100U); // as a particle would
    chip.run_for(0.1);
    EXPECT_EQ(input(APP_REGISTERS_FAULT), APP_FAULT_MEMORY);
    expect_no_findings();
}

TEST_F(IssImage, APowerCutLeavesTheOldParametersOrTheNewOnes)
{
    const int last = writes_of_a_record();
    // In the first page and the second, in the content, in the marks; and too late.
    cut({{1e-3},
         {2e-3},
         {3e-3},
         {4e-3},
         {30e-3},
         {0.0, 1},
         {0.0, last / 2},
         {0.0, last - 1},
         {0.0, last},
         {0.0, last},
         {0.0, last},
         {0.0, last + 1},
         {50e-3}});
}

TEST_F(IssImage, APowerCutInEachWriteLeavesTheOldParametersOrTheNewOnes)
{
    const int        last = writes_of_a_record();
    std::vector<Cut> cuts;
    for (int n = 1; n <= last + 1; n++) {
        cuts.push_back({0.0, n});
    }
    for (int n = 0; n < 6; n++) { // the marks
        cuts.push_back({0.0, last + n % 2});
    }
    cut(cuts);
}

TEST_F(IssImage, WithoutCrystalItStaysOff)
{
    chip.break_crystal();
    chip.run_for(0.1);
    EXPECT_EQ(circuit.periods, 0);
    EXPECT_FALSE(chip.gates_enabled());
    expect_no_findings();
}
