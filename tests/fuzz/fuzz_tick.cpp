// SPDX-License-Identifier: MIT
/// Periods of the core with any samples and commands, under every law. The input drives a motor,
/// with readings and commands of any bits in between.
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "bytes.hpp"
#include "design/design.hpp"
#include "drive/drive_file.hpp"

extern "C" {
#include "gain_tables.h"
#include "harmonic_tables.h"
#include "speed_tables.h"
}

namespace {

// Tables for the laws whose design takes long.
const std::array<const drive_config_t *, 4> tables = {
    &gain_tables_drive, &speed_tables_drive, &conventional_tables_drive, &harmonic_tables_drive};
const std::array<const char *, 7> names = {
    "ipmsm_390w_counts", "servo_200w_pid",    "servo_200w_cdobc",      "servo_200w_gpiobc",
    "servo_200w_hdobc",  "ipmsm_390w_pi_foc", "ipmsm_390w_ladrc_edges"};

/// One of every law; designed when it is asked for the first time.
const drive_config_t &config_of(std::size_t n)
{
    if (n < tables.size()) {
        return *tables.at(n);
    }
    static std::array<std::unique_ptr<sdre::Design>, names.size()> designs;
    const std::size_t                                              at  = n - tables.size();
    std::unique_ptr<sdre::Design>                                 &one = designs.at(at);
    if (!one) {
        const std::string file = std::string(SDRE_DRIVES) + "/" + names.at(at) + ".toml";
        one = std::make_unique<sdre::Design>(sdre::design_drive(sdre::read_drive_file(file)));
    }
    return one->config;
}

void require(bool condition)
{
    if (!condition) {
        std::abort();
    }
}

bool ratio(float x)
{
    return x >= 0.0F && x <= 1.0F; // false of a NaN
}

bool in_range(const position_motion_t &m, const drive_config_t &c)
{
    return std::abs(m.omega_e_radps) <= c.speed_max_e_radps &&
           std::isfinite(m.omega_dot_e_radps2) && std::isfinite(m.omega_2dot_e_radps3);
}

/// Invariants after every period.
void judge(const drive_t &drive, const bridge_t &out, const drive_command_t &command)
{
    const bool moves =
        command.aim != nullptr && command.aim->position != nullptr && command.aim->position->moves;
    require(!moves || drive.state != DRIVE_RUN ||
            in_range(command.aim->position->motion, *drive.config));
    require(ratio(out.duty.a) && ratio(out.duty.b) && ratio(out.duty.c));
    require(out.gate_enable == (drive.state == DRIVE_RUN));
    require((drive.state == DRIVE_FAULT) == (drive.fault != DRIVE_FAULT_NONE));
    require(std::isfinite(drive.v_V.d) && std::isfinite(drive.v_V.q));
}

/// A rotor with currents, of which a sample is taken.
struct Rotor {
    float omega_e_radps = 0.0F;
    float theta_e_rad   = 0.0F;
    float i_A           = 0.0F;

    drive_sample_t sample(const drive_config_t &c)
    {
        theta_e_rad = std::remainder(theta_e_rad + omega_e_radps * c.ts_s, 6.2831853F);
        drive_sample_t s{};
        s.ia_A          = i_A * std::cos(theta_e_rad);
        s.ib_A          = i_A * std::cos(theta_e_rad - 2.0943951F);
        s.dc_link_V     = 0.5F * (c.dc_link_min_V + c.dc_link_max_V);
        s.theta_e_rad   = theta_e_rad;
        s.omega_e_radps = omega_e_radps;
        s.valid         = true;
        return s;
    }
};

/// Replaces one reading by any bits.
void spoil(fuzz::Bytes &in, int which, drive_sample_t &s, drive_command_t &command)
{
    float *const numbers[] = {&s.ia_A,          &s.ib_A,       &s.dc_link_V,
                              &s.theta_e_rad,   &s.band_rad,   &s.edge_gap_s,
                              &s.omega_e_radps, &s.edge_age_s, &command.omega_e_radps};
    if (which < 9) {
        *numbers[which] = in.number();
    } else if (which == 9) {
        s.valid = false;
    } else {
        s.edge_of_pattern = static_cast<std::int16_t>(in.word());
        s.edge_gap_s      = std::ldexp(1.0F, -static_cast<int>(in.octet() & 31U));
        s.edge_age_s      = std::ldexp(1.0F, -static_cast<int>(in.octet() & 31U));
    }
}

/// Any bits as a target, mostly plausible limits; where the shaft is said to be stays where it was.
position_command_t any_position(fuzz::Bytes &in)
{
    position_command_t p{};
    p.target.turns       = static_cast<std::int16_t>(in.word());
    p.target.theta_e_rad = 3.2F * in.share();
    p.profile = {1e3F * in.share(), 1e4F * in.share(), 1e4F * in.share(), 1e6F * in.share()};
    return p;
}

/// A motion as between the set-points of a master, mostly near the shaft and in range.
position_command_t any_motion(fuzz::Bytes &in, const drive_config_t &config)
{
    position_command_t p{};
    const bool         far = (in.octet() & 15U) == 0U;
    p.moves                = true;
    p.motion.at            = {far ? static_cast<std::int16_t>(in.word()) : 0, 3.2F * in.share()};
    p.motion.omega_e_radps = 1.05F * config.speed_max_e_radps * in.share();
    p.motion.omega_dot_e_radps2  = 1e5F * in.share();
    p.motion.omega_2dot_e_radps3 = far ? in.number() : 1e7F * in.share();
    return p;
}

/// Mostly in range.
torque_command_t any_torque(fuzz::Bytes &in, const drive_config_t &config)
{
    return {1.05F * TORQUE_SHARE_MAX * in.share(), 1.05F * config.speed_max_e_radps * in.share()};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Bytes           in(data, size);
    const drive_config_t &config = config_of(in.octet() % (tables.size() + names.size()));
    drive_t               drive{};
    drive_command_t       command{0.0F, true, 0.0F, nullptr};
    position_command_t    position{};
    torque_command_t      torque{};
    law_aim_t             aim{};
    Rotor                 rotor;
    require(drive_init(&drive, &config) == CTL_OK);
    while (in.any()) {
        const std::uint8_t what = in.octet();
        drive_sample_t     s    = rotor.sample(config);
        switch (what >> 6) {
        case 0: // the shaft and its currents change
            rotor.omega_e_radps += 20.0F * in.share();
            rotor.i_A = config.current_max_A * in.share();
            break;
        case 1:
            command = {config.speed_max_e_radps * in.share(), (what & 15U) != 0U, 0.0F, nullptr};
            if ((what & 32U) != 0U && config.positions) {
                position    = (what & 8U) != 0U ? any_motion(in, config) : any_position(in);
                aim         = {&position, nullptr};
                command.aim = &aim;
            } else if ((what & 16U) != 0U && config.torques) {
                torque      = any_torque(in, config);
                aim         = {nullptr, &torque};
                command.aim = &aim;
            }
            break;
        case 2:
            spoil(in, (what & 63) % 11, s, command);
            break;
        default:
            if (drive.state == DRIVE_FAULT) {
                drive_reset(&drive);
                command = {0.0F, true, 0.0F, nullptr};
                rotor   = Rotor();
            }
        }
        judge(drive, drive_tick(&drive, &s, &command), command);
        for (int n = what & 7; n > 0; n--) {
            s = rotor.sample(config);
            judge(drive, drive_tick(&drive, &s, &command), command);
        }
    }
    return 0;
}
