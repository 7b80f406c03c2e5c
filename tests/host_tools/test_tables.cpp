// SPDX-License-Identifier: MIT
#include "emit/emit_tables.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "shipped_drive.hpp"

extern "C" {
#include "gain_tables.h"
#include "harmonic_tables.h"
}

namespace {

using support::TempDir;

const std::filesystem::path committed = std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config";

const sdre::Design &encoder_form()
{
    static const sdre::Design design = sdre::design_drive(
        sdre::read_drive_file(support::shipped_drive("ipmsm_390w")), sdre::Precision::extended);
    return design;
}

const sdre::Design &speed_form()
{
    static const sdre::Design design =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_speed")));
    return design;
}

std::string without_comments(const std::string &text)
{
    return std::regex_replace(text, std::regex(R"(/\*[^*]*\*+([^/*][^*]*\*+)*/)"), " ");
}

/// Every floating-point literal of the code, in order.
std::vector<double> literals(const std::string &text)
{
    const std::string   code = without_comments(text);
    const std::regex    pattern(R"(-?\d\.\d+e[+-]\d+f)");
    std::vector<double> values;
    for (auto it = std::sregex_iterator(code.begin(), code.end(), pattern);
         it != std::sregex_iterator(); ++it) {
        values.push_back(std::stod(it->str()));
    }
    return values;
}

template <std::size_t Rows>
void add_observer(std::vector<float> &v, const std::vector<float> &ranges, int order,
                  const float (&gain)[NODO_ORDER_MAX + 1][Rows][3])
{
    v.insert(v.end(), ranges.begin(), ranges.end());
    for (int n = 0; n <= order; n++) {
        for (const auto &row : gain[n]) {
            v.insert(v.end(), std::begin(row), std::end(row));
        }
    }
}

/// Gains with their limits.
void add_nosc(std::vector<float> &v, const nosc_gains_t &g)
{
    v.insert(v.end(),
             {g.iq_error_max_A, g.iq_speed_max_A, g.speed_A_per_radps, g.speed_radps_per_A});
    for (int n = 0; n <= g.order; n++) {
        for (const auto &row : g.lambda[n]) {
            v.insert(v.end(), std::begin(row), std::end(row));
        }
    }
}

/// Common part of the near optimal laws.
void add_near_optimal(std::vector<float> &v, const near_optimal_config_t &c)
{
    const current_ref_config_t &r = c.current_ref;
    v.insert(v.end(), {r.current_max_A, r.iq_max_A, r.mtpa_A, r.mtpa_half_1pA, r.circle_ApVs,
                       r.torque_share, r.near_e_radps, r.id_rest_A, r.flux_A, r.l1_min,
                       r.mtpa_per_period, r.weakening_per_period, r.chord_from, r.chord_slope,
                       r.samples_1ps, r.regen_max_W_norm, r.regen_start_V, r.regen_per_V});
    add_nosc(v, c.nosc);
    if (c.position.near_rad > 0.0F) {
        const position_gains_t &p = c.position;
        add_nosc(v, p.nosc);
        v.insert(v.end(), p.theta, p.theta + p.nosc.order + 1);
        v.insert(v.end(), {p.speed_per_rad, p.near_rad, p.most.speed_e_radps, p.most.accel_e_radps2,
                           p.most.decel_e_radps2, p.most.jerk_e_radps3});
    }
}

void add_limits(std::vector<float> &v, const encoder_form_limits_t &limits)
{
    v.insert(v.end(), {limits.angle_rad, limits.d_omega});
}

void add_gains(std::vector<float> &v, const encoder_form_gains_t &gains)
{
    v.insert(v.end(), {gains.theta, gains.omega_1ps, gains.d_omega_1ps2, gains.count_rad});
}

void add_gate(std::vector<float> &v, const angle_gate_config_t &gate)
{
    v.insert(v.end(), {gate.gate_rad, gate.step_rad, gate.count_rad, gate.slow_e_radps2});
}

void add_currents(std::vector<float> &v, const nodo_current_gains_t &g)
{
    v.insert(v.end(), {g.from_e_radps, g.root, g.nodes_per_root});
    for (const auto &node : g.gain) {
        for (const auto &row : node) {
            v.insert(v.end(), std::begin(row), std::end(row));
        }
    }
}

/// The numbers of the table of noc_h in the order of the structure.
std::vector<float> values_of(const nodo_harmonic_gains_t &g)
{
    std::vector<float> v{g.iq_max_A, g.nodes_per_root, g.keep, g.keep_fast};
    for (int i = 0; i < g.n_pairs; i++) {
        v.push_back(g.pair[i].order);
    }
    for (int row = 0; row < NODO_HARMONIC_N_BASE + 2 * g.n_pairs; row++) {
        for (int node = 0; node < g.n_nodes; node++) {
            v.insert(v.end(), std::begin(g.gain[row][node]), std::end(g.gain[row][node]));
        }
    }
    return v;
}

/// The numbers of the law's constants in the order of the structure.
std::vector<float> constants_in(const drive_config_t &c)
{
    std::vector<float> v;
    if (const auto *noc = sdre::constants_of<law_noc_config_t>(c)) {
        add_near_optimal(v, noc->near_optimal);
        add_limits(v, noc->plausible);
        add_gate(v, noc->gate);
        add_gains(v, noc->rare);
        add_observer(v, {noc->nodo.iq_max_A}, noc->nodo.order, noc->nodo.gain);
        add_currents(v, noc->currents);
        v.insert(v.end(), {noc->inertia.least, noc->inertia.most});
        v.insert(v.end(), {noc->torque.iq_VpA, noc->torque.id_VpA, noc->torque.id_max_A});
    } else if (const auto *speed = sdre::constants_of<law_noc_speed_config_t>(c)) {
        add_near_optimal(v, speed->near_optimal);
        add_observer(v, {speed->nodo.iq_max_A, speed->nodo.iq_certified_A}, speed->nodo.order,
                     speed->nodo.gain);
    } else {
        const auto &noc_h = *sdre::constants_of<law_noc_h_config_t>(c);
        add_near_optimal(v, noc_h.near_optimal);
        add_limits(v, noc_h.plausible);
        add_gate(v, noc_h.gate);
        add_gains(v, noc_h.rare);
        const std::vector<float> nodo = values_of(noc_h.nodo);
        v.insert(v.end(), nodo.begin(), nodo.end());
    }
    return v;
}

/// The numbers of a configuration in the order of a table: those of its law come first.
std::vector<float> values_of(const drive_config_t &c)
{
    const motor_reduced_t &m = c.motor;
    std::vector<float>     v = constants_in(c);
    v.insert(v.end(), {c.ts_s, c.current_max_A, c.trip_current_A, c.trip_speed_e_radps,
                       c.speed_max_e_radps, c.dc_link_min_V, c.dc_link_max_V});
    v.insert(v.end(), {m.l1, m.l2, m.l3, m.l4, m.l5, m.l6, m.l7, m.l8, m.l9, m.l10, m.l11, m.inv_l6,
                       m.inv_l8});
    v.insert(v.end(), {c.dead_time.share, c.dead_time.inv_fade_1pA, c.rated_current_A,
                       c.rated_torque_Nm, c.hardware.dead_time_s});
    return v;
}

/// Every shipped drive of noc_h, designed once.
const std::vector<sdre::Design> &harmonic_designs()
{
    static const std::vector<sdre::Design> designs = [] {
        std::vector<sdre::Design> out;
        for (const auto &entry : std::filesystem::directory_iterator(committed / "drives")) {
            if (entry.path().string().find("noc_h") != std::string::npos) {
                out.push_back(sdre::design_drive(sdre::read_drive_file(entry.path())));
            }
        }
        return out;
    }();
    return designs;
}

bool contains(const std::string &text, const std::string &piece)
{
    return text.find(piece) != std::string::npos;
}

/// The difference found after changing one place of a directory that matched.
std::string difference_after(const std::string &file, const std::string &from,
                             const std::string &to)
{
    const TempDir         dir;
    const sdre::TableText text = sdre::table_text(speed_form());
    sdre::write_tables(text, dir.path());
    dir.write(file, support::replaced(support::read_file(dir / file), from, to));
    return sdre::compare_tables(text, dir.path());
}

} // namespace

