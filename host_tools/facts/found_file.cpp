// SPDX-License-Identifier: MIT
#include "facts/found_file.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "common/toml_reader.hpp"

namespace sdre {
namespace {

constexpr Range positive{1e-12, 1e9};
constexpr Range not_negative{0.0, 1e9};
constexpr Range any{-1e9, 1e9};
constexpr Range direction_range{-1, 1};
constexpr Range pairs_range{1, 64};        // as in a drive file
constexpr Range counts_range{4, 1000000};  // the same, of its lines
constexpr Range resonance_range{1.0, 2e3}; // the same, of [mechanics]
constexpr Range damping_range{1e-3, 0.5};
constexpr Range share_range{0.01, 0.99};

commission_value_t value(TomlReader &file, const char *key, const Range &range)
{
    TomlReader         t = file.table(key);
    commission_value_t v{};
    v.value = static_cast<float>(t.number("value", range));
    v.error = static_cast<float>(t.number("uncertainty", not_negative));
    t.reject_unknown_keys();
    return v;
}

/// Without the key nobody has searched for a resonance.
void read_coupling(TomlReader &t, commission_result_t &f)
{
    if (!t.has("coupling")) {
        return;
    }
    const std::string name = t.text("coupling");
    f.searched_Hz          = static_cast<float>(t.number("searched_Hz", not_negative));
    if (name == "elastic") {
        f.coupling     = COMMISSION_COUPLING_ELASTIC;
        f.resonance_Hz = value(t, "resonance_Hz", resonance_range);
        f.damping      = value(t, "damping", damping_range);
        f.load_share   = value(t, "load_inertia_share", share_range);
    } else if (name == "rigid") {
        f.coupling = COMMISSION_COUPLING_RIGID;
    } else if (name == "below") {
        f.coupling = COMMISSION_COUPLING_BELOW;
    } else if (name == "above") {
        f.coupling = COMMISSION_COUPLING_ABOVE;
    } else {
        t.fail("coupling", fmt::format("= \"{}\" is not allowed: must be \"rigid\", \"elastic\", "
                                       "\"below\" or \"above\"",
                                       name));
    }
}

FoundMap::Row read_row(TomlReader &t, const char *key)
{
    FoundMap::Row             row{};
    const std::vector<double> values = t.numbers(key, {row.size()}, positive);
    std::copy(values.begin(), values.end(), row.begin());
    return row;
}

FoundMap read_map(TomlReader &t)
{
    FoundMap m;
    m.step_A = t.number("step_A", positive);
    m.bias_A = t.number("bias_A", positive);
    m.ld_H   = {read_row(t, "ld_positive_id_H"), read_row(t, "ld_negative_id_H")};
    m.lq_H   = {read_row(t, "lq_beside_0_H"), read_row(t, "lq_beside_1_H"),
                read_row(t, "lq_beside_2_H")};
    t.reject_unknown_keys();
    return m;
}

} // namespace

Found read_found_file(const std::filesystem::path &file)
{
    const toml::table    table = parse_toml_file(file);
    TomlReader           t(file.string(), "", table);
    Found                found;
    commission_result_t &f = found.values;
    f.direction            = static_cast<std::int16_t>(t.integer("direction", direction_range));
    f.pole_pairs           = static_cast<std::int16_t>(t.integer("pole_pairs", pairs_range));
    f.counts_per_turn      = t.integer("counts_per_turn", counts_range);
    f.reluctance           = t.boolean_or("reluctance", false);
    if (f.direction == 0) {
        t.fail("direction", "= 0 is not allowed: must be 1 or -1");
    }
    f.r_Ohm        = value(t, "stator_resistance_Ohm", positive);
    f.v_loss_V     = value(t, "inverter_loss_V", any);
    f.ld_H         = value(t, "d_axis_inductance_H", positive);
    f.lq_H         = value(t, "q_axis_inductance_H", positive);
    f.flux_Wb      = value(t, "pm_flux_Wb", not_negative);
    f.inertia_kgm2 = value(t, "inertia_kgm2", positive);
    f.friction_Nms = value(t, "viscous_friction_Nms", any);
    f.coulomb_Nm   = value(t, "coulomb_friction_Nm", any);
    f.offset_rad   = value(t, "d_axis_angle_e_rad", any);
    read_coupling(t, f);
    if (auto inductances = t.table_if("inductances")) {
        found.map = read_map(*inductances);
    }
    t.reject_unknown_keys();
    return found;
}

} // namespace sdre
