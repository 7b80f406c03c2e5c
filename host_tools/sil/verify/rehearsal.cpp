// SPDX-License-Identifier: MIT
#include "sil/verify/rehearsal.hpp"

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "sil/run/faults.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/board_reader.hpp"

namespace sdre {
namespace {

constexpr std::array<const char *, believed_count> names{
    "inertia",      "magnet flux",    "d inductance", "q inductance",  "resistance",
    "dry friction", "encoder's zero", "dead time",    "encoder's disc"};
constexpr std::uint64_t difference_stream = 64; ///< of its own: NoiseStream ends below

double of(const Difference &x, Believed what)
{
    return x[static_cast<std::size_t>(what)];
}

/// Runs and records as the application does over its registers.
class Rehearsal {
public:
    Rehearsal(const Scenario &scenario, const Controller &controller, const Programme &programme)
        : programme_(programme), simulation_(scenario, controller)
    {
    }

    Records run()
    {
        Records records;
        for (const Shot &shot : programme_.shots) {
            go(shot.from_e_radps, programme_.way_e_radps2);
            wait(programme_.settle_s);
            if (fault_ == 0) {
                records.shots.push_back(take(shot));
            }
            if (fault_ != 0) {
                records.fault = fault_name(fault_);
                break;
            }
        }
        return records;
    }

private:
    /// One period with the reference on a ramp; 0: a step.
    void step(double to_e_radps, double accel_e_radps2)
    {
        const double most = accel_e_radps2 > 0.0 ? accel_e_radps2 * programme_.period_s
                                                 : std::abs(to_e_radps - reference_e_radps_);
        reference_e_radps_ += std::clamp(to_e_radps - reference_e_radps_, -most, most);
        const TickEnd end = simulation_.step(reference_e_radps_);
        const int     now = end.fault != 0 ? end.fault : end.ended;
        fault_            = fault_ != 0 ? fault_ : now;
    }

    void go(double to_e_radps, double accel_e_radps2)
    {
        while (reference_e_radps_ != to_e_radps && fault_ == 0) {
            step(to_e_radps, accel_e_radps2);
        }
    }

    void wait(double time_s)
    {
        const long periods = std::lround(time_s / programme_.period_s);
        for (long k = 0; k < periods && fault_ == 0; k++) {
            step(reference_e_radps_, 0.0);
        }
    }

    double signal(const std::string &name) const
    {
        const drive_t &d = simulation_.drive();
        const float    x = name == "SPEED" ? d.answer.now.omega_e_radps
                           : name == "IQ"  ? d.answer.now.iq_A
                           : name == "ID"  ? d.answer.now.id_A
                           : name == "VQ"  ? d.v_V.q
                                           : d.v_V.d;
        return static_cast<double>(x);
    }

    void note(Record &record, const Shot &shot) const
    {
        for (std::size_t k = 0; k < record.values.size(); k++) {
            record.values[k].push_back(signal(shot.signals[k]));
        }
    }

    /// The scope waits with its oldest samples lost until the speed passes the level.
    Record take(const Shot &shot)
    {
        const auto before = static_cast<std::size_t>(programme_.before);
        Record     record;
        for (std::size_t k = 0; k <= before && fault_ == 0; k++) {
            step(shot.from_e_radps, 0.0);
            note(record, shot);
        }
        for (long k = 0; k < longest_wait() && fault_ == 0 && !is_past(record, shot); k++) {
            step(shot.to_e_radps, shot.accel_e_radps2);
            note(record, shot);
            for (std::vector<double> &values : record.values) {
                values.erase(values.begin());
            }
        }
        if (fault_ == 0 && !is_past(record, shot)) {
            fault_ = static_cast<int>(DRIVE_FAULT_STALL);
        }
        while (record.values[0].size() < static_cast<std::size_t>(programme_.samples) &&
               fault_ == 0) {
            step(shot.to_e_radps, shot.accel_e_radps2);
            note(record, shot);
        }
        return record;
    }

    static bool is_past(const Record &record, const Shot &shot)
    {
        const double way = shot.to_e_radps - shot.from_e_radps;
        return (record.values[0].back() - shot.trigger_e_radps()) * way >= 0.0;
    }

    long longest_wait() const
    {
        return std::lround(60.0 /
                           programme_.period_s); // chosen: longer than any way of the programme
    }

    const Programme &programme_;
    Simulation       simulation_;
    double           reference_e_radps_ = 0.0;
    int              fault_             = 0;
};

} // namespace

const char *believed_name(Believed what)
{
    return names.at(static_cast<std::size_t>(what));
}

Difference draw_difference(std::uint64_t seed)
{
    Uniform    uniform(seed, difference_stream);
    Difference x{};
    for (std::size_t k = 0; k < x.size(); k++) {
        x[k] = uniform.next(k == static_cast<std::size_t>(Believed::friction) ? 0.0 : -1.0, 1.0);
    }
    return x;
}

Scenario machine_on_bench(const Drive &d, const Difference &x, std::uint64_t seed)
{
    const Uncertainty &u = d.uncertainty;
    Scenario           s;
    s.name                         = d.name;
    s.drive                        = d;
    s.dc_link_V                    = d.inverter.dc_link_V;
    s.seed                         = seed;
    s.sensors                      = sensors_of_drive(d);
    s.sensors.ideal                = false;
    s.speed_reference              = {{0.0, 0.0}};
    s.load_torque                  = {{0.0, 0.0}};
    s.plant_scale                  = {{"inertia_kgm2", 1.0 + u.inertia * of(x, Believed::inertia)},
                                      {"pm_flux_Wb", 1.0 + u.pm_flux * of(x, Believed::pm_flux)},
                                      {"d_axis_inductance_H", 1.0 + u.inductance * of(x, Believed::d_inductance)},
                                      {"q_axis_inductance_H", 1.0 + u.inductance * of(x, Believed::q_inductance)},
                                      {"stator_resistance_Ohm", 1.0 + u.resistance * of(x, Believed::resistance)}};
    s.sensors.encoder_offset_e_rad = u.angle_e_rad * of(x, Believed::angle);
    double &own_cnt                = s.sensors.encoder_disc.jitter_rms_cnt;
    own_cnt = std::max(0.0, own_cnt + u.disc_own_cnt * of(x, Believed::disc));
    s.inverter.dead_time_s =
        d.inverter.dead_time_s * (1.0 + u.dead_time * of(x, Believed::dead_time));
    s.motor_effects.coulomb_friction_Nm =
        d.motor.rated_torque_Nm * u.friction * std::max(0.0, of(x, Believed::friction));
    return s;
}

Records rehearse(const Scenario &machine, const Controller &controller, const Programme &programme)
{
    return Rehearsal(machine, controller, programme).run();
}

Controller controller_of(const Drive &drive)
{
    return prepare_controller(machine_on_bench(drive, {}, 0));
}

} // namespace sdre
