// SPDX-License-Identifier: MIT
// The model of the STM32G431 finds what a program does wrong with it, and nothing in one that does it right.
#include <gtest/gtest.h>

#include "stm32g431/chip.hpp"
#include "stm32g431/still_circuit.hpp"

using namespace iss;
using namespace iss::stm32g431;

namespace {

struct Mistake {
    const char   *name;
    std::uint32_t task; ///< as in mistakes.c
    const char   *said;
};

const Mistake mistakes[]{
    {"NoClock", 1, "TIM1: written without its clock"},
    {"NoDeadTime", 2, "without dead time"},
    {"NoBreak", 3, "without break input"},
    {"NoPins", 4, "a pin is not connected"},
    {"AfterTheLock", 5, "changed after the lock"},
    {"EarlyRead", 6, "read before its conversion has ended"},
    {"FlashLocked", 7, "written without unlock"},
    {"FlashTwice", 8, "written twice"},
    {"FlashHalf", 9, "half of 64 bits"},
    {"NoPll", 10, "a PLL that does not run"},
    {"Nowhere", 11, "where no peripheral of the model is"},
    {"WatchdogKey", 12, "without its key"},
    {"NotServed", 13, "the watchdog resets"},
    {"CodeWritten", 14, "a protected page of the CCM SRAM is written, at 100013FCh"},
    {"StackGuard", 18, "write to 2000401Ch, which the MPU guards"},
    {"CanNotConfigured", 15, "configured without INIT and CCE"},
    {"CanFrameChanged", 16, "a frame is changed while it waits"},
    {"CanFrameNotHeld", 17, "acknowledged that FIFO 0 does not hold"},
};

std::vector<std::string> findings_of(std::uint32_t task)
{
    StillCircuit   circuit;
    const ElfImage image = read_elf(ISS_MISTAKES);
    Chip           chip(image, circuit);
    chip.core().set_word(image.symbols.at("task"), task);
    chip.run_for(20e-3);
    return chip.core().findings();
}

class IssMistake : public ::testing::TestWithParam<Mistake> {};

INSTANTIATE_TEST_SUITE_P(Each, IssMistake, ::testing::ValuesIn(mistakes),
                         [](const auto &i) { return std::string(i.param.name); });

} // namespace

TEST_P(IssMistake, IsFound)
{
    const std::vector<std::string> found = findings_of(GetParam().task);
    ASSERT_FALSE(found.empty());
    EXPECT_NE(found.front().find(GetParam().said), std::string::npos) << found.front();
}

TEST(IssChip, AProgramWithoutMistakesHasNoFindings)
{
    for (const std::string &line : findings_of(0)) {
        ADD_FAILURE() << line;
    }
}

TEST(IssChip, TheBreakOpensTheBridge)
{
    StillCircuit   circuit;
    const ElfImage image = read_elf(ISS_MISTAKES);
    Chip           chip(image, circuit);
    chip.core().set_word(image.symbols.at("task"), 0);
    chip.run_for(5e-3);
    EXPECT_TRUE(chip.gates_enabled());
    chip.set_over_current(true);
    EXPECT_FALSE(chip.gates_enabled());
    chip.set_over_current(false);
    chip.run_for(5e-3);
    EXPECT_FALSE(chip.gates_enabled()) << "the program has not enabled it again";
}
