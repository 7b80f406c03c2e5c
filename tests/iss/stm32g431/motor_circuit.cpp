// SPDX-License-Identifier: MIT
#include "stm32g431/motor_circuit.hpp"

#include <algorithm>
#include <cmath>

namespace iss::stm32g431 {
namespace {

constexpr int codes  = 4096; // of a converter
constexpr int middle = codes / 2;

// docs/hardware_stm32g431.md, "Pins".
constexpr int input_of_a_and_b = 3;
constexpr int input_of_c       = 12;
constexpr int input_of_dc_link = 1;

constexpr double shunt_Ohm = 3e-3; // "Analog scaling"

constexpr double zero_degC_K = 273.15;
constexpr double ntc_25_K    = zero_degC_K + 25.0;

int within(double code)
{
    return static_cast<int>(std::clamp(code, 0.0, codes - 1.0));
}

/// Counted down from the top, then up to it: high around the counter's 0.
sdre::LegTiming timing_of(const PwmPeriod &period, int on_cnt, bool ideal)
{
    sdre::LegTiming leg;
    leg.duty       = static_cast<double>(std::min(on_cnt, period.full_cnt)) / period.full_cnt;
    leg.changes[0] = {0.0, on_cnt >= period.full_cnt};
    leg.count      = 1;
    if (on_cnt > 0 && on_cnt < period.full_cnt) {
        leg.changes[1] = {(period.full_cnt - on_cnt) * period.count_s, true};
        leg.changes[2] = {(period.full_cnt + on_cnt) * period.count_s, false};
        leg.count      = 3;
    }
    if (!ideal) {
        leg.rise_delay_s = period.dead_time_s;
        leg.fall_delay_s = period.dead_time_s;
    }
    return leg;
}

} // namespace

MotorCircuit::MotorCircuit(sdre::MotorBench &bench, const sdre::Drive &drive, bool ideal_inverter)
    : bench_(bench), board_(drive.board), ideal_inverter_(ideal_inverter)
{
}

void MotorCircuit::period_begins(const PwmPeriod &period)
{
    bench_.begin_tick();
    std::array<sdre::LegTiming, 3> legs;
    for (std::size_t n = 0; n < 3; n++) {
        legs[n] = timing_of(period, period.on_cnt[n], ideal_inverter_);
    }
    bench_.begin_period(legs);
    duty_cnt_ = period.on_cnt;
}

void MotorCircuit::gates_change(bool enabled, double into_period_s)
{
    bench_.set_legs({enabled, enabled, enabled}, into_period_s);
}

Shaft MotorCircuit::shaft()
{
    const sdre::RawSample &s = bench_.sample();
    Shaft                  now;
    now.count       = s.count;
    now.index       = s.index;
    now.index_count = s.index_count;
    for (const sdre::EncoderEdge &edge : bench_.edges()) {
        now.edges.push_back({bench_.period_s() - edge.time_s, edge.direction});
    }
    return now;
}

/// A current into the motor lowers the voltage at its shunt.
int MotorCircuit::current_code(int signed_code) const
{
    return within(middle - 1 + zero_cnt_ - signed_code);
}

/// NTC from the converter's full scale, the divider's resistor to ground.
int MotorCircuit::temperature_code() const
{
    const double inverse_K = 1.0 / (temperature_degC_ + zero_degC_K) - 1.0 / ntc_25_K;
    const double ntc_Ohm   = board_.ntc_resistance_Ohm * std::exp(board_.ntc_beta_K * inverse_K);
    return within(codes * board_.ntc_divider_Ohm / (board_.ntc_divider_Ohm + ntc_Ohm));
}

int MotorCircuit::code(int converter, int input)
{
    const sdre::RawSample &s = bench_.sample();
    if (input == input_of_a_and_b) {
        return current_code(converter == 1 ? s.ia_code : s.ib_code);
    }
    if (input == input_of_c) {
        return current_code(s.ic_code);
    }
    if (input == input_of_dc_link) {
        return within(codes * s.dc_link_V / board_.dc_link_range_V);
    }
    return temperature_code();
}

/// Above the level without current for a current out of the motor.
double MotorCircuit::shunt_V(int phase, double into_period_s)
{
    if (bench_.board() == nullptr) {
        return no_current_V;
    }
    bench_.advance_to(into_period_s);
    const sdre::PhaseVector i         = bench_.board()->plant().phase_current_A();
    const double            current_A = phase == 0 ? i.a : phase == 1 ? i.b : i.c;
    return no_current_V - 4.0 / 7.0 * shunt_Ohm * current_A;
}

} // namespace iss::stm32g431
