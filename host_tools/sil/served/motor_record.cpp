// SPDX-License-Identifier: MIT
#include "sil/served/motor_record.hpp"

namespace sdre {
namespace {

constexpr double sample_s = 1e-3;

} // namespace

void MotorRecord::note(const ServedDrive &drive)
{
    if (drive.time_s() < next_s_) {
        return;
    }
    const PlantState &now = drive.plant_state();
    next_s_               = drive.time_s() + sample_s - 1e-9;
    samples_.push_back({drive.time_s(), now.omega_e_radps, now.current_A.q, now.current_A.d,
                        now.torque_Nm, now.load_Nm, now.dc_link_V});
    while (samples_.size() > static_cast<std::size_t>(longest_record_s / sample_s)) {
        samples_.pop_front();
    }
}

} // namespace sdre
