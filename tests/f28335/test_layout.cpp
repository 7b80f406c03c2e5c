// SPDX-License-Identifier: MIT
// The stand-in headers against the fact sheet: place of every register, place and width of every field.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sil/f28335/registers.hpp"

namespace {

struct RegisterPlace {
    const char *name;
    std::size_t offset, offset_wanted;
    std::size_t bytes, bytes_wanted;
};

struct FieldPlace {
    const char *name;
    std::size_t bytes_of_registers;
    void (*fill)(void *registers); ///< every bit of the field to one
    int word, lowest, width;
};

#define COUNTED(r)         r##_word[0]   // a register whose accesses the stand-in counts
#define BEHIND_FLAGS(word) ((word) + 14) // seven registers have 64 bits instead of 32

// Two passes over one table. Plain data: as test code, every row would be compiled with its checks.
#define REGISTER(type, member, word, bytes)                                                        \
    {#type "." #member, offsetof(type, member), 2U * (word), sizeof(type::member), (bytes)},
#define FIELD(type, field, word, lowest, width)
const RegisterPlace register_places[] = {
#include "layout_table.inc"
};
#undef REGISTER
#undef FIELD

#define REGISTER(type, member, word, bytes)
#define FIELD(type, field, word, lowest, width)                                                    \
    {#type "." #field, sizeof(type), [](void *r) { --static_cast<type *>(r)->field; }, word,                                        \
     lowest,           width},
const FieldPlace field_places[] = {
#include "layout_table.inc"
};
#undef REGISTER
#undef FIELD

TEST(F28335Layout, RegistersAreWhereTheFactSheetSays)
{
    for (const RegisterPlace &r : register_places) {
        EXPECT_EQ(r.offset, r.offset_wanted) << r.name;
        EXPECT_EQ(r.bytes, r.bytes_wanted) << r.name;
    }
}

TEST(F28335Layout, FieldsAreWhereTheFactSheetSays)
{
    for (const FieldPlace &f : field_places) {
        std::vector<std::uint16_t> got(f.bytes_of_registers / 2);
        f.fill(got.data());
        std::vector<std::uint16_t> want(got.size());
        const std::uint64_t        mask        = ((std::uint64_t{1} << f.width) - 1U) << f.lowest;
        want[static_cast<std::size_t>(f.word)] = static_cast<std::uint16_t>(mask & 0xFFFFU);
        if ((mask >> 16U) != 0U) {
            want[static_cast<std::size_t>(f.word) + 1] = static_cast<std::uint16_t>(mask >> 16U);
        }
        EXPECT_EQ(got, want) << f.name;
    }
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
    EXPECT_EQ(sizeof(ECAN_MBOXES), 2U * 0x100);
    EXPECT_EQ(sizeof(LAM_REGS), 2U * 0x40);
}

TEST(F28335Layout, FlagsOfTheMailboxesAreInOrder)
{
    EXPECT_EQ(offsetof(ECAN_REGS, CANTRS_word), 8U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANTRR_word), 16U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANTA_word), 24U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANAA_word), 32U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANRMP_word), 40U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANRML_word), 48U);
    EXPECT_EQ(offsetof(ECAN_REGS, CANRFP_word), 56U);
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
