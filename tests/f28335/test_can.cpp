// SPDX-License-Identifier: MIT
// eCAN-A through its registers: handshake, mailboxes, mistakes of a driver.
#include <vector>

#include "can_device.hpp"

namespace {

using namespace sdre::f28335;

TEST_F(F28335Can, JoinsTheBusAfterTheHandshake)
{
    start();

    EXPECT_EQ(can_firmware_joined, 1);
    EXPECT_DOUBLE_EQ(device->can().bit_rate_Hz(), 500e3);
    EXPECT_NEAR(EcanUnit::sample_point(), 0.8, 1e-12);
    EXPECT_EQ(+ECanaRegs.CANES.bit.CCE, 0);
    EXPECT_EQ(+ECanaRegs.CANES.bit.SA1, 0);
    expect_clean();
}

TEST_F(F28335Can, SendsTheOctetsInBothOrders)
{
    for (const bool low_first : {true, false}) {
        can_firmware_mc = low_first ? dbo : 0;
        start();
        ECanaMboxes.MBOX1.MDL.all = low_first ? 0x04030201 : 0x01020304;
        ECanaMboxes.MBOX1.MDH.all = low_first ? 0x08070605 : 0x05060708;
        request(2);
        pass_bits(170);

        const std::optional<CanFrame> got = device->can().take();
        ASSERT_TRUE(got);
        EXPECT_TRUE(*got == standard(0x181, 8, 1));
        EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 2U);
        EXPECT_EQ(flag(ECanaRegs.CANTRS_word[0].all), 0U);
        receive(standard(0x123, 8, 1));
        EXPECT_EQ(ECanaMboxes.MBOX31.MDL.all, low_first ? 0x04030201U : 0x01020304U);
        EXPECT_EQ(ECanaMboxes.MBOX31.MDH.all, low_first ? 0x08070605U : 0x05060708U);
        expect_clean();
    }
}

TEST_F(F28335Can, AFrameTakesItsBits)
{
    start();
    request(4);
    CanFrame zero = standard(0x182, 3);
    zero.data     = {};
    pass_bits(can_frame_length_bits(zero) - 2);
    EXPECT_FALSE(device->can().take());
    EXPECT_EQ(+ECanaRegs.CANES.bit.TM, 1);
    pass_bits(12); // a pass of the firmware is 25 us

    EXPECT_TRUE(device->can().take());
    EXPECT_EQ(+ECanaRegs.CANES.bit.TM, 0);
}

TEST_F(F28335Can, HighestTplThenHighestNumberGoesFirst)
{
    start();
    ECanaRegs.CANME_word[0].all = 0; // so that the control word of 1 can be written
    device->run_for(30e-6);
    ECanaMboxes.MBOX1.MSGCTRL.bit.TPL = 1;
    ECanaRegs.CANME_word[0].all       = 0xF000003E;
    request(0x0E);
    pass_bits(500);

    std::vector<std::uint32_t> order;
    while (const std::optional<CanFrame> f = device->can().take()) {
        order.push_back(f->id);
    }
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0x181, 0x10000003, 0x182}));
    expect_clean();
}

TEST_F(F28335Can, TheHighestMailboxThatFitsTakesTheFrame)
{
    start();
    receive(standard(0x123, 1, 7));
    EXPECT_EQ(pending(), 0x80000000U);
    EXPECT_EQ(+ECanaMboxes.MBOX31.MSGCTRL.bit.DLC, 1);
    receive(standard(0x55, 2, 9));
    EXPECT_EQ(pending(), 0xC0000000U);
    EXPECT_EQ(ECanaMboxes.MBOX30.MSGID.all >> 18U & 0x7FFU, 0x55U);
    receive(standard(0x56, 2, 11)); // 30 is full and protected
    EXPECT_EQ(pending(), 0xE0000000U);
    EXPECT_EQ(ECanaMboxes.MBOX29.MDL.all & 0xFFFFU, 0x0C0BU);
    EXPECT_EQ(flag(ECanaRegs.CANRML_word[0].all), 0U);
    receive(standard(0x57, 2, 13)); // 29 is full and not protected
    EXPECT_EQ(flag(ECanaRegs.CANRML_word[0].all), 0x20000000U);
    EXPECT_EQ(ECanaMboxes.MBOX29.MDL.all & 0xFFFFU, 0x0E0DU);
    EXPECT_EQ(ECanaMboxes.MBOX30.MSGID.all >> 18U & 0x7FFU, 0x55U);
    ECanaRegs.CANRMP_word[0].all = 0x20000000U;
    device->run_for(30e-6);
    EXPECT_EQ(pending(), 0xC0000000U);
    EXPECT_EQ(flag(ECanaRegs.CANRML_word[0].all), 0U);
    expect_clean();
}

