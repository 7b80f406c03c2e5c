// SPDX-License-Identifier: MIT
/// An STM32G431 that runs its image in a circuit. A cycle is 1 / 170 MHz, also before the PLL runs.
///
/// Not modelled: the flash's waits, parity of the RAM.
#pragma once

#include <memory>

#include "stm32g431/can_module.hpp"
#include "stm32g431/circuit.hpp"
#include "stm32g431/converter.hpp"
#include "stm32g431/flash.hpp"
#include "stm32g431/serial.hpp"
#include "stm32g431/system.hpp"
#include "stm32g431/timers.hpp"

namespace iss::stm32g431 {

constexpr double core_Hz = 170e6;

class Chip {
public:
    /// Powers up with this image in the flash.
    Chip(const ElfImage &image, Circuit &circuit);

    void   run_for(double time_s);
    void   run_to(std::uint64_t cycle);
    double time_s() const
    {
        return static_cast<double>(core_.cycles()) / core_Hz;
    }
    std::uint64_t period_began() const ///< cycle of the last top
    {
        return period_began_;
    }
    int resets() const ///< since the last power_cycle()
    {
        return resets_;
    }
    /// Off and on. The RAM holds anything, and so does what the flash was erasing or writing.
    void power_cycle();
    /// The comparators look so often, and not at the counter's top alone.
    void look_each(double time_s)
    {
        look_ = static_cast<std::uint64_t>(time_s * core_Hz);
    }
    /// A comparator sees too much current.
    void set_over_current(bool active);
    void open_home_switch(bool open)
    {
        port_a_.drive(15, open);
    }
    void press_button(bool pressed)
    {
        port_c_.drive(10, !pressed);
    }
    void break_crystal()
    {
        rcc_.break_crystal();
    }
    /// The crystal stops; cycles stay what they are.
    void stop_crystal();
    /// No conversion begins until a reset.
    void lose_trigger()
    {
        trigger_lost_ = true;
    }
    bool gates_enabled() const
    {
        return timer_.enabled();
    }
    /// Compare values for the coming period, as the program has written them.
    std::array<int, 3> written_cnt() const
    {
        return timer_.written_cnt();
    }
    /// One bit for each page of the CCM SRAM.
    std::uint32_t protected_pages() const
    {
        return ccm_.protected_pages();
    }
    bool light() const
    {
        return port_c_.output(6);
    }
    const Flash &flash() const
    {
        return flash_;
    }
    Serial &serial()
    {
        return serial_;
    }
    /// The CAN module on this bus, which outlives the chip.
    void connect_can(sdre::f28335::CanBus &bus)
    {
        can_.connect(bus);
    }
    Core &core()
    {
        return core_;
    }
    const Core &core() const
    {
        return core_;
    }

private:
    class CycleCounter : public Device {
    public:
        explicit CycleCounter(Core &core) : core_(core) {}
        std::uint32_t read(std::uint32_t offset, unsigned octets) override;
        void          write(std::uint32_t offset, std::uint32_t value, unsigned octets) override;

    private:
        Core         &core_;
        std::uint64_t zero_ = 0;
        std::uint32_t on_   = 0;
    };

    /// Peripherals by their address.
    class Bus : public Device {
    public:
        Bus(Core &core, std::uint32_t base) : core_(core), base_(base) {}
        void          add(std::uint32_t address, std::uint32_t octets, Device &device);
        std::uint32_t read(std::uint32_t offset, unsigned octets) override;
        void          write(std::uint32_t offset, std::uint32_t value, unsigned octets) override;

    private:
        struct Place {
            std::uint32_t address;
            std::uint32_t octets;
            Device       *device;
        };
        const Place *find(std::uint32_t address, const char *what);

        Core              &core_;
        std::uint32_t      base_;
        std::vector<Place> places_;
    };

    void          connect();
    void          reset_devices();
    void          restart(std::uint32_t cause);
    std::uint64_t next_event();
    void          serve_events();
    void          begin_period();
    void          update_gates();
    void          update_lines();
    void          update_comparators();
    bool          is_above(int phase, double pin_V) const;

    Core          core_;
    Circuit      &circuit_;
    Rcc           rcc_{core_};
    Registers     power_{core_, "PWR", 0x400};
    Flash         flash_{core_};
    Gpio          port_a_{core_, "GPIOA"};
    Gpio          port_b_{core_, "GPIOB"};
    Gpio          port_c_{core_, "GPIOC"};
    Registers     analog_{core_, "SYSCFG", 0x400}; // SYSCFG, comparators, amplifiers
    CcmMemory     ccm_{core_, analog_};
    Registers     dac_{core_, "DAC3", 0x400};
    PwmTimer      timer_{core_, {&port_a_, &port_b_, &port_c_}};
    EncoderTimer  encoder_{core_, port_b_};
    EdgeTimer     edges_{core_};
    Converter     adc1_{core_, 1};
    Converter     adc2_{core_, 2};
    Registers     adc_common_{core_, "ADC12", 0x100};
    Serial        serial_{core_};
    CanModule     can_{core_, rcc_, port_a_, port_b_, port_c_};
    Watchdog      watchdog_{core_};
    CycleCounter  counter_{core_};
    Bus           apb_{core_, 0x40000000};
    Bus           ports_{core_, 0x48000000};
    Bus           fast_{core_, 0x50000000};
    bool          gates_        = false;
    bool          trigger_lost_ = false;
    bool          over_current_ = false; // from outside
    std::uint64_t period_began_ = 0;
    std::uint64_t asked_        = 0; // of run_to()
    std::uint64_t look_         = 0; // of look_each()
    std::uint64_t looks_        = UINT64_MAX;
    int           resets_       = 0;
    std::uint8_t  anything_     = 0; // in the RAM
};

} // namespace iss::stm32g431
