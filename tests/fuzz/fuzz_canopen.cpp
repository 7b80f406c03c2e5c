// SPDX-License-Identifier: MIT
/// The CANopen node on a bus on which anything is said: NMT, SDO, PDOs, SYNC, heartbeats, and noise.
#include <array>
#include <cstdlib>

#include "bytes.hpp"
#include "fake_board.h"

extern "C" {
#include "app_canopen.h"
#include "app_canopen_objects.h"
#include "app_canopen_process.h"
#include "app_registers_place.h"
#include "board_config.h"
#include "gain_tables.h"
}

namespace {

constexpr unsigned answer_id = 0x580, request_id = 0x600;

void require(bool condition)
{
    if (!condition) {
        std::abort();
    }
}

/// Objects that change what the node does, and some that a PDO has.
constexpr std::array<std::uint32_t, 32> objects = {
    0x140001, 0x140002, 0x140003, 0x140005, 0x140101, 0x140102, 0x160000, 0x160001,
    0x160002, 0x160003, 0x160100, 0x160101, 0x180001, 0x180002, 0x180003, 0x180005,
    0x1A0000, 0x1A0001, 0x1A0002, 0x1A0003, 0x101601, 0x101700, 0x100300, 0x100800,
    0x604000, 0x606000, 0x607A00, 0x60FF00, 0x60C201, 0x60C202, 0x212000, 0x212100};

/// Objects of mappings, and some that none may have.
constexpr std::array<std::uint32_t, 16> mapped = {
    0x60400010, 0x60600008, 0x607A0020, 0x60FF0020, 0x60710010, 0x60B10020, 0x00050008, 0x00070020,
    0x60410010, 0x60640020, 0x606C0020, 0x60610008, 0x20020020, 0x28000010, 0x10170010, 0};

class Bus {
public:
    Bus()
    {
        fake_board_reset();
        config_ = board_config;
        require(app_registers_init(&registers_, &config_, &gain_tables_drive) == CTL_OK);
        app_canopen_init(&node_, gain_tables_drive.ts_s);
        app_canopen_start(&node_, &registers_);
        pass(1);
    }
    void say(unsigned id, unsigned length, const std::array<std::uint8_t, 8> &octets)
    {
        if (fake_board.can_rx_count < FAKE_BOARD_FRAMES) {
            board_can_frame_t &f = fake_board.can_rx[fake_board.can_rx_count++];
            f.id                 = static_cast<std::uint16_t>(id & 0x7FFU);
            f.length             = static_cast<std::uint16_t>(length);
            for (std::size_t n = 0; n < octets.size(); n++) {
                f.octets[n] = octets.at(n);
            }
            const bool asks = f.id > request_id && f.id < request_id + 128 && length == 8;
            requests_ += asks ? 1 : 0;
        }
    }
    /// A background pass so many ticks later.
    void pass(std::uint32_t ticks)
    {
        now_ticks_ += ticks;
        expect();
        app_canopen_poll(&node_, &registers_, now_ticks_);
        (void)app_canopen_process_prepare(&node_, &registers_); // changes no register
        judge_node();
        judge_registers();
        judge_frames();
    }
    unsigned node() const
    {
        return node_.node;
    }
    unsigned received_id(unsigned n) const
    {
        return app_canopen_pdo_id(&node_.received[n % APP_CANOPEN_PDOS]);
    }
    app_status_t &status()
    {
        return registers_.status;
    }

private:
    /// Writes what a PDO maps, as the mapping names it.
    static void act(const app_canopen_pdo_t &p, const std::uint16_t *octets, app_registers_t &r)
    {
        bool     ok = true;
        unsigned at = 0;
        for (unsigned k = 0; k < p.count && ok; k++) {
            const std::uint32_t  what  = p.map[k].what;
            const unsigned       count = (what & 0xFFU) / 8U;
            app_canopen_object_t object{};
            std::uint32_t        value = 0;
            for (unsigned n = 0; n < count && n < 4U; n++) {
                value |= static_cast<std::uint32_t>(octets[at + n]) << (8U * n);
            }
            at += count;
            if (what >> 16U > 7U) {
                ok = app_canopen_objects_find(static_cast<std::uint16_t>(what >> 16U),
                                              (what >> 8U) & 0xFFU, &object) == APP_CANOPEN_OK &&
                     app_canopen_objects_put(&r, &object, value) == APP_CANOPEN_OK;
            }
        }
    }
    /// Registers after the frame that the next pass takes.
    void expect()
    {
        expected_                   = registers_;
        const board_can_frame_t &f  = fake_board.can_rx[0];
        const bool               is = fake_board.can_rx_count > 0 && !node_.sdo.answers;
        const bool falls = (fake_board.can_state & ~node_.bus & BOARD_CAN_OFF) != 0; // before it
        const bool operational = node_.state == APP_CANOPEN_OPERATIONAL && !falls;
        known_                 = fake_board.can_rx_count <= 1;
        if (is && (f.id == 0 || f.id == request_id + node_.node)) {
            known_ = false; // it may change anything
        } else if (is && operational) {
            for (const app_canopen_pdo_t &p : node_.received) {
                const bool now = app_canopen_pdo_is_used(&p) && app_canopen_pdo_id(&p) == f.id &&
                                 f.length >= p.length && p.type > APP_CANOPEN_SYNC_MOST;
                if (f.id == APP_CANOPEN_ID_SYNC && p.full) {
                    act(p, p.octets, expected_);
                } else if (now) {
                    act(p, f.octets, expected_);
                }
            }
        }
    }
    void judge_registers() const
    {
        const bool stopped =
            registers_.silent && !app_control_enables(registers_.requested.objects.controlword);
        for (unsigned k = 0; known_ && k < APP_REGISTERS_MAP_HOLDING; k++) {
            const app_registers_entry_t *row = &app_registers_map_holding[k];
            require(app_registers_place_value(&registers_, row) ==
                        app_registers_place_value(&expected_, row) ||
                    (stopped && row->address == APP_REGISTERS_CONTROLWORD));
        }
    }
    void judge_node() const
    {
        const unsigned s = node_.state;
        require(s == APP_CANOPEN_BOOTS || s == APP_CANOPEN_STOPPED ||
                s == APP_CANOPEN_OPERATIONAL || s == APP_CANOPEN_PRE_OPERATIONAL);
        require(node_.node >= 1U && node_.node <= 127U);
        const unsigned room = (node_.sdo.paired ? 2U : 1U) * APP_CANOPEN_SDO_WORDS;
        require(node_.sdo.at <= room && node_.sdo.count <= room);
        require(node_.emergency.unsent <= node_.emergency.count &&
                node_.emergency.count <= APP_CANOPEN_ERRORS);
        require(fake_board.can_id_count <= BOARD_CAN_IDS);
        for (unsigned n = 0; n < APP_CANOPEN_PDOS; n++) {
            judge_pdo(node_.received[n], true);
            judge_pdo(node_.sent[n], false);
        }
    }
    static void judge_pdo(const app_canopen_pdo_t &p, bool receives)
    {
        unsigned length = 0;
        require(p.count <= APP_CANOPEN_MAPPED && p.length <= 8U);
        for (unsigned k = 0; k < p.count; k++) {
            const app_registers_entry_t *row = p.map[k].entry;
            length += (p.map[k].what & 0xFFU) / 8U;
            require(!receives || row == nullptr ||
                    (row >= app_registers_map_holding &&
                     row < app_registers_map_holding + APP_REGISTERS_MAP_HOLDING));
        }
        require(length == p.length);
    }
    /// Each frame that was sent is one of this node.
    void judge_frames()
    {
        for (int k = 0; k < fake_board.can_tx_count; k++) {
            const board_can_frame_t &f = fake_board.can_tx[k];
            if (f.id == APP_CANOPEN_ID_HEARTBEAT + node_.node) {
                require(f.length == 1);
            } else if (f.id == answer_id + node_.node) {
                answers_++;
                require(f.length == 8);
            } else if (f.id == APP_CANOPEN_ID_EMERGENCY + node_.node) {
                require(f.length == 8);
            } else {
                bool its = false;
                for (const app_canopen_pdo_t &p : node_.sent) {
                    its = its || (app_canopen_pdo_is_used(&p) && app_canopen_pdo_id(&p) == f.id &&
                                  p.length == f.length);
                }
                require(its && node_.state == APP_CANOPEN_OPERATIONAL);
            }
        }
        fake_board.can_tx_count = 0;
        require(answers_ + (node_.sdo.answers ? 1 : 0) <= requests_);
    }

