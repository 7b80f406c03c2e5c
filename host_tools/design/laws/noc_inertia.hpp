// SPDX-License-Identifier: MIT
/// The range of inertias that law noc may believe (EQ-CERT-10). The constants of EQ-INERTIA-8 are judged on a motor with
/// k times the inertia. The conditions are those of the drive's own constants, without the plane of speed and torque.
#pragma once

#include <string>

#include "design/laws/near_optimal.hpp"

namespace sdre {

/// The design of the same drive on a shaft with `ratio` times the inertia. `constants` are those of law_noc_believe(), and
/// outlive it. Its certificate is empty.
Design with_inertia(const Design &design, double ratio, law_noc_config_t &constants);

/// The outermost nodes up to which `holds`. 1 is not asked.
law_noc_inertia_t outermost(const std::function<bool(double ratio)> &holds);

/// EQ-CERT-10 of a certified design; `model_at` as for certify_whole().
template <typename ModelAt>
law_noc_inertia_t believable_inertia(const Design &design, const ModelAt &model_at)
{
    return outermost([&](double ratio) {
        law_noc_config_t c{};
        Design           d = with_inertia(design, ratio, c);
        certify(d);
        certify_whole(d, c.plausible, d.drive.nodo.T[2], c.near_optimal.current_ref, model_at);
        return d.certificate.passed();
    });
}

/// A line of the comment above the tables.
std::string inertia_line(const law_noc_inertia_t &range);

} // namespace sdre
