// SPDX-License-Identifier: MIT
#include "sil/f28335/can_bus.hpp"

#include <algorithm>

namespace sdre::f28335 {
namespace {

constexpr double      first_rate_Hz = 500e3;
constexpr std::size_t most_to_send  = 1024; // chosen: a tenth of a second at 1 Mbit/s
constexpr std::size_t most_received = 4096; // chosen: a test that takes nothing keeps the newest

} // namespace

void CanNode::open(std::optional<double> bit_rate_Hz, bool listens_only)
{
    close();
    open_         = true;
    rate_Hz_      = bit_rate_Hz;
    listens_only_ = listens_only;
    errors_.reset();
}

void CanNode::close()
{
    open_ = false;
    go_.clear();
    come_.clear();
}

bool CanNode::send(const CanFrame &frame)
{
    if (!open_ || listens_only_ || errors_.bus_off() || go_.size() >= most_to_send) {
        return false;
    }
    go_.push_back(frame);
    return true;
}

std::optional<CanFrame> CanNode::take()
{
    if (come_.empty()) {
        return std::nullopt;
    }
    const CanFrame frame = come_.front();
    come_.pop_front();
    return frame;
}

double CanNode::bit_rate_Hz() const
{
    return open_ && !errors_.bus_off() ? rate_Hz_.value_or(bus_.bit_rate_Hz()) : 0.0;
}

void CanNode::sent()
{
    errors_.sent();
    go_.pop_front();
}

void CanNode::received(const CanFrame &frame)
{
    errors_.received();
    if (come_.size() >= most_received) {
        come_.pop_front();
        overrun_ = true;
    }
    come_.push_back(frame);
}

void CanNode::failed(CanError error, bool sends)
{
    errors_.failed(error, sends);
}

CanBus::CanBus() : far_(std::make_unique<CanNode>(*this)), last_rate_Hz_(first_rate_Hz)
{
    main_.attach(*far_);
    far_->open();
}

void CanBus::connect(CanMember &device)
{
    disconnect();
    device_ = &device;
    (fault_ == CanFault::open ? stub_ : main_).attach(device);
    main_.restart();
    stub_.restart();
    now_ = 0;
}

void CanBus::disconnect()
{
    if (device_ != nullptr) {
        main_.detach(*device_);
        stub_.detach(*device_);
        device_ = nullptr;
    }
}

CanNode &CanBus::join()
{
    nodes_.push_back(std::make_unique<CanNode>(*this));
    main_.attach(*nodes_.back());
    return *nodes_.back();
}

void CanBus::leave(const CanNode &node)
{
    main_.detach(node);
    nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(),
                                [&node](const auto &n) { return n.get() == &node; }),
                 nodes_.end());
}

void CanBus::set_fault(CanFault fault)
{
    const bool was_cut = fault_ == CanFault::open;
    const bool is_cut  = fault == CanFault::open;
    const auto before  = recessive_ticks(now_);
    fault_             = fault;
    recessive_offset_ += before - recessive_ticks(now_);
    if (device_ != nullptr && was_cut != is_cut) {
        (was_cut ? stub_ : main_).detach(*device_);
        (is_cut ? stub_ : main_).attach(*device_);
    }
    main_.set_level(fault == CanFault::shorted    ? CanLevel::recessive
                    : fault == CanFault::dominant ? CanLevel::dominant
                                                  : CanLevel::free,
                    now_);
}

double CanBus::bit_rate_Hz() const
{
    const double now_Hz = device_ != nullptr ? device_->bit_rate_Hz() : 0.0;
    return now_Hz > 0.0 ? now_Hz : last_rate_Hz_;
}

void CanBus::pass(std::int64_t now)
{
    now_          = now;
    last_rate_Hz_ = bit_rate_Hz();
    main_.pass(now);
    stub_.pass(now);
}

std::int64_t CanBus::ticks_to_event(std::int64_t now) const
{
    const std::int64_t main = main_.ticks_to_event(now);
    const std::int64_t stub = stub_.ticks_to_event(now);
    return main < 0 ? stub : stub < 0 ? main : std::min(main, stub);
}

} // namespace sdre::f28335
