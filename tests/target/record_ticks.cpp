// SPDX-License-Identifier: MIT
/// record_ticks LAW FILE SCENARIO...: runs the scenarios and writes every control period to FILE. The image that replays
/// them contains one law alone, so scenarios of another one are passed over.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
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

tick_file_tick_t file_tick(const drive_t &d, const drive_sample_t &s, const drive_command_t &c,
                           const drive_output_t &law, const drive_output_t &pi)
{
    tick_file_tick_t t{};
    t.drive           = tick_file_from_drive(&d);
    t.ia_A            = s.ia_A;
    t.ib_A            = s.ib_A;
    t.dc_link_V       = s.dc_link_V;
    t.theta_e_rad     = s.theta_e_rad;
    t.omega_e_radps   = s.omega_e_radps;
    t.command_e_radps = c.omega_e_radps;
    t.duty            = law.duty;
    t.pi_duty         = pi.duty;
    t.flags           = flag(s.valid, TICK_FILE_VALID) | flag(c.run, TICK_FILE_RUN) |
              flag(law.gate_enable, TICK_FILE_GATE);
    return t;
}

int highest_order(const drive_config_t &c)
{
    const int observer = c.form == DRIVE_FORM_ENCODER ? c.nodo_encoder.order : c.nodo.order;
    return std::max<int>(c.nosc.order, observer);
}

void write_run(std::ofstream &file, const std::string &law, const std::filesystem::path &path)
{
    const sdre::Scenario   scenario   = sdre::read_scenario_file(path);
    const sdre::Controller controller = sdre::prepare_controller(scenario);
    if (law != sdre::law_name(scenario.drive.law)) {
        return;
    }
    const sdre::Recording recording = sdre::record(scenario, controller);

    static tick_file_run_t run; // static: its padding is zero, so equal runs give equal files
    std::strncpy(run.name, path.stem().c_str(), TICK_FILE_NAME_SIZE - 1);
    run.layout    = TICK_FILE_LAYOUT;
    run.run_size  = sizeof run;
    run.tick_size = TICK_FILE_TICK_SIZE;
    run.form      = static_cast<std::uint32_t>(controller.config.form);
    run.order     = static_cast<std::uint32_t>(highest_order(controller.config));
    run.ticks     = static_cast<std::uint32_t>(recording.samples.size());
    run.harmonic  = controller.config.law == DRIVE_LAW_NOC_H ? 1U : 0U;
    run.table     = run.harmonic != 0U ? *controller.config.nodo_harmonic : nodo_harmonic_gains_t{};
    std::memcpy(run.config, &controller.config, sizeof run.config);
    run.pi = sdre::pi_foc_gains(scenario.drive);
    put(file, run);

    pi_foc_t pi{};
    pi_foc_init(&pi, &run.pi);
    for (std::size_t k = 0; k < recording.samples.size(); k++) {
        const drive_sample_t  &sample  = recording.samples[k];
        const drive_command_t &command = recording.commands[k];
        put(file, file_tick(recording.drives[k], sample, command, recording.outputs[k],
                            pi_foc_tick(&pi, &sample, &command)));
    }
}

} // namespace

int main(int argc, char **argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: record_ticks LAW FILE SCENARIO...\n");
        return 2;
    }
    std::ofstream file(argv[2], std::ios::binary);
    for (int i = 3; i < argc; i++) {
        write_run(file, argv[1], argv[i]);
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
