// SPDX-License-Identifier: MIT
/// record_ticks LAW[=DRIVE] FILE SCENARIO...: runs the scenarios and writes every control period to FILE. The image that
/// replays them contains one law alone, so scenarios of another one are passed over. A drive file
/// of law noc replaces that of the scenarios with its form of the observer. One of another law replaces the speed form's.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "sil/eval/pi_foc.hpp"
#include "sil/run/recording.hpp"

extern "C" {
#include "tick_file.h"
}

namespace {

template <typename T> void put(std::ofstream &file, const T &value)
{
    file.write(reinterpret_cast<const char *>(&value), sizeof value);
}

std::uint32_t flag(bool set, std::uint32_t bit)
{
    return set ? bit : 0U;
}

tick_file_tick_t file_tick(const sdre::Recording &recording, std::size_t k, const bridge_t &pi)
{
    const drive_sample_t  &s   = recording.samples[k];
    const drive_command_t &c   = recording.commands[k];
    const bridge_t        &law = recording.outputs[k];

    tick_file_tick_t t{};
    t.drive           = tick_file_from_drive(&recording.drives[k]);
    t.position        = recording.positions[k];
    t.torque          = recording.torques[k];
    t.ia_A            = s.ia_A;
    t.ib_A            = s.ib_A;
    t.dc_link_V       = s.dc_link_V;
    t.theta_e_rad     = s.theta_e_rad;
    t.band_rad        = s.band_rad;
    t.edge_gap_s      = s.edge_gap_s;
    t.edge_age_s      = s.edge_age_s;
    t.omega_e_radps   = s.omega_e_radps;
    t.command_e_radps = c.omega_e_radps;
    t.derating        = c.derating;
    t.duty            = law.duty;
    t.pi_duty         = pi.duty;
    t.flags           = flag(s.valid, TICK_FILE_VALID) | flag(c.run, TICK_FILE_RUN) |
              flag(recording.aims[k].position != nullptr, TICK_FILE_POSITION) |
              flag(recording.aims[k].torque != nullptr, TICK_FILE_TORQUE) |
              flag(law.gate_enable, TICK_FILE_GATE) |
              static_cast<std::uint32_t>(s.edge_of_pattern) << TICK_FILE_EDGE_SHIFT;
    return t;
}

/// Fills in what only one law has; false: no image replays it.
bool put_constants(tick_file_run_t &run, const drive_config_t &c)
{
    if (const auto *noc = sdre::constants_of<law_noc_config_t>(c)) {
        run.law           = TICK_FILE_NOC;
        run.order         = std::max(noc->near_optimal.nosc.order, noc->nodo.order);
        run.constants.noc = *noc;
    } else if (const auto *speed = sdre::constants_of<law_noc_speed_config_t>(c)) {
        run.law                 = TICK_FILE_NOC_SPEED;
        run.order               = std::max(speed->near_optimal.nosc.order, speed->nodo.order);
        run.constants.noc_speed = *speed;
    } else if (const auto *harmonic = sdre::constants_of<law_noc_h_config_t>(c)) {
        run.law             = TICK_FILE_NOC_H;
        run.order           = harmonic->near_optimal.nosc.order;
        run.constants.noc_h = *harmonic;
    } else if (const auto *shaft = sdre::constants_of<law_noc_shaft_config_t>(c)) {
        run.law                 = TICK_FILE_NOC_SHAFT;
        run.order               = std::max(shaft->near_optimal.nosc.order, shaft->nodo.motor.order);
        run.constants.noc_shaft = *shaft;
    } else if (const auto *other = sdre::constants_of<law_conventional_config_t>(c)) {
        run.law                    = TICK_FILE_CONVENTIONAL;
        run.order                  = std::max(other->gains.nosc_order, other->gains.nodo_order);
        run.constants.conventional = *other;
    } else {
        return false;
    }
    return true;
}

/// Whether a drive runs a scenario that was made for another one: of the same form, or of the speed form with another law.
bool is_for(const sdre::Drive &drive, const sdre::Drive &own)
{
    const bool in_forms       = drive.law == sdre::Law::noc || drive.law == sdre::Law::noc_shaft;
    const sdre::NodoForm form = in_forms ? drive.nodo.form : sdre::NodoForm::speed;
    return own.law == sdre::Law::noc && own.nodo.form == form;
}

void write_run(std::ofstream &file, std::uint32_t law, const std::filesystem::path &drive,
               const std::filesystem::path &path)
{
    if (!drive.empty() &&
        !is_for(sdre::read_drive_file(drive), sdre::read_scenario_file(path).drive)) {
        return;
    }
    const sdre::Scenario   scenario   = sdre::read_scenario_file(path, drive);
    const sdre::Controller controller = sdre::prepare_controller(scenario);
    static tick_file_run_t run; // static: its padding is zero, so equal runs give equal files
    if (!put_constants(run, controller.config) || run.law != law) {
        return;
    }
    const sdre::Recording recording = sdre::record(scenario, controller);

    std::memset(run.name, 0, sizeof run.name);
    std::strncpy(run.name, path.stem().c_str(), TICK_FILE_NAME_SIZE - 1);
    run.layout    = TICK_FILE_LAYOUT;
    run.run_size  = sizeof run;
    run.tick_size = TICK_FILE_TICK_SIZE;
    run.ticks     = static_cast<std::uint32_t>(recording.samples.size());
    std::memcpy(run.config, &controller.config, sizeof run.config);
    run.pi = sdre::pi_foc_gains(scenario.drive);
    put(file, run);

    pi_foc_t pi{};
    pi_foc_init(&pi, &run.pi);
    for (std::size_t k = 0; k < recording.samples.size(); k++) {
        put(file, file_tick(recording, k,
                            pi_foc_tick(&pi, &recording.samples[k], &recording.commands[k])));
    }
}

/// The number of a law from its name on the command line.
std::uint32_t law_number(const std::string &name)
{
    constexpr const char *names[] = {"noc", "noc_speed", "noc_h", "conventional",
                                     "noc_shaft"}; // as tick_file_law_t counts
    const auto *const     found   = std::find(std::begin(names), std::end(names), name);
    if (found == std::end(names)) {
        throw std::runtime_error("no image replays the law " + name);
    }
    return static_cast<std::uint32_t>(found - std::begin(names));
}

} // namespace

int main(int argc, char **argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: record_ticks LAW[=DRIVE] FILE SCENARIO...\n");
        return 2;
    }
    const std::string   what  = argv[1];
    const std::size_t   sign  = std::min(what.find('='), what.size());
    const std::uint32_t law   = law_number(what.substr(0, sign));
    const std::string   drive = what.substr(std::min(sign + 1, what.size()));
    std::ofstream       file(argv[2], std::ios::binary);
    for (int i = 3; i < argc; i++) {
        write_run(file, law, drive, argv[i]);
    }
    const tick_file_run_t end{};
    put(file, end);
    if (!file.flush()) {
        throw std::runtime_error(std::string("cannot write ") + argv[2]);
    }
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "record_ticks: %s\n", error.what());
    return 1;
}
