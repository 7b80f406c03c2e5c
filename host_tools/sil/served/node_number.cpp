// SPDX-License-Identifier: MIT
#include "sil/served/node_number.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

extern "C" {
#include "app_registers_map.h"
}

namespace sdre {
namespace {

constexpr unsigned     node_register       = APP_REGISTERS_CAN_NODE;
constexpr std::uint8_t write_one           = 6;    // function of Modbus
constexpr std::uint8_t reset_communication = 0x82; // command of CiA 301; node 0: all
constexpr double       patience_s          = 2.0;  // chosen: beyond a whole return from bus-off

f28335::CanFrame command()
{
    f28335::CanFrame f;
    f.length  = 2;
    f.data[0] = reset_communication;
    return f;
}

} // namespace

NodeNumber::~NodeNumber()
{
    if (master_ != nullptr) {
        drive_.can_bus().leave(*master_);
    }
}

Octets NodeNumber::request() const
{
    return rtu_frame({1, write_one, node_register >> 8U, node_register & 0xFFU, 0,
                      static_cast<std::uint8_t>(number_)});
}

void NodeNumber::answered(const Octets &answer)
{
    if (answer != request()) { // the echo of success
        throw InputError(
            fmt::format("serve: --node {}: the firmware has not taken the number", number_));
    }
    master_ = &drive_.can_bus().join();
    master_->open();
    master_->send(command());
    until_s_ = drive_.time_s() + patience_s;
}

void NodeNumber::step()
{
    if (master_ == nullptr) {
        return;
    }
    if (!master_->wants()) {
        drive_.can_bus().leave(*master_);
        master_ = nullptr;
        done_   = true;
    } else if (drive_.time_s() > until_s_) {
        throw InputError(fmt::format("serve: --node {}: the drive is not on its CAN bus", number_));
    }
}

} // namespace sdre
