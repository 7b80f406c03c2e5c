// SPDX-License-Identifier: MIT
// The core that runs compiled images, with a program of its own: arithmetic, exceptions, sleep, faults, cycles.
#include <gtest/gtest.h>

#include <cstring>

#include "core.hpp"

using namespace iss;

namespace {

constexpr std::uint32_t flash  = 0x08000000;
constexpr std::uint32_t ram    = 0x20000000;
constexpr std::uint32_t lines  = 0x40000000;
constexpr std::uint64_t enough = 2'000'000;

enum Task {
    adds,
    nests,
    sleeps,
    masks,
    levels,
    faults,
    faults_twice,
    no_fpu,
    misaligned_stack,
    keeps
};

/// Raises and lowers lines of interrupts.
class Lines : public Device {
public:
    explicit Lines(Exceptions &e) : exceptions_(e) {}

    std::uint32_t read(std::uint32_t /*offset*/, unsigned /*octets*/) override
    {
        return 0;
    }
    void write(std::uint32_t /*offset*/, std::uint32_t value, unsigned /*octets*/) override
    {
        exceptions_.set_line(static_cast<int>(value % 100U), value < 100U);
    }

private:
    Exceptions &exceptions_;
};

class IssCore : public ::testing::Test {
protected:
    IssCore()
    {
        core.add_memory(flash, 0x10000, false);
        core.add_memory(ram, 0x8000, true);
        core.add_device(lines, 0x1000, device);
        core.load(image);
    }
    void start(Task task)
    {
        for (std::uint32_t at = 0; at < 0x8000; at += 4) {
            core.set_word(ram + at, 0);
        }
        core.set_word(image.symbols.at("task"), task);
        core.reset(flash);
    }
    std::vector<std::uint32_t> run(Task task)
    {
        start(task);
        core.run_until(core.cycles() + enough);
        return trace();
    }
    std::uint32_t value(const char *symbol) const
    {
        return core.word(image.symbols.at(symbol));
    }
    std::vector<std::uint32_t> trace() const
    {
        std::vector<std::uint32_t> t;
        for (std::uint32_t n = 0; n < value("traced"); n++) {
            t.push_back(core.word(image.symbols.at("trace") + 4U * n));
        }
        return t;
    }
    void expect_no_findings() const
    {
        for (const std::string &line : core.findings()) {
            ADD_FAILURE() << line;
        }
    }

    ElfImage image = read_elf(ISS_CORE_PROGRAM);
    Core     core;
    Lines    device{core.exceptions()};
};

/// As work() of core_program.c.
float work()
{
    float a = 0.5F;
    float b = 1.25F;
    float c = 2.0F;
    float d = -3.0F;
    for (unsigned n = 0; n < 2000; n++) {
        a = a * 0.999F + b;
        b = b * 0.5F - c * 0.25F;
        c = c / 1.0001F + static_cast<float>(n & 15U);
        d = d * 0.75F + a * b;
    }
    return a + b + c + d;
}

std::uint32_t bits(float x)
{
    std::uint32_t word = 0;
    std::memcpy(&word, &x, sizeof word);
    return word;
}

using Trace = std::vector<std::uint32_t>;

} // namespace

TEST_F(IssCore, AddsAsTheHostDoes)
{
    EXPECT_EQ(run(adds), Trace{bits(work())});
    EXPECT_EQ(value("done"), 1U);
    EXPECT_GT(core.idle_cycles(), 0U);
    expect_no_findings();
}

// At every distance, so that each block of work() is interrupted; the handler uses the same registers of the FPU.
TEST_F(IssCore, InterruptsChangeNoRegister)
{
    unsigned taken = 0;
    for (std::uint64_t every = 301; every < 1500; every += 11) {
        start(adds);
        const std::uint64_t begin = core.cycles();
        for (std::uint64_t at = begin + 3000; value("done") == 0U && at < begin + 10 * enough;
             at += every) {
            core.run_until(at);
            core.exceptions().set_line(0, true);
        }
        ASSERT_EQ(value("done"), 1U) << every;
        const Trace t = trace();
        ASSERT_FALSE(t.empty());
        // The result is one of the words; the handler notes 116 each time.
        taken += static_cast<unsigned>(t.size());
        EXPECT_EQ(core.word(image.symbols.at("result")), bits(work())) << every;
    }
    EXPECT_GT(taken, 100U);
    expect_no_findings();
}

