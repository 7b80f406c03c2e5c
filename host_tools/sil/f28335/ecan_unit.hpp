// SPDX-License-Identifier: MIT
/// eCAN-A in eCAN mode: mailboxes, bit timing, error states. The firmware polls it; its interrupts, time-outs, self-test
/// and power-down are not modelled.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sil/f28335/can_bus.hpp"
#include "sil/f28335/clock.hpp"
#include "sil/f28335/ecan_mailboxes.hpp"
#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

class EcanUnit final : public CanMember {
public:
    /// @param bus Outlives the unit; its time begins again.
    explicit EcanUnit(CanBus &bus);
    ~EcanUnit() override;

    /// Takes what the firmware has written, and presents what it may read.
    void sync(std::int64_t now_ticks, const Clock &clock, Findings &findings, double time_s);
    void pass(std::int64_t now_ticks);
    std::int64_t ticks_to_event(std::int64_t now_ticks) const; ///< -1: nothing is going on

    CanBus &bus()
    {
        return bus_;
    }
    /// The far end puts a frame onto the bus; false: it is not on the bus.
    bool send(const CanFrame &frame)
    {
        return bus_.far_end().send(frame);
    }
    /// The next frame that the far end has received.
    std::optional<CanFrame> take()
    {
        return bus_.far_end().take();
    }
    /// @param bit_rate_Hz Nothing: as the device has it. @param present False: it is off the bus.
    void set_far_end(std::optional<double> bit_rate_Hz, bool present = true);
    void set_fault(CanFault fault)
    {
        bus_.set_fault(fault);
    }

    /// As the registers say, whether the unit is on the bus or not.
    double configured_bit_rate_Hz() const
    {
        return rate_Hz_;
    }
    /// Share of the bit before its sample, 0 .. 1.
    static double           sample_point();
    const CanErrorCounters &errors() const
    {
        return counters_;
    }
    bool bus_off() const
    {
        return bus_off_;
    }

    double bit_rate_Hz() const override
    {
        return on_bus_ ? rate_Hz_ : 0.0;
    }
    bool drives() const override
    {
        return true;
    }
    bool passive() const override
    {
        return counters_.passive();
    }
    bool                    wants() const override;
    std::optional<CanFrame> next() override;
    void                    began(bool sends) override;
    void                    sent() override;
    void                    received(const CanFrame &frame) override;
    void                    failed(CanError error, bool sends) override;

private:
    enum class Mode { configuration, joining, running };
    struct Report {
        Findings &findings;
        double    time_s;
        void      say(const std::string &text, Finding kind = Finding::can) const
        {
            findings.add(kind, text, time_s);
        }
    };
    using Words = std::array<std::uint32_t, 4>; ///< of a mailbox

    std::uint32_t taken(volatile Uint64 &reg, std::uint32_t shown, const char *name,
                        const Report &report) const;
    void          take_requests(const Report &report);
    void          take_flags(const Report &report);
    void          take_status(const Report &report);
    void          take_time();
    void          take_mailboxes(const Report &report);
    const char   *refusal(int number, const Words &was, const Words &is) const;
    void          take_mode(const Report &report);
    void          take_timing(const Report &report);
    void          look_for_unsupported(const Report &report) const;
    void          soft_reset();
    void          abort(std::uint32_t boxes);
    void          update_mode();
    void          enter_bus_off();
    void          count_bits(std::int64_t now);
    void          present();
    void          remember();
    std::int64_t  ticks(int bits) const;
    std::uint32_t sendable() const;

    CanBus                      &bus_;
    CanErrorCounters             counters_;
    Mode                         mode_    = Mode::configuration;
    bool                         bus_off_ = false;
    bool                         on_bus_  = false;
    bool                         hears_   = false; ///< a frame of another is on the wires
    std::optional<int>           sending_;         ///< mailbox
    double                       rate_Hz_      = 0.0;
    std::int64_t                 now_          = 0;
    std::int64_t                 joining_from_ = 0; ///< recessive ticks of the bus
    std::int64_t                 bus_off_from_ = 0; ///< as well
    std::uint32_t                trs_ = 0, trr_ = 0, ta_ = 0, aa_ = 0, rmp_ = 0, rml_ = 0, rfp_ = 0;
    std::uint32_t                flags_     = 0; ///< of CANES
    std::uint32_t                shown_es_  = 0;
    std::uint32_t                shown_md_  = 0;
    std::uint32_t                shown_me_  = 0;
    std::uint32_t                shown_btc_ = 0;
    std::uint32_t                tsc_       = 0;
    std::uint32_t                shown_tsc_ = 0;
    std::int64_t                 tsc_at_    = 0;
    std::array<Words, mailboxes> boxes_{};
};

} // namespace sdre::f28335
