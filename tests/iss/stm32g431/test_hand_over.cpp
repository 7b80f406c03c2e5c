// SPDX-License-Identifier: MIT
// sdre-sil --board stm32g431 hands over to sdre-iss, options and exit code too, and says what is missing.
#include <gtest/gtest.h>

#include <cstdlib>

#include "command.hpp"
#include "scenario_text.hpp"
#include "temp_dir.hpp"

namespace {

using support::CommandResult;
using support::TempDir;

const std::string scenario = SDRE_SOURCE_DIR "/host_tools/sil/scenarios/m2310p_load_step.toml";

CommandResult sil(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), SDRE_SIL_EXE);
    return support::run_command(std::move(arguments));
}

class IssHandOver : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(setenv("SDRE_ISS", SDRE_ISS_EXE, 1), 0);
    }
    TempDir dir;
};

} // namespace

TEST_F(IssHandOver, PassesOptionsOn)
{
    const CommandResult r = sil({"run", scenario, "--board", "stm32g431", "--image", ISS_IMAGE,
                                 "--csv", (dir / "trace.csv").string(), "--seed", "7"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.out.rfind("board: stm32g431, the image\n", 0), 0U) << r.out;
    EXPECT_NE(r.out.find("control interrupt, worst and median"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(dir / "trace.csv"));
}

TEST_F(IssHandOver, GivesTheExitCodeOfAFault)
{
    std::string text = support::read_file(scenario);
    const auto  at   = text.find("drive = \"");
    text.replace(at, text.find('\n', at) - at,
                 "drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/m2310p_24v.toml\"");
    text += "[[fault]]\ntime_s = 0.02\nkind = \"tick_hung\"\n";
    const CommandResult r =
        sil({"run", dir.write("fault.toml", text), "--board", "stm32g431", "--image", ISS_IMAGE});
    EXPECT_EQ(r.exit_code, 4) << r.err << r.out;
}

TEST_F(IssHandOver, SaysWhatIsMissing)
{
    support::expect_refused(
        sil({"run", scenario, "--board", "stm32g431", "--image", (dir / "no.elf").string()}), 1,
        "sdre-iss", {"--image", "no.elf", "stm32g431-release"});
    support::expect_refused(sil({"run", scenario, "--image", ISS_IMAGE}), 1, "sdre-sil",
                            {"--image", "stm32g431"});
    ASSERT_EQ(setenv("SDRE_ISS", (dir / "none").c_str(), 1), 0);
    support::expect_refused(sil({"run", scenario, "--board", "stm32g431"}), 1, "sdre-sil",
                            {"--board stm32g431", "none", "--target sdre-iss", "SDRE_ISS"});
    for (const char *const option : {"--flash", "--boot-rom"}) {
        std::vector<std::string> all{"serve", "--board", "stm32g431", option};
        if (std::string(option) == "--flash") {
            all.emplace_back("kept.bin");
        }
        support::expect_refused(sil(all), 1, "sdre-sil", {option, "stm32g431"});
    }
}
