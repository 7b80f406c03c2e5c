// SPDX-License-Identifier: MIT
/// The two ways to run the application against a motor bench, tick by tick.
#pragma once

#include <string>
#include <vector>

#include "sil/board/board_choice.hpp"
#include "sil/board/fake_board.hpp"
#include "sil/board/motor_surroundings.hpp"
#include "sil/f28335/device.hpp"
#include "sil/f28335/modbus_master.hpp"
#include "sil/run/motor_bench.hpp"

extern "C" {
#include "app_status.h"
}

namespace sdre {

/// A running application; constructed, it has booted up to its first tick.
class BoardRun {
public:
    BoardRun(const BoardRun &)            = delete;
    BoardRun &operator=(const BoardRun &) = delete;
    virtual ~BoardRun()                   = default;

    /// One more control period: its tick, and what the background does after it. False: the device has stopped.
    virtual bool step() = 0;
    /// Sends a command; it acts some ticks later, always as many.
    virtual void set_speed(int tenths) = 0;
    virtual void set_run()             = 0;
    /// Asks for a commissioning, with its bounds in the units of their registers; call until it is true.
    virtual bool commission(std::uint16_t current, std::uint16_t speed) = 0;
    virtual bool can_command() const                                    = 0;
    /// Breaks the processor; InputError where there is none.
    virtual void inject(FaultKind kind) = 0;
    /// Nothing will be commanded for a while: time for other talk.
    virtual void                     chat() {}
    virtual std::array<int, 3>       duty_cnt() const = 0;
    virtual std::vector<std::string> findings() const
    {
        return {};
    }
    virtual int answers() const
    {
        return 0;
    }
    virtual int errors() const
    {
        return 0;
    }
    /// After a tick. The application and the drive are this process's, unless a board has its own.
    virtual app_status_t   status() const;
    virtual const drive_t &drive() const;
    MotorBench            &bench()
    {
        return bench_;
    }

protected:
    explicit BoardRun(const Scenario &scenario, long start_tick) : bench_(scenario, start_tick) {}

    MotorBench bench_;
};

class ApiRun : public BoardRun {
public:
    ApiRun(const Scenario &scenario, long start_tick, double dead_time_s);
    bool step() override;
    void set_speed(int tenths) override;
    void set_run() override;
    bool commission(std::uint16_t current, std::uint16_t speed) override;
    bool can_command() const override
    {
        return wait_ticks_ == 0;
    }
    void               inject(FaultKind kind) override;
    std::array<int, 3> duty_cnt() const override;

private:
    void command();

    int                     tenths_           = 0;
    bool                    run_              = false;
    bool                    commission_ready_ = false;
    int                     wait_ticks_       = 0; ///< before the command goes; 0: there is none
    f28335::FakeBoard       fake_;
    f28335::FakeBoardChoice choice_;
};

/// An application that takes its commands over its serial line.
class ModbusRun : public BoardRun {
public:
    void set_speed(int tenths) override;
    void set_run() override;
    bool commission(std::uint16_t current, std::uint16_t speed) override;
    bool can_command() const override
    {
        return !master().busy();
    }
    void chat() override;
    int  answers() const override
    {
        return master().answers();
    }
    int errors() const override
    {
        return master().errors();
    }
    /// Any holding register; can_command() says when.
    void write(std::uint16_t address, std::uint16_t value)
    {
        master().write(address, value);
    }
    void write(std::uint16_t first, const std::vector<std::uint16_t> &values)
    {
        master().write(first, values);
    }
    /// The answer to chat(): the first input registers; empty until it is there.
    const std::vector<std::uint16_t> &registers() const
    {
        return master().values();
    }

protected:
    using BoardRun::BoardRun;

private:
    virtual f28335::ModbusMaster       &master()       = 0;
    virtual const f28335::ModbusMaster &master() const = 0;
    void                                command();

    int         tenths_            = 0;
    bool        run_               = false;
    std::size_t commission_writes_ = 0;
};

class F28335Run : public ModbusRun {
public:
    F28335Run(const Scenario &scenario, long start_tick, double dead_time_s);
    bool                     step() override;
    void                     inject(FaultKind kind) override;
    std::array<int, 3>       duty_cnt() const override;
    std::vector<std::string> findings() const override;

private:
    f28335::ModbusMaster &master() override
    {
        return master_;
    }
    const f28335::ModbusMaster &master() const override
    {
        return master_;
    }

    f28335::MotorSurroundings surroundings_;
    f28335::Device            device_;
    f28335::ModbusMaster      master_;
};

/// InputError when the drive's board has another processor.
void require_f28335(const Drive &drive);

/// The constants that main() hands to board and application: those of the controller, and what the board is for the drive.
/// InputError when the board cannot have it.
void set_firmware(const drive_config_t &config, const Drive &drive);

} // namespace sdre
