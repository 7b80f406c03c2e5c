// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/board/identity.hpp"
#include "design/certificate.hpp"
#include "design/design.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "emit/emit_image.hpp"
#include "gains/commands.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string out;
    std::string hex;
    std::string list;
    std::string disc_map;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--out", o.out, "image to write, for sdre-drive load");
    list.text("--hex", o.hex, "the same as Intel HEX, for a programming tool");
    list.text("--disc-map", o.disc_map, "map of the encoder disc, of sdre-drive disc-map learn");
    list.text("--list", o.list, "its numbers as text: word, name, value");
}

int run(const Options &o)
{
    if (o.out.empty() && o.hex.empty() && o.list.empty()) {
        throw InputError("image: give --out FILE, --hex FILE or --list FILE");
    }
    const Drive drive = read_drive_file(o.drive);
    require_board(drive, o.drive);
    const Design design = design_drive(drive, Precision::extended);
    if (!design.certificate.passed()) {
        throw DesignError(fmt::format("{}: {}: {}", o.drive, verdict_words(design),
                                      fmt::join(design.certificate.failures, "; ")));
    }
    std::vector<std::uint16_t> words = image_words(design);
    if (!o.disc_map.empty()) {
        const std::vector<std::uint16_t> map = read_disc_map(o.disc_map, drive);
        words.insert(words.end(), map.begin(), map.end());
    }
    std::vector<OutputFile> files;
    if (!o.out.empty()) {
        files.push_back({o.out, image_octets(words)});
    }
    if (!o.hex.empty()) {
        files.push_back({o.hex, image_hex(words, processor_of(drive))});
    }
    if (!o.list.empty()) {
        files.push_back({o.list, image_list(design)});
    }
    write_files(files);
    fmt::print("{}{}", pwm_note(design.drive.inverter), cycles_note(design.drive));
    for (const OutputFile &file : files) {
        fmt::print("{}: certified; wrote {} words for {} to {}\n", design.drive.name, words.size(),
                   law_design(design.drive).name, file.path.string());
    }
    return exit_ok;
}

} // namespace

Command image_command()
{
    return command<Options>("image",
                            "write a drive's constants as an image that a firmware loads without a "
                            "compiler",
                            declare, run, "sdre-gains image my_motor.toml --out my_motor.img");
}

} // namespace sdre
