// SPDX-License-Identifier: MIT
/// The records of a machine as whoever ran the programme wrote them.
#pragma once

#include <filesystem>

#include "sil/verify/rehearsal.hpp"

namespace sdre {

/// {"digest": .., "fault": null or text, "shots": [{"values": [4 x [samples]]}, ..]}. InputError in one line when it is
/// unreadable, of another drive file, incomplete or not finite.
Records read_records_file(const std::filesystem::path &file, const Drive &drive,
                          const Programme &programme);

} // namespace sdre
