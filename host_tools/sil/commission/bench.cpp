// SPDX-License-Identifier: MIT
#include "sil/commission/bench.hpp"

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "sil/run/board.hpp"
#include "sil/setup/board_reader.hpp"

namespace sdre {
namespace {

const double two_pi = 4.0 * std::acos(0.0);

// Chosen: longer than any stage may take together.
constexpr double longest_s = 600.0;
// Chosen: around the nominal voltage, as a board that trips there.
constexpr double dc_link_low  = 0.7;
constexpr double dc_link_high = 1.25;

} // namespace

Scenario commission_scenario(const Drive &truth, const CommissionOptions &o)
{
    Scenario s;
    s.name                               = "commission";
    s.drive                              = truth;
    s.dc_link_V                          = truth.inverter.dc_link_V;
    s.sensors                            = sensors_of_drive(truth);
    s.sensors.ideal                      = false;
    s.seed                               = o.seed;
    s.motor_effects                      = effects_of_drive(truth);
    s.motor_effects.coulomb_friction_Nm  = o.coulomb_share * truth.motor.rated_torque_Nm;
    s.motor_effects.cogging_amplitude_Nm = o.cogging_share * truth.motor.rated_torque_Nm;
    s.motor_effects.cogging_order        = 6.0 * truth.motor.pole_pairs;
    return s;
}

namespace {

/// The plant's board as the module sees it.
class Bench {
public:
    explicit Bench(const Scenario &scenario)
        : scenario_(scenario), board_(scenario_), period_s_(control_period_s(scenario.drive)),
          reversed_(scenario.seed % 2 == 0), channel_a_(channel_a(scenario_.sensors)),
          channel_b_(channel_b(scenario_.sensors))
    {
    }

    commission_sample_t sample(long tick)
    {
        board_.begin_tick(static_cast<double>(tick) * period_s_);
        const RawSample raw = board_.raw_sample();
        if (tick == 0) {
            first_cnt_ = raw.count;
        }
        commission_sample_t s{};
        s.ia_A         = static_cast<float>(adc_current_A(channel_a_, raw.ia_code));
        s.ib_A         = static_cast<float>(adc_current_A(channel_b_, raw.ib_code));
        s.dc_link_V    = static_cast<float>(raw.dc_link_V);
        s.position_cnt = seen(raw.count);
        s.index_cnt    = seen(raw.index_count);
        s.index_seen   = raw.index;
        s.valid        = true;
        return s;
    }

    void run_period(const bridge_t &answer)
    {
        in_force_.gate_enable = in_force_.gate_enable && answer.gate_enable;
        board_.run_period(in_force_);
        in_force_ = answer;
    }

    const Board &board() const
    {
        return board_;
    }
    bool reversed() const
    {
        return reversed_;
    }
    /// Electrical angle of the d axis at position 0.
    double offset_e_rad() const
    {
        const Drive &d = scenario_.drive;
        return std::remainder(static_cast<double>(first_cnt_) * count_e_rad(d), two_pi);
    }
    double coulomb_Nm() const
    {
        return scenario_.motor_effects.coulomb_friction_Nm;
    }

private:
    std::int32_t seen(std::int64_t count) const
    {
        // An encoder that counts the other way: the edges stay where they are, a count is the state below.
        const std::int64_t from = count - first_cnt_;
        return static_cast<std::int32_t>(reversed_ ? -from - 1 : from);
    }