TEST(Tables, CommittedTablesAreThoseOfTheShippedDrive)
{
    constexpr double      tolerance = 1e-6; // compilers differ in the last digits
    const sdre::TableText text      = sdre::table_text(encoder_form());
    const std::string     source    = support::read_file(committed / "gain_tables.c");
    const auto            expected  = literals(text.source);
    const auto            found     = literals(source);

    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); i++) {
        EXPECT_NEAR(found[i], expected[i], tolerance * std::abs(expected[i])) << i;
    }
    EXPECT_EQ(sdre::compare_tables(text, committed), "");
    EXPECT_EQ(without_comments(support::read_file(committed / "gain_tables.h")),
              without_comments(text.header));
}

TEST(Tables, CompiledTableIsTheDesign)
{
    const std::vector<float> compiled = values_of(gain_tables_drive);
    const std::vector<float> design   = values_of(encoder_form().config);

    const auto *table  = sdre::constants_of<law_noc_config_t>(gain_tables_drive);
    const auto *solved = sdre::constants_of<law_noc_config_t>(encoder_form().config);
    ASSERT_TRUE(table != nullptr && solved != nullptr);
    EXPECT_EQ(table->near_optimal.nosc.order, solved->near_optimal.nosc.order);
    EXPECT_EQ(table->nodo.order, solved->nodo.order);
    ASSERT_EQ(compiled.size(), design.size());
    for (std::size_t i = 0; i < compiled.size(); i++) {
        const auto expected = static_cast<double>(design[i]);
        EXPECT_NEAR(static_cast<double>(compiled[i]), expected, 1e-6 * std::abs(expected)) << i;
    }
    EXPECT_STREQ(GAIN_TABLES_NAME, "ipmsm_390w");
    EXPECT_EQ(GAIN_TABLES_DIGEST, sdre::drive_digest(encoder_form().drive));
}

