// SPDX-License-Identifier: MIT
/// A CAN bus asks this of its members. Each of them has error counters.
#pragma once

#include <optional>

#include "sil/f28335/can_frame.hpp"

namespace sdre::f28335 {

enum class CanError {
    bit,   ///< the wire had another level than the sender's
    ack,   ///< nobody has acknowledged
    stuff, ///< heard by a receiver: six equal bits
    stuck  ///< the wire stays dominant; again every eight bits
};

/// Fault confinement of ISO 11898-1. Not modelled: errors within an error flag, and a receiver that is first to see
/// an error.
class CanErrorCounters {
public:
    int transmit() const
    {
        return transmit_;
    }
    int receive() const
    {
        return receive_;
    }
    bool warning() const
    {
        return transmit_ >= 96 || receive_ >= 96;
    }
    bool passive() const
    {
        return transmit_ >= 128 || receive_ >= 128;
    }
    bool bus_off() const
    {
        return transmit_ > 255;
    }
    void sent()
    {
        transmit_ -= transmit_ > 0 ? 1 : 0;
    }
    void received()
    {
        receive_ = receive_ >= 128 ? 127 : receive_ - (receive_ > 0 ? 1 : 0);
    }
    void failed(CanError error, bool sends)
    {
        if (sends) {
            transmit_ += error == CanError::ack && passive() ? 0 : 8;
        } else if (receive_ < 128) {
            receive_ += error == CanError::stuck ? 8 : 1;
        }
    }
    void reset()
    {
        transmit_ = 0;
        receive_  = 0;
    }

private:
    int transmit_ = 0; ///< 0 .. 263
    int receive_  = 0; ///< 0 .. 135
};

class CanMember {
public:
    CanMember()                             = default;
    CanMember(const CanMember &)            = delete;
    CanMember &operator=(const CanMember &) = delete;
    virtual ~CanMember()                    = default;

    /// 0: not on the bus, as in bus-off.
    virtual double bit_rate_Hz() const = 0;
    /// Acknowledges, and destroys what it finds wrong; false: listens only.
    virtual bool drives() const  = 0;
    virtual bool passive() const = 0;
    /// Has a frame to send.
    virtual bool                    wants() const = 0;
    virtual std::optional<CanFrame> next()        = 0;

    /// A frame has begun. A member that wants to send and does not has lost the arbitration.
    virtual void began(bool sends)               = 0;
    virtual void sent()                          = 0; ///< and acknowledged
    virtual void received(const CanFrame &frame) = 0;
    /// The frame is over without success. @param sends As of began().
    virtual void failed(CanError error, bool sends) = 0;
};

} // namespace sdre::f28335
