// SPDX-License-Identifier: MIT
/// FDCAN1 with classic frames, on a CAN bus: one receive FIFO, standard filters, the transmit queue, error states. Not
/// modelled: CAN FD, the second FIFO, extended filters, events, time-outs, test modes, power-down.
#pragma once

#include "sil/f28335/can_bus.hpp"
#include "stm32g431/system.hpp"

namespace iss::stm32g431 {

class CanModule : public Registers, public sdre::f28335::CanMember {
public:
    CanModule(Core &core, const Rcc &rcc, const Gpio &port_a, const Gpio &port_b,
              const Gpio &port_c);
    ~CanModule() override;
    CanModule(const CanModule &)            = delete;
    CanModule &operator=(const CanModule &) = delete;

    /// The bus outlives the module; its time begins now. Without one the module is alone.
    void connect(sdre::f28335::CanBus &bus);
    void reset() override;

    std::uint64_t due() const; ///< cycle of what happens next on the bus
    void          step();      ///< up to now
    bool          interrupts() const;

    /// Words of the module's memory: 28 filters, FIFO 0 and the transmit buffers.
    Registers &memory()
    {
        return memory_;
    }

    double bit_rate_Hz() const override;
    bool   drives() const override
    {
        return true;
    }
    bool passive() const override
    {
        return counters_.passive();
    }
    bool                                  wants() const override;
    std::optional<sdre::f28335::CanFrame> next() override;
    void                                  began(bool sends) override;
    void                                  sent() override;
    void                                  received(const sdre::f28335::CanFrame &frame) override;
    void                                  failed(sdre::f28335::CanError error, bool sends) override;

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    class Memory : public Registers {
    public:
        Memory(Core &core, const CanModule &module)
            : Registers(core, "FDCAN memory", 0x400), module_(module)
        {
        }

    protected:
        void on_write(std::uint32_t offset, std::uint32_t value) override;

    private:
        const CanModule &module_;
    };
    enum class Mode { configuration, joining, running };

    void                   write_control(std::uint32_t value);
    void                   request(std::uint32_t buffers);
    void                   acknowledge(std::uint32_t index);
    void                   configure();
    void                   update_mode();
    bool                   is_connected() const;
    double                 configured_Hz() const;
    std::uint32_t          is_accepted(std::uint32_t id) const; ///< element of the filter; 0: no
    int                    first_pending() const;               ///< -1: none
    sdre::f28335::CanFrame frame_of(int buffer) const;
    std::int64_t           ticks() const; ///< of the bus, since connect()
    std::int64_t           bits(int count) const;

    const Rcc                     &rcc_;
    const Gpio                    &port_a_;
    const Gpio                    &port_b_;
    const Gpio                    &port_c_;
    Memory                         memory_;
    sdre::f28335::CanBus          *bus_ = nullptr;
    sdre::f28335::CanErrorCounters counters_;
    Mode                           mode_       = Mode::configuration;
    bool                           leaves_     = false; ///< when the frame on the bus is over
    bool                           busy_       = false; ///< a frame is on the bus
    bool                           bus_off_    = false;
    int                            sending_    = -1;
    std::int64_t                   waits_from_ = 0; ///< recessive ticks of the bus
    std::uint64_t                  zero_cycle_ = 0;
    std::uint32_t                  pending_    = 0;
    std::uint32_t                  got_        = 0; ///< index of the oldest frame in FIFO 0
    std::uint32_t                  held_       = 0; ///< frames in it
};

} // namespace iss::stm32g431