TEST(Tables, TextHoldsEveryNumberBitForBit)
{
    const std::vector<float>  design = values_of(speed_form().config);
    const std::vector<double> text   = literals(sdre::table_text(speed_form()).source);

    ASSERT_EQ(text.size(), design.size());
    for (std::size_t i = 0; i < text.size(); i++) {
        EXPECT_EQ(static_cast<float>(text[i]), design[i]) << i;
    }
}

TEST(Tables, SameInputSameBytes)
{
    const sdre::TableText first  = sdre::table_text(speed_form());
    const sdre::TableText second = sdre::table_text(sdre::design_drive(speed_form().drive));

    EXPECT_EQ(first.header, second.header);
    EXPECT_EQ(first.source, second.source);
}

TEST(Tables, TextCarriesDigestButNoTimePathOrUser)
{
    const sdre::TableText text   = sdre::table_text(speed_form());
    const std::string     digest = sdre::drive_digest(speed_form().drive);
    char                  host[256]{};
    ASSERT_EQ(gethostname(host, sizeof host - 1), 0);

    for (const std::string &file : {text.header, text.source}) {
        EXPECT_TRUE(contains(file, digest));
        EXPECT_TRUE(contains(file, "sdre-gains 1.0.0"));
        EXPECT_FALSE(contains(file, SDRE_SOURCE_DIR));
        EXPECT_FALSE(contains(file, ".toml"));
        EXPECT_FALSE(contains(file, host));
        EXPECT_FALSE(std::regex_search(file, std::regex(R"(\b20\d\d\b|\d\d:\d\d)")));
        EXPECT_TRUE(file.rfind("/* SPDX-License-Identifier: MIT */\n", 0) == 0U);
    }
    EXPECT_TRUE(contains(text.header, "#define GAIN_TABLES_DIGEST \"" + digest + "\""));
    EXPECT_TRUE(contains(text.header, "#define GAIN_TABLES_NAME   \"ipmsm_390w_speed\""));
    EXPECT_TRUE(contains(text.header, "#define GAIN_TABLES_SCHEMA 1"));
    EXPECT_TRUE(contains(text.source, "GAIN_TABLES_SCHEMA != 1"));
    EXPECT_TRUE(contains(text.source, "NOSC_ORDER_MAX < 2"));
    EXPECT_TRUE(contains(text.source, "NODO_ORDER_MAX < 2"));
}

