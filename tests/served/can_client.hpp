// SPDX-License-Identifier: MIT
/// A CANopen master of the served drive, in simulated time.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

#include "served_client.hpp"
#include "sil/f28335/can_frame.hpp"

extern "C" {
#include "app_registers.h"
}

namespace sdre {

class CanClient : public ServedClient {
protected:
    static constexpr double        sdo_s       = 0.2; ///< an answer takes less
    static constexpr std::uint32_t no_abort    = 0;
    static constexpr unsigned      mode_object = 0x2800 + APP_REGISTERS_MODE;

    using Data = std::vector<std::uint8_t>;

    void send(std::uint32_t id, const Data &data)
    {
        ASSERT_TRUE(offer(id, data));
    }
    /// False: the queue of this end is full.
    virtual bool offer(std::uint32_t id, const Data &data)
    {
        f28335::CanFrame f;
        f.id     = id;
        f.length = static_cast<std::uint8_t>(data.size());
        std::copy(data.begin(), data.end(), f.data.begin());
        return served.can_bus().far_end().send(f);
    }
    void after_period() override
    {
        while (const std::optional<f28335::CanFrame> f = served.can_bus().far_end().take()) {
            come.push_back(*f);
        }
    }
    /// The first frame with this identifier, within the time; the ones before it stay.
    std::optional<Data> take(std::uint32_t id, double longest_s)
    {
        for (const double end_s = served.time_s() + longest_s;;) {
            for (auto at = come.begin(); at != come.end(); ++at) {
                if (at->id == id) {
                    const Data data(at->data.begin(), at->data.begin() + at->length);
                    come.erase(at);
                    return data;
                }
            }
            if (served.time_s() >= end_s) {
                return std::nullopt;
            }
            served.period();
            after_period();
        }
    }
    void nmt(std::uint8_t command, std::uint8_t to = 0)
    {
        send(0, {command, to});
        pass(1e-3);
    }
    /// The value of an object; nothing: it was refused.
    std::optional<std::uint32_t> get(unsigned index, unsigned sub = 0)
    {
        const Data a =
            request({0x40, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8U),
                     static_cast<std::uint8_t>(sub), 0, 0, 0, 0});
        return a.size() == 8 && (a[0] & 0xE2U) == 0x42 ? std::optional<std::uint32_t>(number(a))
                                                       : std::nullopt;
    }
    /// The abort code; no_abort: written. 1: no answer.
    std::uint32_t put(unsigned index, unsigned sub, std::uint32_t value, unsigned octets)
    {
        Data q{static_cast<std::uint8_t>(0x23U | ((4U - octets) << 2U)),
               static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8U),
               static_cast<std::uint8_t>(sub)};
        for (unsigned n = 0; n < 4; n++) {
            q.push_back(static_cast<std::uint8_t>(value >> (8U * n)));
        }
        const Data a = request(q);
        return a.size() != 8 ? 1 : a[0] == 0x60 ? no_abort : number(a);
    }
    Data request(const Data &q)
    {
        const double sent_s = served.time_s();
        send(0x600U + node, q);
        const std::optional<Data> a = take(0x580U + node, sdo_s);
        slowest_s                   = std::max(slowest_s, served.time_s() - sent_s);
        return a.value_or(Data{});
    }
    static std::uint32_t number(const Data &a)
    {
        return a[4] | (static_cast<std::uint32_t>(a[5]) << 8U) |
               (static_cast<std::uint32_t>(a[6]) << 16U) |
               (static_cast<std::uint32_t>(a[7]) << 24U);
    }
    unsigned state()
    {
        return get(0x6041).value_or(0) & 0x6FU;
    }
    /// From power-up to a run. The motor finds its angle first.
    void enable(int mode)
    {
        pass(0.4);
        ASSERT_EQ(put(0x6060, 0, static_cast<std::uint32_t>(mode), 1), no_abort);
        ASSERT_EQ(put(0x6040, 0, 0x06, 2), no_abort);
        ASSERT_EQ(put(0x6040, 0, 0x0F, 2), no_abort);
        for (const double end_s = served.time_s() + 4.0;
             get(mode_object) != APP_MODE_RUN && served.time_s() < end_s;) {
            pass(0.05);
        }
        ASSERT_EQ(get(mode_object), APP_MODE_RUN);
        ASSERT_EQ(state(), 0x27U);
    }
    void expect_no_findings()
    {
        for (const std::string &line : served.findings()) {
            ADD_FAILURE() << line;
        }
    }

    std::uint8_t                 node      = 1;
    double                       slowest_s = 0.0; ///< of the SDO answers
    std::deque<f28335::CanFrame> come;
};

} // namespace sdre
