// SPDX-License-Identifier: MIT
#include "sil/commands/image_program.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include <fmt/format.h>

#include "common/data_files.hpp"
#include "common/errors.hpp"

namespace sdre {
namespace {

/// As the environment variable says, or in the build tree of this program.
std::filesystem::path image_program()
{
    const char *const named = std::getenv("SDRE_ISS");
    return named != nullptr ? std::filesystem::path(named)
                            : (program_directory() / "../tests/sdre-iss").lexically_normal();
}

} // namespace

void declare_board(OptionList &list, BoardOption &board, const std::set<std::string> &names,
                   const std::string &help)
{
    list.choice("--board", board.name, names, help);
    list.text("--image", board.image,
              fmt::format("image (ELF) of --board {} (default: as its preset builds it)",
                          board_with_image));
    board.others = [list] { return list.given("--board"); };
}

void require_no_image(const BoardOption &board)
{
    if (!board.image.empty()) {
        throw InputError(fmt::format("--image: is for --board {} only", board_with_image));
    }
}

void run_image_program(const std::string &command, const std::vector<std::string> &arguments)
{
    const std::string program = image_program().string();
    if (!std::filesystem::exists(program)) {
        throw InputError(fmt::format(
            "--board {}: there is no {}, which runs the image; \"cmake --preset host-test && cmake "
            "--build --preset host-test --target sdre-iss\" builds it in the sources, SDRE_ISS "
            "names "
            "another one",
            board_with_image, program));
    }
    std::vector<std::string> all{program, command};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (std::string &text : all) {
        argv.push_back(text.data());
    }
    argv.push_back(nullptr);
    std::fflush(stdout);
    execv(program.c_str(), argv.data());
    throw InputError(fmt::format("--board {}: {} does not start: {}", board_with_image, program,
                                 std::strerror(errno)));
}

} // namespace sdre