TEST(Tables, HeaderSaysWhatWasChecked)
{
    const std::string header = sdre::table_text(speed_form()).header;

    for (const char *piece :
         {"N = 2", "Nd = 2", "relative residuals <= 1e-", "controller: slowest pole -827 1/s",
          "spectral radius 0.842, |e_iq| <= 8 A", "observer:   slowest pole -204 1/s",
          "spectral radius 0.959, |iq| <= 8 A"}) {
        EXPECT_TRUE(contains(header, piece)) << piece;
    }
}

TEST(Tables, OrdersOtherThanTwoAreWrittenInFull)
{
    sdre::Drive drive            = speed_form().drive;
    drive.nosc.order             = 0;
    drive.nodo.order             = 3;
    const sdre::Design    design = sdre::design_drive(drive);
    const sdre::TableText text   = sdre::table_text(design);

    EXPECT_EQ(literals(text.source).size(), values_of(design.config).size());
    EXPECT_TRUE(contains(text.source, "NOSC_ORDER_MAX < 0"));
    EXPECT_TRUE(contains(text.source, "NODO_ORDER_MAX < 3"));
    EXPECT_TRUE(contains(text.source, "{ /* n = 3 */"));
}

TEST(Tables, WriteMakesTheDirectoryAndLeavesNothingElse)
{
    const TempDir         dir;
    const sdre::TableText text{"header\n", "source\n", "board\n"};

    sdre::write_tables(text, dir / "new" / "deep");

    EXPECT_EQ(support::names_in(dir / "new" / "deep"),
              (std::set<std::string>{"board_config.c", "gain_tables.c", "gain_tables.h"}));
    EXPECT_EQ(support::read_file(dir / "new" / "deep" / "board_config.c"), "board\n");
    EXPECT_EQ(support::read_file(dir / "new" / "deep" / "gain_tables.h"), "header\n");
    EXPECT_EQ(support::read_file(dir / "new" / "deep" / "gain_tables.c"), "source\n");
}

TEST(Tables, WriteReplacesBoth)
{
    const TempDir dir;
    sdre::write_tables({"a long first header\n", "a long first source\n", "a board\n"}, dir.path());

    sdre::write_tables({"h\n", "s\n", "b\n"}, dir.path());

    EXPECT_EQ(support::read_file(dir / "gain_tables.h"), "h\n");
    EXPECT_EQ(support::read_file(dir / "gain_tables.c"), "s\n");
    EXPECT_EQ(support::read_file(dir / "board_config.c"), "b\n");
}

TEST(Tables, FailedWriteLeavesBothEarlierFiles)
{
    const TempDir dir;
    dir.write("gain_tables.h", "earlier\n");
    std::filesystem::create_directory(dir / "gain_tables.c"); // cannot be replaced by a file

    EXPECT_THROW(sdre::write_tables({"h\n", "s\n", "b\n"}, dir.path()), sdre::InputError);

    EXPECT_EQ(support::read_file(dir / "gain_tables.h"), "earlier\n");
    EXPECT_EQ(support::names_in(dir.path()),
              (std::set<std::string>{"gain_tables.c", "gain_tables.h"}));
}

TEST(Tables, WriteWhereNoDirectoryCanBeIsAnInputError)
{
    const TempDir dir;
    dir.write("file", "");

    EXPECT_THROW(sdre::write_tables({"h", "s", "b"}, dir / "file" / "sub"), sdre::InputError);
    EXPECT_THROW(sdre::write_tables({"h", "s", "b"}, dir / "file"), sdre::InputError);
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"file"}));
}

TEST(Tables, CompareAcceptsRoundingAndLayout)
{
    EXPECT_EQ(difference_after("gain_tables.c", "4.45124016e+01f", "4.45124060e+01f"), ""); // 1e-7
    EXPECT_EQ(difference_after("gain_tables.c", "-1.12239637e+01f", "-1.12239626e+01f"), "");
    EXPECT_EQ(difference_after("gain_tables.c", "    .ts_s = ", "\n\n  .ts_s  = "), "");
    EXPECT_EQ(difference_after("gain_tables.h", "checked    ", "checked by "), "");
    EXPECT_EQ(difference_after("gain_tables.c", "0.00000000e+00f", "1.00000000e-13f"), "");
}

