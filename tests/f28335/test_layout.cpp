// SPDX-License-Identifier: MIT
// The stand-in headers against the fact sheet: place of every register, place and width of every field.
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "registers.hpp"

namespace {

/// Bits that a field owns, as found by filling it: word and mask per word.
template <typename Registers, typename Fill> std::vector<std::uint16_t> filled(const Fill &fill)
{
    Registers r;
    std::memset(static_cast<void *>(&r), 0, sizeof(r));
    fill(r);
    std::vector<std::uint16_t> words(sizeof(r) / 2);
    std::memcpy(words.data(), &r, sizeof(r));
    return words;
}

std::vector<std::uint16_t> expected(std::size_t words, int word, int lowest, int width)
{
    std::vector<std::uint16_t> all(words, 0);
    const std::uint64_t        mask     = ((std::uint64_t{1} << width) - 1U) << lowest;
    all[static_cast<std::size_t>(word)] = static_cast<std::uint16_t>(mask & 0xFFFFU);
    if ((mask >> 16U) != 0U) {
        all[static_cast<std::size_t>(word) + 1] = static_cast<std::uint16_t>(mask >> 16U);
    }
    return all;
}

#define REGISTER(type, member, word, bytes) TEST_PLACE(type, member, word, bytes)
#define FIELD(type, field, word, lowest, width)                                                    \
    check(#type "." #field, filled<type>([](type &r) {                                             \
              --r.field; /* all ones */                                                            \
          }),                                                                                      \
          expected(sizeof(type) / 2, word, lowest, width));
#define TEST_PLACE(type, member, word, bytes)                                                      \
    EXPECT_EQ(offsetof(type, member), 2U * (word)) << #type "." #member;                           \
    EXPECT_EQ(sizeof(type::member), static_cast<std::size_t>(bytes)) << #type "." #member;

void check(const std::string &name, const std::vector<std::uint16_t> &got,
           const std::vector<std::uint16_t> &want)
{
    EXPECT_EQ(got, want) << name;
}

TEST(F28335Layout, RegistersAndFieldsAreWhereTheFactSheetSays){
#include "layout_table.inc"
}

TEST(F28335Layout, WholeRegisterBlocksHaveTheSizeOfTheirFrame)
{
    EXPECT_EQ(sizeof(EPWM_REGS), 2U * 0x22);
    EXPECT_EQ(sizeof(EQEP_REGS), 2U * 0x40);
    EXPECT_EQ(sizeof(SYS_CTRL_REGS), 2U * 0x20);
    EXPECT_EQ(sizeof(CPUTIMER_REGS), 2U * 0x08);
    EXPECT_EQ(sizeof(ADC_REGS), 2U * 0x20);
    EXPECT_EQ(sizeof(SCI_REGS), 2U * 0x10);
    EXPECT_EQ(sizeof(PIE_VECT_TABLE), 128 * sizeof(PINT));
}

TEST(F28335Layout, VectorsAreAtTheirNumbers)
{
    const auto number = [](std::size_t offset) { return 0xD00U + 2U * (offset / sizeof(PINT)); };
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, XINT13)), 0xD1AU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, TINT2)), 0xD1CU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, XNMI)), 0xD24U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, ILLEGAL)), 0xD26U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, SEQ1INT)), 0xD40U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, SEQ2INT)), 0xD42U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, XINT1)), 0xD46U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, XINT2)), 0xD48U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, ADCINT)), 0xD4AU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, TINT0)), 0xD4CU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, WAKEINT)), 0xD4EU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, EPWM1_TZINT)), 0xD50U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, EPWM1_INT)), 0xD60U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, EQEP1_INT)), 0xD80U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, SCIRXINTA)), 0xDC0U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, SCITXINTA)), 0xDC2U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, ECAN0INTA)), 0xDC8U);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, ECAN1INTA)), 0xDCAU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, LVF)), 0xDFCU);
    EXPECT_EQ(number(offsetof(PIE_VECT_TABLE, LUF)), 0xDFEU);
}

TEST(F28335Layout, ValuesOfTheNamesTheDriversUse)
{
    EXPECT_EQ(TB_COUNT_UPDOWN, 2);
    EXPECT_EQ(TB_FREEZE, 3);
    EXPECT_EQ(TB_SYNC_DISABLE, 3);
    EXPECT_EQ(TB_IMMEDIATE, 1);
    EXPECT_EQ(CC_CTR_PRD, 1);
    EXPECT_EQ(AQ_CLEAR, 1);
    EXPECT_EQ(AQ_SET, 2);
    EXPECT_EQ(DB_FULL_ENABLE, 3);
    EXPECT_EQ(DB_ACTV_HIC, 2);
    EXPECT_EQ(DBA_ALL, 0);
    EXPECT_EQ(TZ_FORCE_LO, 2);
    EXPECT_EQ(ET_CTR_PRD, 2);
    EXPECT_EQ(ET_1ST, 1);
    EXPECT_EQ(PIEACK_GROUP1, 1);
    EXPECT_EQ(PIEACK_GROUP9, 0x100);
    EXPECT_EQ(M_INT1, 1);
}

} // namespace
