// SPDX-License-Identifier: MIT
/// A Modbus client of the served drive, in simulated time.
#pragma once

#include <gtest/gtest.h>

#include "modbus_pdu.hpp"
#include "served_board.hpp"
#include "sil/served/rtu_frame.hpp"

namespace sdre {

using Words = std::vector<std::uint16_t>;

class ServedClient : public testing::Test {
protected:
    static constexpr double answer_s = 1.0;

    /// The answer's PDU; empty when none came in time.
    Octets ask(const Octets &pdu, double longest_s = answer_s)
    {
        Octets request{unit};
        request.insert(request.end(), pdu.begin(), pdu.end());
        for (const std::uint8_t octet : rtu_frame(request)) {
            served.send(octet);
        }
        Octets       come;
        const double end_s = served.time_s() + longest_s;
        while (served.time_s() < end_s) {
            listen(come);
            if (!rtu_content(come)) {
                continue;
            }
            for (
                int n = 0; n < 20;
                n++) { // the silence that ends an answer: a part of one may have a sum that fits, too
                listen(come);
            }
            if (const std::optional<Octets> content = rtu_content(come)) {
                return {content->begin() + 1, content->end()};
            }
        }
        return {};
    }
    void listen(Octets &come)
    {
        served.period();
        after_period();
        for (int octet = served.take(); octet >= 0; octet = served.take()) {
            come.push_back(static_cast<std::uint8_t>(octet));
        }
    }
    bool write(unsigned first, const Words &words, double longest_s = answer_s)
    {
        return support::is_written(ask(support::write_pdu(first, words), longest_s));
    }
    int input(unsigned number)
    {
        return read(4, number);
    }
    int holding(unsigned number)
    {
        return read(3, number);
    }
    int read(std::uint8_t function, unsigned number)
    {
        return support::value_of(ask(support::read_pdu(function, number)));
    }
    void pass(double time_s)
    {
        const double end_s = served.time_s() + time_s;
        while (served.time_s() < end_s) {
            served.period();
            after_period();
        }
    }
    /// After each period that this client lets pass.
    virtual void after_period() {}

    std::uint8_t unit = 1;
    ServedBoard  served{shipped_drive(), 1};
};

} // namespace sdre