TEST_F(F28335Can, AnIdentifierIsStandardOrExtended)
{
    start();
    CanFrame long_one = standard(0x1234567, 4, 1);
    long_one.extended = true;
    receive(long_one);
    EXPECT_EQ(pending(), 0x10000000U);
    long_one.id = 0x123U << 18U; // 11 bits as those of mailbox 31
    receive(long_one);
    EXPECT_EQ(pending(), 0x10000000U);
    long_one.id = 0x1234566;
    receive(long_one);
    EXPECT_EQ(pending(), 0x10000000U);
    ECanaLAMRegs.LAM29.bit.LAMI = 1; // both kinds
    receive(long_one);
    EXPECT_EQ(pending(), 0x30000000U);
    EXPECT_EQ(ECanaMboxes.MBOX29.MSGID.all, 0xC1234566U); // AME stays
}

TEST_F(F28335Can, TimeStampsCountBits)
{
    start();
    receive(standard(0x123));
    const std::uint32_t first = ECanaMOTSRegs.MOTS31;
    pass_bits(1000);
    receive(standard(0x123));

    EXPECT_NEAR(ECanaMOTSRegs.MOTS31 - first, 1170, 13);
    EXPECT_NEAR(ECanaRegs.CANTSC - ECanaMOTSRegs.MOTS31,
                170 - can_frame_length_bits(standard(0x123)), 13);
}

TEST_F(F28335Can, SeveralRequestsInOnePassAllCount)
{
    start();
    can_firmware_echo = 1;
    ASSERT_TRUE(device->can().send(standard(0x123, 4, 1)));
    pass_bits(800);

    EXPECT_EQ(can_firmware_heard, 0x04030201U);
    int one = 0;
    int two = 0;
    while (const std::optional<CanFrame> f = device->can().take()) {
        (f->id == 0x181 ? one : two)++;
    }
    EXPECT_GE(one, 2);
    EXPECT_NEAR(one, two, 1);
    expect_clean();
}

TEST_F(F28335Can, AWriteOfTheShownValueClears)
{
    start();
    request(2);
    pass_bits(170);
    ASSERT_EQ(flag(ECanaRegs.CANTA_word[0].all), 2U);
    ECanaRegs.CANTA_word[0].all = 2;
    device->run_for(30e-6);
    EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 0U);
    expect_clean();
}

TEST_F(F28335Can, ARequestCanBeTakenBack)
{
    start();
    request(0x06);
    pass_bits(20); // 2 is on the wire
    ECanaRegs.CANTRR_word[0].all = 0x06;
    device->run_for(26e-6);
    EXPECT_EQ(flag(ECanaRegs.CANAA_word[0].all), 0x02U);
    EXPECT_EQ(flag(ECanaRegs.CANTRS_word[0].all), 0x04U);
    pass_bits(170);
    EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 0x04U); // its end was a success
    EXPECT_EQ(flag(ECanaRegs.CANTRR_word[0].all), 0U);

    device->can().set_far_end(std::nullopt, false);
    request(0x02);
    pass_bits(30);
    ECanaRegs.CANTRR_word[0].all = 0x02;
    pass_bits(200);
    EXPECT_EQ(flag(ECanaRegs.CANAA_word[0].all), 0x02U); // without acknowledgement
    EXPECT_EQ(flag(ECanaRegs.CANTRS_word[0].all), 0U);
    expect_clean();
}

TEST_F(F28335Can, RequestsAreAnsweredAndAsked)
{
    start();
    CanFrame ask = standard(0x184, 2);
    ask.remote   = true;
    receive(ask);
    pass_bits(100);
    // Mailboxes 30 and 29 stand before 4.
    EXPECT_EQ(pending(), 0x40000000U);
    EXPECT_EQ(+ECanaMboxes.MBOX30.MSGCTRL.bit.RTR, 1);
    ECanaRegs.CANME_word[0].all = 0x0000003E;
    device->run_for(30e-6);
    receive(ask);
    pass_bits(100);
    EXPECT_EQ(flag(ECanaRegs.CANRFP_word[0].all), 0x10U);
    const std::optional<CanFrame> answer = device->can().take();
    ASSERT_TRUE(answer);
    EXPECT_TRUE(*answer == standard(0x184, 2) || answer->length == 2);
    EXPECT_FALSE(answer->remote);

    request(0x20); // a receive mailbox asks
    pass_bits(170);
    const std::optional<CanFrame> asked = device->can().take();
    ASSERT_TRUE(asked);
    EXPECT_TRUE(asked->remote);
    EXPECT_EQ(asked->id, 0x185U);
    receive(standard(0x185, 1, 3));
    EXPECT_NE(pending() & 0x20U, 0U);
    expect_clean();
}

