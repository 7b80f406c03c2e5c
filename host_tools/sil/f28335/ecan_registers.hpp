// SPDX-License-Identifier: MIT
/// Bits of eCAN-A's registers that its model looks at.
#pragma once

#include <cstdint>

#include "sil/f28335/gpio.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

namespace es { // of CANES
constexpr std::uint32_t tm   = 0x00000001;
constexpr std::uint32_t rm   = 0x00000002;
constexpr std::uint32_t cce  = 0x00000010;
constexpr std::uint32_t ew   = 0x00010000;
constexpr std::uint32_t ep   = 0x00020000;
constexpr std::uint32_t bo   = 0x00040000;
constexpr std::uint32_t acke = 0x00080000;
constexpr std::uint32_t se   = 0x00100000;
constexpr std::uint32_t crce = 0x00200000;
constexpr std::uint32_t sa1  = 0x00400000;
constexpr std::uint32_t be   = 0x00800000;
constexpr std::uint32_t fe   = 0x01000000;

constexpr std::uint32_t bus_errors = acke | se | crce | be | fe;
constexpr std::uint32_t clearable  = bus_errors | ew | ep | bo;
/// Reserved bits, which read as anything: they show a write.
constexpr std::uint32_t reserved = 0xFE000000;
constexpr std::uint32_t marker   = 0xAA000000;
} // namespace es

inline bool ecan_is_clocked()
{
    return SysCtrlRegs.PCLKCR0.bit.ECANAENCLK != 0U;
}

/// The unit has its two pins.
inline bool ecan_is_connected()
{
    return ECanaRegs.CANTIOC.bit.TXFUNC != 0U && ECanaRegs.CANRIOC.bit.RXFUNC != 0U &&
           Gpio::is_muxed(30, 1) && Gpio::is_muxed(31, 1);
}

} // namespace sdre::f28335
