// SPDX-License-Identifier: MIT
/// The judgement as text and as JSON.
#pragma once

#include <string>

#include "sil/verify/judge.hpp"

namespace sdre {

std::string judgement_text(const Drive &drive, const Judgement &judgement);
std::string judgement_json(const Drive &drive, const Judgement &judgement);

} // namespace sdre
