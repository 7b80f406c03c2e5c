// SPDX-License-Identifier: MIT
#include "sil/run/controller.hpp"

#include "design/design.hpp"

extern "C" {
#include "gain_tables.h"
}

namespace sdre {

Drive believed_drive(const Scenario &s)
{
    Drive believed      = s.drive;
    believed.motor      = scaled(s.drive.motor, s.controller_scale);
    believed.nosc.order = s.nosc_order.value_or(believed.nosc.order);
    believed.nodo.order = s.nodo_order.value_or(believed.nodo.order);
    return believed;
}

Controller prepare_controller(const Scenario &s, Precision precision)
{
    const Drive believed = believed_drive(s);
    Controller  c;
    if (drive_digest(believed) == GAIN_TABLES_DIGEST) {
        c.config         = gain_tables_drive;
        c.compiled_table = true;
    } else {
        const Design design = design_drive(believed, precision);
        c.config            = design.config;
        c.constants         = design.constants;
        c.uncertified       = design.certificate.failures;
    }
    if (s.sensors.ideal && s.inverter.dead_time_s.value_or(0.0) <= 0.0) {
        c.config.dead_time.share = 0.0F; // an inverter without dead time has nothing to compensate
    }
    return c;
}

} // namespace sdre
