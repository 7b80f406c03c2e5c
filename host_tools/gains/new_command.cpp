// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/child_process.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "drive/pwm_frequency.hpp"
#include "facts/cross_checks.hpp"
#include "facts/new_drive_text.hpp"
#include "gains/added_note.hpp"
#include "gains/commands.hpp"
#include "tune/added_section.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

struct Options {
    std::string              facts;
    std::string              out;
    std::string              name;
    std::string              board;
    std::vector<std::string> values;
    bool                     keys  = false;
    bool                     force = false;
};

void declare(OptionList &list, Options &o)
{
    list.text("--facts", o.facts, "what the data sheet says (TOML): one key a fact, see --keys");
    list.repeated("--set", o.values, "one more fact, KEY=VALUE");
    list.text("--name", o.name, "of the drive; without it the facts file's");
    list.text("--board", o.board, "name of its board file; without it the facts file's");
    list.text("--out", o.out, "drive file to write");
    list.flag("--keys", o.keys, "list what can be said, with its units");
    list.flag("--force", o.force, "write in spite of contradictions");
}

void add_value(Facts &facts, const std::string &text)
{
    const std::size_t at     = text.find('=');
    char             *end    = nullptr;
    const std::string number = at == std::string::npos ? "" : text.substr(at + 1);
    const double      value  = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0') {
        throw InputError(fmt::format("--set {}: must be KEY=NUMBER", text));
    }
    facts.facts.push_back(parse_fact("--set", text.substr(0, at), value));
}

Facts all_facts(const Options &o)
{
    Facts facts;
    if (!o.facts.empty()) {
        facts = parse_facts(o.facts, parse_toml_file(o.facts));
    } else {
        facts.source = "new";
    }
    for (const std::string &value : o.values) {
        add_value(facts, value);
    }
    return facts;
}

/// One line each; the first of the contradictions ends it, unless they are to be ignored.
void say(const Findings &findings, const Options &o)
{
    for (const std::string &note : findings.notes) {
        fmt::print(stderr, "note: {}\n", note);
    }
    if (findings.contradictions.empty()) {
        return;
    }
    for (const std::string &line : findings.contradictions) {
        fmt::print(stderr, "contradiction: {}\n", line);
    }
    if (!o.force) {
        throw InputError(fmt::format("{}: {} contradiction{}, nothing written (--force writes)",
                                     o.facts.empty() ? "new" : o.facts,
                                     findings.contradictions.size(),
                                     findings.contradictions.size() == 1 ? "" : "s"));
    }
}

/// With positions and torques, or with notes of what is in their way. Torques are certified beside the positions.
std::string with_further_sections(std::string text, const Drive &drive, const Options &o)
{
    const bool         ready = is_certified(drive);
    const AddedSection not_yet{"", "even the start weights of the speed are not certified; "
                                   "`sdre-gains tune` finds better ones, and these with them"};
    text += text_or_note("position", "positions",
                         ready ? position_section(drive, text, o.out) : not_yet, "no");
    if (takes_torque(drive)) {
        text += text_or_note("torque", "torques",
                             ready ? torque_section(drive, text, o.out) : not_yet, "no");
    }
    return text;
}

int run(const Options &o)
{
    if (o.keys) {
        fmt::print("{}poles, speeds and currents as data sheets write them; phase_ or "
                   "line_to_line_ and _rms or _peak say how a value is meant.\nregeneration "
                   "(\"none\", \"brake_chopper\", \"supply\"), edge_times (true), name, board\n",
                   quantity_names());
        return exit_ok;
    }
    if (o.out.empty() || (o.facts.empty() && o.values.empty())) {
        throw InputError("new: give --out DRIVE.toml and --facts FACTS.toml or --set KEY=VALUE");
    }
    const std::filesystem::path named = o.facts.empty() ? o.out : o.facts;
    const std::string           stem  = named.stem().string();
    Findings                    findings;
    Facts                       facts = all_facts(o);
    facts.name                        = o.name.empty() ? facts.name : o.name;
    facts.board                       = o.board.empty() ? facts.board : o.board;
    facts.drive_file                  = o.out;
    const Machine machine             = machine_of(facts, stem, findings);
    check_ratings(facts, machine, findings);
    check_machine(machine, findings);
    say(findings, o);
    std::string text  = new_drive_text(machine);
    const Drive drive = read_drive_text(text, facts.source, o.out); // whose ranges are the tools'
    text              = with_further_sections(text, drive, o);
    write_files({{o.out, text}});
    fmt::print("{}{}: written; `sdre-gains tune {} --out TUNED.toml` finds its weights\n",
               pwm_note(drive.inverter), o.out, shell_word(o.out));
    return exit_ok;
}

} // namespace

Command new_command()
{
    return command<Options>("new", "a drive file from what a data sheet says, cross-checked",
                            declare, run, "sdre-gains new --facts sheet.toml --out my_motor.toml");
}

} // namespace sdre
