// SPDX-License-Identifier: MIT
/// One control period at a call: the drive in its loop, the core alone, the motor alone. These keep the interpreter's lock:
/// a period takes microseconds, and two threads must not step one object.
#include "bindings.hpp"

#include <array>
#include <memory>

#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "common/errors.hpp"
#include "sil/run/simulation.hpp"
#include "sil/run/trace_columns.hpp"

extern "C" {
#include "svpwm.h"
}

namespace nb = nanobind;

namespace sdre {
namespace {

/// Members of drive_sample_t, in its order but for the last two.
using Sample = std::tuple<float, float, float, float, float, float, float, float, int, bool>;
/// Members of bridge_t.
using Legs = std::tuple<float, float, float, bool>;

Sample sample_of(const drive_sample_t &s)
{
    return {s.ia_A,       s.ib_A,          s.dc_link_V,  s.theta_e_rad,     s.band_rad,
            s.edge_gap_s, s.omega_e_radps, s.edge_age_s, s.edge_of_pattern, s.valid};
}

drive_sample_t sample_of(const Sample &x)
{
    drive_sample_t s{};
    int            edge_of_pattern                   = 0;
    std::tie(s.ia_A, s.ib_A, s.dc_link_V, s.theta_e_rad, s.band_rad, s.edge_gap_s, s.omega_e_radps,
             s.edge_age_s, edge_of_pattern, s.valid) = x;
    s.edge_of_pattern                                = static_cast<std::int16_t>(edge_of_pattern);
    return s;
}

std::vector<double> values_of(const TraceRow &row)
{
    std::vector<double> values;
    for (const TraceColumn &column : trace_columns()) {
        values.push_back(column.of(row));
    }
    return values;
}

/// Drive and motor. The scenario is kept: the simulation points to it.
class Loop {
public:
    explicit Loop(const Scenario &s)
        : scenario_(s), controller_(prepare_controller(scenario_)),
          simulation_(scenario_, controller_)
    {
    }
    /// The period's row and why nothing can follow; 0: it goes on. Once ended it stays ended.
    std::tuple<std::vector<double>, std::string, bool> step(double omega_ref_e_radps,
                                                            double extra_load_Nm)
    {
        if (ended_) {
            throw InputError("the run has ended: the shaft turns too fast for the control period");
        }
        simulation_.set_extra_load_Nm(extra_load_Nm);
        const TickEnd end = simulation_.step(omega_ref_e_radps);
        ended_            = end.ended != 0;
        return {values_of(end.row), fault_name(end.fault != 0 ? end.fault : end.ended), ended_};
    }

private:
    Scenario   scenario_;
    Controller controller_;
    Simulation simulation_;
    bool       ended_ = false;
};

/// The control core with its constants.
class Core {
public:
    explicit Core(const Scenario &s) : controller_(prepare_controller(s))
    {
        if (drive_init(&drive_, &controller_.config) != CTL_OK) {
            throw DesignError("the control core refuses these constants");
        }
    }
    Core(const Core &) = delete; // the core points to its constants

    Legs tick(const Sample &sample, float omega_ref_e_radps, bool run)
    {
        const drive_sample_t  measured = sample_of(sample);
        const drive_command_t command{omega_ref_e_radps, run, 0.0F, nullptr};
        const bridge_t        b = drive_tick(&drive_, &measured, &command);
        return {b.duty.a, b.duty.b, b.duty.c, b.gate_enable};
    }
    void reset()
    {
        drive_reset(&drive_);
    }
    std::string fault() const
    {
        return fault_name(drive_.state == DRIVE_FAULT ? static_cast<int>(drive_.fault) : 0);
    }
    /// As the quantities of a trace that are the drive's.
    std::vector<double> values() const
    {
        TraceRow row;
        add_drive(row, drive_);
        return {row.iq_ref_A,    row.id_ref_A, row.vq_V,    row.vd_V,
                row.d_omega_hat, row.d_q_hat,  row.d_d_hat, row.sensor_offset_hat_A};
    }

private:
    Controller controller_;
    drive_t    drive_{};
};

/// Board and motor: duty ratios in, samples out. An input at a tick acts from the next one on.
class MotorOnBoard {
public:
    explicit MotorOnBoard(const Scenario &s)
        : scenario_(s), period_s_(control_period_s(s.drive)), board_(scenario_)
    {
        for (const InjectedFault &f : s.faults) {
            if (needs_processor(f.kind)) {
                throw InputError("[[fault]] of the processor needs the firmware's board");
            }
        }
        begin();
    }
    MotorOnBoard(const MotorOnBoard &) = delete; // the board points to the scenario

    Sample sample() const
    {
        return sample_;
    }
    /// At the present tick, the peak of the period before.
    std::vector<double> state() const
    {
        const PlantState x = board_.plant_state();
        return {time_s(),    x.omega_e_radps, x.current_A.q, x.current_A.d,
                x.torque_Nm, x.load_Nm,       x.dc_link_V,   board_.peak_current_A()};
    }
    double time_s() const
    {
        return static_cast<double>(tick_) * period_s_;
    }
    Sample step(const Legs &legs, double extra_load_Nm)
    {
        if (board_.runaway()) {
            throw InputError("the shaft turns too fast for the control period");
        }
        bridge_t next{};
        std::tie(next.duty.a, next.duty.b, next.duty.c, next.gate_enable) = legs;
        in_force_.gate_enable = in_force_.gate_enable && next.gate_enable; // off at once
        board_.run_period(in_force_);
        in_force_ = next.gate_enable ? bridge_closed(next.duty) : bridge_open();
        tick_++;
        board_.set_extra_load_Nm(extra_load_Nm);
        begin();
        return sample_;
    }

private:
    void begin()
    {
        board_.begin_tick(time_s());
        sample_ = sample_of(board_.sample());
    }

    Scenario scenario_;
    double   period_s_;
    Board    board_;
    bridge_t in_force_{{0.5F, 0.5F, 0.5F}, true}; ///< no voltage until the first result acts
    long     tick_ = 0;
    Sample   sample_;
};

/// The core's own modulator, of a voltage in the rotor frame.
std::tuple<float, float, float, float> duty_of(float vd_V, float vq_V, float theta_e_rad,
                                               float dc_link_V)
{
    const svpwm_t m =
        svpwm_within(frames_inverse_park({vd_V, vq_V}, frames_angle(theta_e_rad)), dc_link_V);
    return {m.duty.a, m.duty.b, m.duty.c, m.share};
}

} // namespace

void bind_loop(nb::module_ &m)
{
    nb::class_<Loop>(m, "Loop").def(nb::init<const Scenario &>()).def("step", &Loop::step);
    nb::class_<Core>(m, "Core")
        .def(nb::init<const Scenario &>())
        .def("tick", &Core::tick)
        .def("reset", &Core::reset)
        .def_prop_ro("fault", &Core::fault)
        .def_prop_ro("values", &Core::values);
    nb::class_<MotorOnBoard>(m, "Plant")
        .def(nb::init<const Scenario &>())
        .def("step", &MotorOnBoard::step)
        .def_prop_ro("sample", &MotorOnBoard::sample)
        .def_prop_ro("state", &MotorOnBoard::state);
    m.def("duty_of", &duty_of);
}

} // namespace sdre