TEST_F(F28335Can, ASoftResetEmptiesTheMailboxesFlags)
{
    start();
    receive(standard(0x123));
    request(2);
    pass_bits(170);
    device->instruction(" EALLOW");
    ECanaRegs.CANMC.bit.SRES = 1;
    device->instruction(" EDIS");
    EXPECT_EQ(+ECanaRegs.CANMC.bit.SRES, 0);
    EXPECT_EQ(ECanaRegs.CANME_word[0].all, 0U);
    EXPECT_EQ(pending(), 0U);
    EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 0U);
}

TEST_F(F28335Can, AMailboxThatIsBeingChangedWaits)
{
    start();
    device->can().set_far_end(std::nullopt, false);
    request(2);
    device->instruction(" EALLOW");
    ECanaRegs.CANMC.all = ECanaRegs.CANMC.all | 0x101; // CDR of 1
    device->instruction(" EDIS");
    device->can().set_far_end(std::nullopt);
    ECanaMboxes.MBOX1.MDL.all = 0x11223344;
    pass_bits(400);
    EXPECT_FALSE(device->can().take());
    device->instruction(" EALLOW");
    ECanaRegs.CANMC.all = ECanaRegs.CANMC.all & ~0x101U;
    device->instruction(" EDIS");
    pass_bits(200);
    const std::optional<CanFrame> got = device->can().take();
    ASSERT_TRUE(got);
    EXPECT_EQ(got->data[0], 0x44);
    expect_clean();
}

TEST_F(F28335Can, TheBitTimingFollowsItsRules)
{
    const struct {
        std::uint32_t btc;
        bool          allowed;
    } all[] = {
        {0x00090152, true},  {0x00000152, false}, // a prescaler of 1
        {0x00090050, false}, {0x00090051, true},  // one quantum behind the sample
        {0x00090009, true},  {0x0009000A, false}, // 2 quanta before it, 2 and 3 behind
        {0x000901D2, true},  {0x000301D2, false}, // three samples with a small prescaler
        {0x00090252, true},  {0x00090351, false}, // a jump of 3 and 4 quanta
    };
    for (const auto &one : all) {
        can_firmware_btc    = one.btc;
        can_firmware_joined = 0;
        start();
        EXPECT_EQ(can_firmware_joined == 1, one.allowed) << std::hex << one.btc;
        EXPECT_EQ(finds("no allowed bit timing"), !one.allowed) << std::hex << one.btc;
    }
}

TEST_F(F28335Can, TheBitTimingHoldsInOperation)
{
    can_firmware_mistake = CAN_MISTAKE_NO_CCR;
    start();
    device->run_for(1e-3);
    EXPECT_EQ(ECanaRegs.CANBTC.all, btc_500);
    EXPECT_DOUBLE_EQ(device->can().bit_rate_Hz(), 500e3);
}

struct Mistake {
    can_firmware_mistake_t mistake;
    Finding                kind;
    const char            *says;
};

TEST_F(F28335Can, NoticesMistakes)
{
    const Mistake all[] = {
        {CAN_MISTAKE_NO_CLOCK, Finding::no_clock, "ECana"},
        {CAN_MISTAKE_NO_EALLOW, Finding::eallow, "CANTIOC"},
        {CAN_MISTAKE_SCC, Finding::unsupported, "eCAN mode"},
        {CAN_MISTAKE_NO_CCR, Finding::can, "CANBTC: written while CCE is 0"},
        {CAN_MISTAKE_NO_TIMING, Finding::can, "no allowed bit timing"},
        {CAN_MISTAKE_ID_ENABLED, Finding::can, "MBOX1: MSGID"},
        {CAN_MISTAKE_RMW, Finding::can, "CANRMP: read-modify-write"},
        {CAN_MISTAKE_LOST_FLAG, Finding::can, "CANRML"},
        {CAN_MISTAKE_DATA_LATE, Finding::can, "MBOX1: written while its request"},
        {CAN_MISTAKE_INTERRUPT, Finding::unsupported, "interrupts"},
    };
    for (const Mistake &m : all) {
        can_firmware_mistake = m.mistake;
        start();
        device->run_for(1e-3);
        EXPECT_TRUE(finds(m.says, m.kind)) << m.says;
        EXPECT_EQ(ECanaMboxes.MBOX1.MSGID.all == 0x281U << 18U, false);
    }
}

} // namespace