TEST(Tables, CompareSeesAChangedNumber)
{
    const std::string number =
        difference_after("gain_tables.c", "4.45124016e+01f", "4.45125000e+01f"); // 2e-6
    const std::string sign =
        difference_after("gain_tables.c", "-1.12239637e+01f", "1.12239637e+01f");

    EXPECT_TRUE(contains(number, "gain_tables.c: '4.45125000e+01f' where"));
    EXPECT_TRUE(contains(number, "'4.45124016e+01f'"));
    EXPECT_NE(sign, "");
    EXPECT_NE(difference_after("gain_tables.c", "0.00000000e+00f", "1.00000000e-11f"), "");
    EXPECT_NE(difference_after("gain_tables.c", "4.45124016e+01f", "4.45124016e+01"), "x");
    EXPECT_NE(difference_after("gain_tables.c", "4.45124016e+01f", "nan"), "");
    EXPECT_NE(difference_after("gain_tables.c", "4.45124016e+01f", "44"), "");
}

TEST(Tables, CompareSeesEverythingElseExactly)
{
    const std::string right = sdre::drive_digest(speed_form().drive) + "\"";
    const std::string digest =
        difference_after("gain_tables.h", right, "fnv1a64:0000000000000000\"");

    EXPECT_TRUE(contains(digest, "gain_tables.h: "));
    EXPECT_EQ(digest.find('\n'), std::string::npos);
    EXPECT_NE(difference_after("gain_tables.h", "SCHEMA 1", "SCHEMA 2"), "");
    EXPECT_NE(difference_after("gain_tables.h", "\"ipmsm_390w_speed\"", "\"ipmsm_391w\""), "");
    EXPECT_NE(difference_after("gain_tables.c", ".order = 2", ".order = 3"), "");
    EXPECT_NE(difference_after("gain_tables.c", ".l1 = ", ".l2 = "), "");
    EXPECT_NE(difference_after("gain_tables.c", "    .l2", "    .extra = 1.0e+00f,\n    .l2"), "");
    EXPECT_NE(difference_after("gain_tables.c", "};\n", "};\nint more;\n"), "");
    EXPECT_NE(difference_after("gain_tables.c", "const drive_config_t", "/* const drive_config_t"),
              "");
}

TEST(Tables, CompareSeesATruncatedFile)
{
    const TempDir         dir;
    const sdre::TableText text = sdre::table_text(speed_form());
    sdre::write_tables(text, dir.path());

    dir.write("gain_tables.c", text.source.substr(0, text.source.size() - 4));
    const std::string cut = sdre::compare_tables(text, dir.path());
    dir.write("gain_tables.c", "");
    const std::string empty = sdre::compare_tables(text, dir.path());

    EXPECT_TRUE(contains(cut, "gain_tables.c: ")) << cut;
    EXPECT_TRUE(contains(empty, "gain_tables.c: length differs")) << empty;
}

TEST(Tables, CompareWithoutAFileIsAnInputError)
{
    const TempDir         dir;
    const sdre::TableText text = sdre::table_text(speed_form());
    EXPECT_THROW(sdre::compare_tables(text, dir.path()), sdre::InputError);
    EXPECT_THROW(sdre::compare_tables(text, dir / "none"), sdre::InputError);

    dir.write("gain_tables.h", text.header);
    EXPECT_THROW(sdre::compare_tables(text, dir.path()), sdre::InputError);
    std::filesystem::create_directory(dir / "gain_tables.c");
    EXPECT_THROW(sdre::compare_tables(text, dir.path()), sdre::InputError); // nothing to read there
}

