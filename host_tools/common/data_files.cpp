// SPDX-License-Identifier: MIT
#include "common/data_files.hpp"

namespace sdre {

std::filesystem::path program_directory()
{
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
}

std::filesystem::path data_file(const std::string &path)
{
    std::error_code             none;
    const std::filesystem::path bin    = program_directory();
    std::filesystem::path       shared = bin.parent_path() / "share" / "sdre-drive" / path;
    if (!bin.empty() && std::filesystem::exists(shared, none)) {
        return shared;
    }
    return std::filesystem::path(SDRE_SOURCES) / path;
}

} // namespace sdre