    Scenario     scenario_;
    Board        board_;
    double       period_s_;
    bool         reversed_;
    AdcChannel   channel_a_;
    AdcChannel   channel_b_;
    std::int64_t first_cnt_ = 0;
    bridge_t     in_force_{{0.5F, 0.5F, 0.5F}, false};
};

} // namespace

commission_config_t commission_config_of(const Drive &d, const CommissionOptions &o)
{
    commission_config_t c{};
    c.ts_s              = static_cast<float>(control_period_s(d));
    c.current_max_A     = static_cast<float>(o.current_share * d.motor.max_current_A);
    c.speed_max_m_radps = static_cast<float>(
        std::max(d.motor.rated_speed_e_radps, d.motor.max_speed_e_radps) / d.motor.pole_pairs);
    c.dc_link_min_V   = static_cast<float>(dc_link_low * d.inverter.dc_link_V);
    c.dc_link_max_V   = static_cast<float>(dc_link_high * d.inverter.dc_link_V);
    c.counts_per_turn = o.lines_known ? 4 * d.encoder.lines : 0;
    return c;
}

CommissionRun commission(const Drive &truth, const CommissionOptions &o)
{
    return commission_in(commission_scenario(truth, o), o);
}

CommissionRun commission_in(const Scenario &scenario, const CommissionOptions &o)
{
    const Drive              &truth  = scenario.drive;
    const commission_config_t config = commission_config_of(truth, o);
    const double              ts     = control_period_s(truth);
    const long                most   = std::lround(longest_s / ts);
    Bench                     bench(scenario);
    commission_t              module{};
    CommissionRun             run;
    double                    peak_A = 0.0;

    commission_init(&module, &config);
    commission_start(&module);
    long tick = 0;
    for (; tick < most && module.stage < COMMISSION_FINISHED; tick++) {
        const commission_sample_t sample = bench.sample(tick);
        const bridge_t            answer = commission_tick(&module, &sample, true);
        bench.run_period(answer);
        peak_A             = std::max(peak_A, bench.board().peak_current_A());
        run.peak_current_A = std::max(run.peak_current_A, peak_A);
        if (o.trace_every > 0 && tick % o.trace_every == 0) {
            const PlantState p = bench.board().plant_state();
            run.trace.push_back({static_cast<double>(tick) * ts, module.stage, p.current_A.d,
                                 p.current_A.q, p.omega_e_radps,
                                 bench.board().plant().theta_e_rad(), peak_A});
            peak_A = 0.0;
        }
        if (bench.board().runaway()) {
            break;
        }
    }
    run.stage             = module.stage;
    run.during            = module.last_stage;
    run.reason            = module.reason;
    run.found             = module.found;
    run.map               = module.map;
    run.time_s            = static_cast<double>(tick) * ts;
    run.bound_A           = static_cast<double>(config.current_max_A);
    run.true_offset_e_rad = bench.offset_e_rad();
    run.true_coulomb_Nm   = bench.coulomb_Nm();
    run.reversed          = bench.reversed();
    return run;
}

const char *commission_stage_name(commission_stage_t stage)
{
    switch (stage) {
    case COMMISSION_IDLE:
        return "idle";
    case COMMISSION_WATCH:
        return "watch";
    case COMMISSION_LOOK:
        return "look";
    case COMMISSION_RESISTANCE:
        return "resistance";
    case COMMISSION_DRAG:
        return "drag";
    case COMMISSION_MAP:
        return "map";
    case COMMISSION_SPIN:
        return "spin";
    case COMMISSION_RING:
        return "ring";
    case COMMISSION_FINISHED:
        return "finished";
    case COMMISSION_ABORTED:
        return "aborted";
    }
    return "?";
}

const char *commission_reason_text(commission_reason_t reason)
{
    switch (reason) {
    case COMMISSION_REASON_NONE:
        return "none";
    case COMMISSION_REASON_CONFIG:
        return "a bound is out of range";
    case COMMISSION_REASON_SAMPLE:
        return "invalid sample";
    case COMMISSION_REASON_OVER_CURRENT:
        return "over-current";
    case COMMISSION_REASON_DC_LINK:
        return "dc link out of range";
    case COMMISSION_REASON_OVER_SPEED:
        return "over-speed";
    case COMMISSION_REASON_ENCODER:
        return "the encoder's position jumped";
    case COMMISSION_REASON_TIMEOUT:
        return "a stage takes too long";
    case COMMISSION_REASON_WITHDRAWN:
        return "command withdrawn";
    case COMMISSION_REASON_MOVING:
        return "shaft or currents not at rest before the start";
    case COMMISSION_REASON_INDUCTANCE:
        return "the current does not follow the voltage";
    case COMMISSION_REASON_RESISTANCE:
        return "direct currents make no line";
    case COMMISSION_REASON_DRAG:
        return "the rotor does not follow, or pole pairs are not whole";
    case COMMISSION_REASON_SPIN:
        return "the shaft does not turn as its torque says";
    case COMMISSION_REASON_NUMERIC:
        return "a result is no number";
    case COMMISSION_REASON_SENSOR:
        return "a current sensor or a phase does not answer";
    case COMMISSION_REASON_RING:
        return "the shaft oscillates beyond its limit";
    }
    return "?";
}

} // namespace sdre
