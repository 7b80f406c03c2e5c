// SPDX-License-Identifier: MIT
/// The CAN bus of a virtual device: the device, and any number of members outside of it.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "sil/f28335/can_wire.hpp"

namespace sdre::f28335 {

enum class CanFault {
    none,
    open,    ///< the cable is pulled at the device: it is alone on its stub
    shorted, ///< both wires of the pair are connected: nobody can send
    dominant ///< somebody drives the pair all the time
};

class CanBus;

/// A member outside of the device.
class CanNode final : public CanMember {
public:
    explicit CanNode(const CanBus &bus) : bus_(bus) {}

    /// On the bus from now on, with its error counters at 0. @param bit_rate_Hz > 0; nothing: as the device has it.
    void open(std::optional<double> bit_rate_Hz = std::nullopt, bool listens_only = false);
    /// Off the bus; what it has not sent yet is lost.
    void close();
    bool is_open() const
    {
        return open_;
    }
    /// Queues a frame. False: the node is closed or in bus-off, or its queue is full.
    bool send(const CanFrame &frame);
    /// The oldest frame that it has received.
    std::optional<CanFrame> take();
    const CanErrorCounters &errors() const
    {
        return errors_;
    }
    /// Received frames were lost, because nobody has taken them.
    bool overrun() const
    {
        return overrun_;
    }
    void clear_overrun()
    {
        overrun_ = false;
    }

    double bit_rate_Hz() const override;
    bool   drives() const override
    {
        return !listens_only_;
    }
    bool passive() const override
    {
        return errors_.passive();
    }
    bool wants() const override
    {
        return !go_.empty();
    }
    std::optional<CanFrame> next() override
    {
        return go_.empty() ? std::nullopt : std::optional<CanFrame>(go_.front());
    }
    void began(bool /*sends*/) override {}
    void sent() override;
    void received(const CanFrame &frame) override;
    void failed(CanError error, bool sends) override;

private:
    const CanBus         &bus_;
    bool                  open_         = false;
    bool                  listens_only_ = false;
    bool                  overrun_      = false;
    std::optional<double> rate_Hz_;
    CanErrorCounters      errors_;
    std::deque<CanFrame>  go_;
    std::deque<CanFrame>  come_;
};

class CanBus {
public:
    CanBus();

    /// The device on this bus; it has to outlive the bus or to be disconnected. Time begins at 0.
    void connect(CanMember &device);
    void disconnect();
    /// A member that stays until leave(); closed at first.
    CanNode &join();
    void     leave(const CanNode &node);
    /// The member that a test has without join(): open at the device's bit rate.
    CanNode &far_end()
    {
        return *far_;
    }

    void     set_fault(CanFault fault);
    CanFault fault() const
    {
        return fault_;
    }
    /// The device has this rate. When it is off the bus, it is the last one; before any it is 500 kbit/s.
    double bit_rate_Hz() const;

    void         pass(std::int64_t now_ticks);
    std::int64_t ticks_to_event(std::int64_t now_ticks) const; ///< -1: nothing is going on
    /// As CanWire's, where the device is.
    std::int64_t recessive_ticks(std::int64_t now_ticks) const
    {
        return recessive_offset_ + device_wire().recessive_ticks(now_ticks);
    }
    bool idle() const
    {
        return device_wire().idle();
    }
    /// Share of the last whole 100 ms in which the device's wires were busy, 0 .. 1.
    double load() const
    {
        return device_wire().load(now_);
    }

private:
    const CanWire &device_wire() const
    {
        return fault_ == CanFault::open ? stub_ : main_;
    }

    CanMember                            *device_ = nullptr;
    std::vector<std::unique_ptr<CanNode>> nodes_;
    std::unique_ptr<CanNode>              far_;
    CanFault                              fault_ = CanFault::none;
    CanWire                               main_;
    CanWire                               stub_; ///< of the device alone
    std::int64_t                          now_ = 0;
    double                                last_rate_Hz_;
    std::int64_t recessive_offset_ = 0; ///< so that it goes on when the cable is pulled
};

} // namespace sdre::f28335
