// SPDX-License-Identifier: MIT
#include "sil/eval/plot.hpp"

#include <array>
#include <cstdlib>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"

namespace sdre {
namespace {

int run(const std::array<std::string, 5> &arguments)
{
    std::array<char *, 6> argv{};
    for (std::size_t i = 0; i < arguments.size(); i++) {
        argv[i] = const_cast<char *>(arguments[i].c_str()); // posix_spawn does not write to them
    }
    pid_t child  = 0;
    int   status = 0;
    if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0 ||
        waitpid(child, &status, 0) != child) {
        return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void plot(const char *script, const std::string &csv, const std::string &title,
          const std::filesystem::path &picture)
{
    const std::string python = SDRE_PYTHON;
    const std::string kind   = picture.extension().string();
    require_plot(picture);
    // Beside the target, so that a directory that cannot be written fails here, before anything is drawn.
    const std::filesystem::path data = picture.string() + ".csv.tmp";
    const std::filesystem::path part = picture.string() + ".tmp" + kind;
    write_files({{data, csv}});
    const int status = run(
        {python, std::string(SDRE_PLOT_SCRIPTS "/") + script, data.string(), title, part.string()});
    std::error_code error;
    std::filesystem::remove(data, error);
    if (status == 0) {
        std::filesystem::rename(part, picture, error);
    }
    if (status != 0 || error) {
        std::filesystem::remove(part, error);
        throw InputError(fmt::format("{}: cannot draw", picture.string()));
    }
}

} // namespace

void require_plot(const std::filesystem::path &picture)
{
    const std::string kind = picture.extension().string();
    if (kind != ".png" && kind != ".svg") {
        throw InputError(fmt::format("{}: a plot is a .png or a .svg", picture.string()));
    }
    if (std::string(SDRE_PYTHON).empty()) {
        throw InputError("--plot: this build found no Python with matplotlib");
    }
}

void plot_trace(const std::string &csv, const std::string &title,
                const std::filesystem::path &picture)
{
    plot("plot_trace.py", csv, title, picture);
}

void plot_spectrum(const std::string &csv, const std::string &title,
                   const std::filesystem::path &picture)
{
    plot("plot_spectrum.py", csv, title, picture);
}

} // namespace sdre