TEST_F(IssCore, AMoreUrgentLineInterruptsAndAnEqualOneWaits)
{
    EXPECT_EQ(run(nests), (Trace{116, 318, 101, 102, 217, 103}));
    expect_no_findings();
}

TEST_F(IssCore, MasksHoldBackWhatTheyShould)
{
    EXPECT_EQ(run(masks), (Trace{1, 318, 2, 318, 3, 116, 4}));
    expect_no_findings();
}

TEST_F(IssCore, SleepEndsByAnInterruptAlsoWhileItIsMasked)
{
    start(sleeps);
    core.run_until(core.cycles() + 100'000);
    EXPECT_EQ(trace(), Trace{});
    EXPECT_GT(core.idle_cycles(), 99'000U);
    core.exceptions().set_line(2, true);
    core.run_until(core.cycles() + 100'000);
    EXPECT_EQ(trace(), (Trace{318, 1}));
    core.exceptions().set_line(2, true);
    core.run_until(core.cycles() + 100'000);
    EXPECT_EQ(trace(), (Trace{318, 1, 2, 318, 3}));
    expect_no_findings();
}

TEST_F(IssCore, AHighLineComesAgain)
{
    EXPECT_EQ(run(levels), (Trace{217, 217, 217, 217, 9}));
    expect_no_findings();
}

TEST_F(IssCore, AFaultIsHandledAndNamed)
{
    EXPECT_EQ(run(faults), Trace{3003});
    ASSERT_EQ(core.findings().size(), 1U);
    EXPECT_NE(core.findings().front().find("read from 50000000h"), std::string::npos)
        << core.findings().front();
    EXPECT_FALSE(core.halted());
}

TEST_F(IssCore, AFaultInItsHandlerEndsTheProgram)
{
    EXPECT_EQ(run(faults_twice), Trace{3003});
    EXPECT_TRUE(core.halted());
}

TEST_F(IssCore, AnFpuThatIsOffIsAFault)
{
    EXPECT_EQ(run(no_fpu), Trace{3003});
    ASSERT_FALSE(core.findings().empty());
    EXPECT_NE(core.findings().front().find("CPACR"), std::string::npos);
}

TEST_F(IssCore, HandlersHaveAnAlignedStack)
{
    EXPECT_EQ(run(misaligned_stack), (Trace{116, 116, 1}));
    expect_no_findings();
}

TEST_F(IssCore, AnInterruptKeepsFlagsAndTheUseOfTheFpu)
{
    EXPECT_EQ(run(keeps), (Trace{116, 77, 1, 8, 4}));
    expect_no_findings();
}

TEST_F(IssCore, TheWayToAHandlerTakesTwelveCycles)
{
    start(sleeps);
    core.run_until(core.cycles() + 100'000);
    const std::uint64_t asleep = core.cycles();
    core.exceptions().set_line(2, true);
    core.run_until(asleep + 1);
    EXPECT_EQ(core.cycles(), asleep + 12);
}

// The manual's table: a few instructions of each kind.
TEST(IssCycles, AreThoseOfTheTable)
{
    const auto cycles = [](const std::vector<std::uint8_t> &code) {
        return cost_of(code.data(), code.size()).cycles;
    };
    EXPECT_EQ(cycles({0x00, 0xBF}), 1U);              // nop
    EXPECT_EQ(cycles({0x10, 0xB5}), 3U);              // push {r4, lr}
    EXPECT_EQ(cycles({0x10, 0xBD}), 5U);              // pop {r4, pc}
    EXPECT_EQ(cycles({0x1A, 0x68}), 2U);              // ldr r2, [r3]
    EXPECT_EQ(cycles({0xFE, 0xE7}), 3U);              // b
    EXPECT_EQ(cycles({0x70, 0x47}), 3U);              // bx lr
    EXPECT_EQ(cycles({0x00, 0xF0, 0x02, 0xF8}), 3U);  // bl
    EXPECT_EQ(cycles({0xB1, 0xFB, 0xF2, 0xF0}), 7U);  // udiv r0, r1, r2
    EXPECT_EQ(cycles({0x30, 0xEE, 0x21, 0x0A}), 1U);  // vadd.f32 s0, s0, s3
    EXPECT_EQ(cycles({0x20, 0xEE, 0x21, 0x0A}), 1U);  // vmul.f32 s0, s0, s3
    EXPECT_EQ(cycles({0x00, 0xEE, 0x21, 0x0A}), 3U);  // vmla.f32 s0, s0, s3
    EXPECT_EQ(cycles({0xA0, 0xEE, 0x21, 0x0A}), 3U);  // vfma.f32 s0, s0, s3
    EXPECT_EQ(cycles({0x80, 0xEE, 0x21, 0x0A}), 14U); // vdiv.f32 s0, s0, s3
    EXPECT_EQ(cycles({0xB1, 0xEE, 0xE0, 0x0A}), 14U); // vsqrt.f32 s0, s1
    EXPECT_EQ(cycles({0x93, 0xED, 0x00, 0x0A}), 2U);  // vldr s0, [r3]
    EXPECT_EQ(cycles({0x2D, 0xED, 0x04, 0x8A}), 5U);  // vpush {s16-s19}
    EXPECT_EQ(cycles({0x00, 0xBF, 0x1A, 0x68, 0xFE, 0xE7}), 6U);
    EXPECT_EQ(cycles({0x1A, 0x60}), 1U);             // str r2, [r3]
    EXPECT_EQ(cycles({0x1A, 0x51}), 2U);             // str r2, [r3, r4]
    EXPECT_EQ(cycles({0x43, 0xF8, 0x04, 0x2C}), 1U); // str r2, [r3, #-4]
    EXPECT_EQ(cycles({0x43, 0xF8, 0x04, 0x20}), 2U); // str.w r2, [r3, r4]
    EXPECT_EQ(cycles({0x1A, 0x68, 0x21, 0x68}), 3U); // ldr r2, [r3]; ldr r1, [r4]
    EXPECT_EQ(cycles({0x1A, 0x68, 0x11, 0x68}), 4U); // ldr r2, [r3]; ldr r1, [r2]
    EXPECT_EQ(cycles({0x1A, 0x68, 0xA1, 0x58}), 4U); // ldr r2, [r3]; ldr r1, [r4, r2]
    EXPECT_EQ(cycles({0x1A, 0x68, 0x22, 0x60}), 3U); // ldr r2, [r3]; str r2, [r4]
    EXPECT_EQ(cycles({0x1A, 0x68, 0xFA, 0x50}), 3U); // ldr r2, [r3]; str r2, [r7, r3]
}

TEST(IssCycles, ABranchThatIsNotTakenHidesItsRefill)
{
    const auto less = [](const std::vector<std::uint8_t> &code) {
        return cost_of(code.data(), code.size()).not_taken;
    };
    EXPECT_EQ(less({0x00, 0xD0}), 2U);             // beq
    EXPECT_EQ(less({0x08, 0xB1}), 2U);             // cbz r0
    EXPECT_EQ(less({0x00, 0xF0, 0x02, 0x80}), 2U); // beq.w
    EXPECT_EQ(less({0xFE, 0xE7}), 0U);             // b
    EXPECT_EQ(less({0x00, 0xF0, 0x02, 0xF8}), 0U); // bl
    EXPECT_EQ(less({0x00, 0xF0, 0x02, 0xB8}), 0U); // b.w
    EXPECT_EQ(less({0xBF, 0xF3, 0x4F, 0x8F}), 0U); // dsb
    EXPECT_EQ(less({0x00, 0xDF}), 0U);             // svc
}

TEST(IssCycles, LoadsOfLiteralsAreCounted)
{
    const auto literals = [](const std::vector<std::uint8_t> &code) {
        return cost_of(code.data(), code.size()).literals;
    };
    EXPECT_EQ(literals({0x01, 0x48}), 1U);             // ldr r0, [pc, #4]
    EXPECT_EQ(literals({0xDF, 0xF8, 0x04, 0x00}), 1U); // ldr.w r0, [pc, #4]
    EXPECT_EQ(literals({0x5F, 0xF8, 0x04, 0x00}), 1U); // ldr.w r0, [pc, #-4]
    EXPECT_EQ(literals({0x9F, 0xED, 0x01, 0x0A}), 1U); // vldr s0, [pc, #4]
    EXPECT_EQ(literals({0x1A, 0x68}), 0U);             // ldr r2, [r3]
    EXPECT_EQ(literals({0x93, 0xED, 0x00, 0x0A}), 0U); // vldr s0, [r3]
}

TEST(IssElf, WhatIsNoProgramIsSaidSo)
{
    EXPECT_THROW(read_elf("/nonexistent"), std::runtime_error);
    EXPECT_THROW(read_elf(ISS_SOURCE), std::runtime_error);
}