TEST(Tables, EncoderFormIsWrittenBitForBit)
{
    const drive_config_t     &config = encoder_form().config;
    const sdre::TableText     text   = sdre::table_text(encoder_form());
    const std::vector<float>  design = values_of(config);
    const std::vector<double> found  = literals(text.source);

    ASSERT_EQ(config.law, &law_noc);
    ASSERT_EQ(found.size(), design.size());
    for (std::size_t i = 0; i < found.size(); i++) {
        EXPECT_EQ(static_cast<float>(found[i]), design[i]) << i;
    }
    EXPECT_TRUE(contains(text.source, ".law = &law_noc,"));
    EXPECT_TRUE(contains(text.source, ".overmodulation = true,"));
    EXPECT_TRUE(contains(text.source, "static const law_noc_config_t constants = {"));
    EXPECT_TRUE(contains(text.source, "#include \"law_noc.h\""));
    EXPECT_FALSE(contains(text.source, "law_noc_speed"));
    EXPECT_TRUE(contains(text.source, "/* theta */"));
    EXPECT_TRUE(contains(sdre::table_text(speed_form()).source, ".law = &law_noc_speed,"));
    EXPECT_TRUE(contains(sdre::table_text(speed_form()).source, ".overmodulation = false,"));
}

TEST(Tables, EncoderFormIsWhatItsSeriesSays)
{
    const sdre::Design         &d = encoder_form();
    const nodo_encoder_gains_t &g = sdre::constants_of<law_noc_config_t>(d.config)->nodo;

    ASSERT_EQ(static_cast<std::size_t>(g.order) + 1, d.nodo.gain.size());
    for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
        ASSERT_EQ(d.nodo.gain[n].rows(), 7);
        ASSERT_EQ(d.nodo.gain[n].cols(), 3);
        for (int i = 0; i < 7; i++) {
            for (int j = 0; j < 3; j++) {
                const double x = d.nodo.gain[n](i, j); // rounding noise is stored as zero
                EXPECT_NEAR(static_cast<double>(g.gain[n][i][j]), x,
                            1.2e-7 * std::abs(x) + 1e-12 * d.nodo.gain[n].norm());
            }
        }
    }
}

TEST(Tables, EncoderFormMatchesItselfAndSeesAChange)
{
    const TempDir         dir;
    const sdre::TableText text = sdre::table_text(encoder_form());
    sdre::write_tables(text, dir.path());

    EXPECT_EQ(sdre::compare_tables(text, dir.path()), "");
    EXPECT_NE(sdre::compare_tables(sdre::table_text(speed_form()), dir.path()), "");
    dir.write("gain_tables.c", support::replaced(text.source, "&law_noc,", "&law_pid,"));
    EXPECT_TRUE(contains(sdre::compare_tables(text, dir.path()), "gain_tables.c: "));
}

TEST(Tables, GenerateAndCheckInTheEncoderForm)
{
    const TempDir     dir;
    const std::string drive = support::shipped_drive("ipmsm_390w").string();
    const std::string out   = (dir / "tables").string();

    const auto written = support::run_command({SDRE_GAINS_EXE, "generate", drive, "--out", out});
    const auto checked = support::run_command({SDRE_GAINS_EXE, "generate", drive, "--check", out});
    const auto other =
        support::run_command({SDRE_GAINS_EXE, "generate",
                              support::shipped_drive("ipmsm_390w_noc_h").string(), "--check", out});

    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    support::expect_refused(other, 3, "sdre-gains");
}

TEST(Tables, AllFormsAreC99)
{
    const std::string compiler = "/usr/bin/cc";
    if (!std::filesystem::exists(compiler)) {
        GTEST_SKIP() << "no C compiler at " << compiler;
    }
    std::vector<const sdre::Design *> designs{&speed_form(), &encoder_form()};
    for (const sdre::Design &design : harmonic_designs()) {
        designs.push_back(&design);
    }
    sdre::Drive none                    = harmonic_designs().at(0).drive;
    none.harmonics                      = {};
    none.harmonics.weight_speed_e_radps = 300.0;
    const sdre::Design no_pairs         = sdre::design_drive(none);
    designs.push_back(&no_pairs);
    for (const sdre::Design *design : designs) {
        const TempDir dir;
        sdre::write_tables(sdre::table_text(*design), dir.path());
        const auto result = support::run_command({compiler,
                                                  "-std=c99",
                                                  "-Wall",
                                                  "-Wextra",
                                                  "-Wpedantic",
                                                  "-Werror",
                                                  "-fsyntax-only",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/base",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/observe",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/reference",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/laws",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/watch",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/modulate",
                                                  "-I",
                                                  SDRE_SOURCE_DIR "/firmware/control/fields",
                                                  (dir / "gain_tables.c").string()});
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }
}