    app_config_t    config_{};
    app_registers_t registers_{};
    app_registers_t expected_{};
    app_canopen_t   node_{};
    bool            known_     = false; ///< what the registers become
    std::uint32_t   now_ticks_ = 0xFFFFFF00U;
    long            requests_  = 0;
    long            answers_   = 0;
};

std::array<std::uint8_t, 8> any_octets(fuzz::Bytes &in)
{
    std::array<std::uint8_t, 8> octets{};
    for (std::uint8_t &octet : octets) {
        octet = in.octet();
    }
    return octets;
}

void command(fuzz::Bytes &in, Bus &bus)
{
    static constexpr std::array<std::uint8_t, 8> commands = {1, 2, 128, 129, 130, 1, 1, 3};
    const unsigned                               what     = in.octet();
    const auto to = static_cast<std::uint8_t>((what & 8U) != 0U ? bus.node() : what >> 4U);
    bus.say(0, 2, {commands.at(what & 7U), to});
}

/// A write in one frame.
void write(fuzz::Bytes &in, Bus &bus, unsigned which)
{
    const std::uint32_t object = objects.at(which);
    const unsigned      how    = in.octet();
    const std::uint32_t value  = (how & 0x80U) != 0U ? mapped.at(how & 15U) : in.word();
    const unsigned      unused = (how >> 4U) & 3U;
    const auto octet = [](std::uint32_t x) { return static_cast<std::uint8_t>(x & 0xFFU); };
    bus.say(request_id + bus.node(), 8,
            {octet(0x23U | (unused << 2U)), octet(object >> 8U), octet(object >> 16U),
             octet(object), octet(value), octet(value >> 8U), octet(value >> 16U),
             octet(value >> 24U)});
}

void change_board(fuzz::Bytes &in, Bus &bus)
{
    const unsigned what  = in.octet();
    fake_board.can_state = what & 7U;
    fake_board.can_room  = (what & 8U) != 0U ? static_cast<int>(what >> 6U) : 1 << 20;
    app_status_t &s      = bus.status();
    s.gate_enable        = (what & 16U) != 0U;
    s.fault              = (what & 32U) != 0U ? APP_FAULT_DRIVE : APP_FAULT_NONE;
    s.drive_fault        = (what & 32U) != 0U ? DRIVE_FAULT_ENCODER : DRIVE_FAULT_NONE;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Bytes in(data, size);
    Bus         bus;
    while (in.any()) {
        const unsigned what = in.octet();
        const unsigned low  = what & 31U;
        switch (what >> 5U) {
        case 0:
            command(in, bus);
            break;
        case 1:
            bus.say(APP_CANOPEN_ID_SYNC, 0, {});
            break;
        case 2:
            write(in, bus, low);
            break;
        case 3:
            bus.say(request_id + bus.node(), low == 0 ? 7 : 8, any_octets(in));
            break;
        case 4:
            bus.say(bus.received_id(low), low > 27 ? 3 : 8, any_octets(in));
            break;
        case 5: {
            const unsigned id = in.word();
            bus.say(id, (id >> 16U) % 9U, any_octets(in));
            break;
        }
        case 6:
            change_board(in, bus);
            break;
        default:
            bus.pass(1U << low);
            bus.pass(1);
        }
        if (what % 7U != 0U || fake_board.can_rx_count > 8) { // else more than one frame waits
            bus.pass(1);
        }
    }
    return 0;
}
