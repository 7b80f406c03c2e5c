// SPDX-License-Identifier: MIT
#include "common/data_files.hpp"

namespace sdre {

std::filesystem::path data_file(const std::string &path)
{
    std::error_code             none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    std::filesystem::path       shared =
        program.parent_path().parent_path() / "share" / "sdre-drive" / path;
    if (!program.empty() && std::filesystem::exists(shared, none)) {
        return shared;
    }
    return std::filesystem::path(SDRE_SOURCES) / path;
}

} // namespace sdre