TEST(Tables, HarmonicsAreWrittenBitForBit)
{
    ASSERT_GE(harmonic_designs().size(), 2U);
    for (const sdre::Design &design : harmonic_designs()) {
        const sdre::TableText     text   = sdre::table_text(design);
        const std::vector<float>  values = values_of(design.config);
        const auto               *noc_h  = sdre::constants_of<law_noc_h_config_t>(design.config);
        const std::vector<double> found  = literals(text.source);

        ASSERT_TRUE(noc_h != nullptr);
        ASSERT_EQ(found.size(), values.size());
        for (std::size_t i = 0; i < found.size(); i++) {
            EXPECT_EQ(static_cast<float>(found[i]), values[i]) << design.drive.name << " " << i;
        }
        EXPECT_TRUE(contains(text.source, ".law = &law_noc_h,"));
        EXPECT_TRUE(contains(text.source, "#include \"law_noc_h.h\""));
        EXPECT_TRUE(contains(text.source, ".constants = &constants,"));
        EXPECT_TRUE(contains(text.source, "NODO_HARMONIC_N_BASE != 8"));
        EXPECT_TRUE(contains(text.source,
                             fmt::format("NODO_HARMONIC_PAIRS_MAX < {})", noc_h->nodo.n_pairs)));
        EXPECT_LT(text.source.find("law_noc_h_config_t constants = {"),
                  text.source.find("gain_tables_drive = {"));
        EXPECT_TRUE(contains(text.header, "EQ-HARMONIC-3 with"));
        EXPECT_TRUE(contains(text.header, fmt::format("sampled spectral radius {:.5f} at",
                                                      design.harmonic_check.spectral_radius)));
    }
}

TEST(Tables, CompiledHarmonicTableIsTheDesign)
{
    const auto design =
        std::find_if(harmonic_designs().begin(), harmonic_designs().end(),
                     [](const sdre::Design &d) { return d.drive.name == "ipmsm_390w_noc_h"; });
    ASSERT_NE(design, harmonic_designs().end());
    const auto *table  = sdre::constants_of<law_noc_h_config_t>(harmonic_tables_drive);
    const auto *solved = sdre::constants_of<law_noc_h_config_t>(design->config);

    ASSERT_TRUE(table != nullptr && solved != nullptr);
    EXPECT_EQ(table->nodo.n_pairs, solved->nodo.n_pairs);
    EXPECT_EQ(table->nodo.n_nodes, solved->nodo.n_nodes);
    for (int i = 0; i < table->nodo.n_pairs; i++) {
        EXPECT_EQ(table->nodo.pair[i].channel, solved->nodo.pair[i].channel);
    }
    EXPECT_EQ(values_of(table->nodo), values_of(solved->nodo));
    EXPECT_EQ(values_of(harmonic_tables_drive), values_of(design->config));
}

TEST(Tables, GenerateAndCheckWithHarmonics)
{
    for (const sdre::Design &design : harmonic_designs()) {
        const TempDir     dir;
        const std::string drive = support::shipped_drive(design.drive.name).string();
        const std::string out   = (dir / "tables").string();

        const auto written =
            support::run_command({SDRE_GAINS_EXE, "generate", drive, "--out", out});
        const auto checked =
            support::run_command({SDRE_GAINS_EXE, "generate", drive, "--check", out});
        EXPECT_EQ(written.exit_code, 0) << written.err;
        EXPECT_EQ(checked.exit_code, 0) << checked.err;

        const std::string source = support::read_file(dir / "tables/gain_tables.c");
        dir.write("tables/gain_tables.c",
                  support::replaced(source, "_SENSOR, .order = -1.00", "_SENSOR, .order = -1.01"));
        support::expect_refused(
            support::run_command({SDRE_GAINS_EXE, "generate", drive, "--check", out}), 3,
            "sdre-gains");
    }
}
