// SPDX-License-Identifier: MIT
#include "gains/care_command.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "common/errors.hpp"

namespace {

using nlohmann::json;

const char *const good =
    R"({"A": [[0, 1], [0, 0]], "B": [[0], [1]], "R": [[1]], "Q": [[1, 0], [0, 0]], "id": "demo"})";

std::string input_error(const std::string &text)
{
    try {
        (void)sdre::parse_care_problem(text, "p.json");
    } catch (const sdre::InputError &error) {
        return error.what();
    }
    return "<no input error>";
}

std::string design_error(const std::string &text)
{
    try {
        (void)sdre::solve_care_problem(sdre::parse_care_problem(text, "p.json"));
    } catch (const sdre::DesignError &error) {
        return error.what();
    }
    return "<no design error>";
}

/// The good problem with the value of one key replaced.
std::string with(const std::string &key, const std::string &value)
{
    json problem     = json::parse(good);
    problem[key]     = "@";
    std::string text = problem.dump();
    return text.replace(text.find("\"@\""), 3, value);
}

std::string without(const std::string &key)
{
    json problem = json::parse(good);
    problem.erase(key);
    return problem.dump();
}

TEST(care_command, file_with_b_and_r_is_read_and_solved)
{
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "care_good.json";
    std::ofstream(path) << good;

    const sdre::CareProblem  problem  = sdre::read_care_problem(path);
    const sdre::CareSolution solution = sdre::solve_care_problem(problem);

    EXPECT_EQ(problem.A(0, 1), 1.0);
    EXPECT_EQ(problem.B(1, 0), 1.0);
    EXPECT_EQ(problem.G(1, 1), 1.0);
    EXPECT_EQ(problem.Q(0, 0), 1.0);
    EXPECT_NEAR(solution.X(0, 0), std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(solution.X(0, 1), 1.0, 1e-15);
}

TEST(care_command, b_and_r_win_over_g_and_g_alone_is_enough)
{
    json problem = json::parse(good);
    problem["G"] = json::parse("[[9, 0], [0, 9]]");
    EXPECT_EQ(sdre::parse_care_problem(problem.dump(), "p").G(0, 0), 0.0);
    problem.erase("R");
    EXPECT_EQ(sdre::parse_care_problem(problem.dump(), "p").G(0, 0), 9.0);
    EXPECT_EQ(sdre::parse_care_problem(problem.dump(), "p").B.size(), 0);
    problem.erase("B");
    EXPECT_EQ(sdre::parse_care_problem(problem.dump(), "p").G(0, 0), 9.0);
}

TEST(care_command, b_and_r_are_solved_without_rounding_their_weight)
{
    // Case 2.2: the rounded G costs seven digits of X.
    const std::string path = std::string(SDRE_TEST_DATA_DIR) + "/carex/carex-2.2-eps1e-8.json";
    const sdre::CareSolution solution = sdre::solve_care_problem(sdre::read_care_problem(path));
    EXPECT_NEAR(solution.X(1, 1), 9221.360295829608, 1e-9);
}

TEST(care_command, json_output_gives_every_bit_back)
{
    const sdre::CareSolution solution = sdre::solve_care_problem(sdre::parse_care_problem(
        R"({"A": [[0.1, 1e-7], [-3, 0.7]], "G": [[1, 0.3], [0.3, 2]], "Q": [[1e-3, 0], [0, 7e8]]})",
        "p.json"));

    const json output = json::parse(sdre::care_json(solution));

    ASSERT_EQ(output.size(), 4U);
    EXPECT_FALSE(output["X_indefinite"].get<bool>());
    for (Eigen::Index i = 0; i < 2; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (Eigen::Index j = 0; j < 2; ++j) {
            EXPECT_EQ(output["X"][row][static_cast<std::size_t>(j)].get<double>(),
                      solution.X(i, j));
        }
        const json &mode = output["closed_loop_eigenvalues"][row];
        EXPECT_EQ(mode[0].get<double>(), solution.closed_loop_eigenvalues(i).real());
        EXPECT_EQ(mode[1].get<double>(), solution.closed_loop_eigenvalues(i).imag());
    }
    EXPECT_EQ(output["relative_residual"].get<double>(), solution.relative_residual);
    EXPECT_EQ(sdre::care_json(solution).back(), '\n');
}

TEST(care_command, text_output_shows_solution_residual_and_poles)
{
    const std::string text = sdre::care_text(sdre::solve_care_problem(
        sdre::parse_care_problem(R"({"A":[[0]],"G":[[1]],"Q":[[4]]})", "p")));
    EXPECT_EQ(text, "X =\n  2\nrelative residual = 0\nclosed-loop eigenvalues =\n  -2 + 0j\n");
}

TEST(care_command, an_indefinite_solution_is_given_and_named)
{
    // x^2 + 4 x + 1 = 0, x = -2 + sqrt(3): stabilises although Q and X are negative.
    const sdre::CareSolution solution = sdre::solve_care_problem(
        sdre::parse_care_problem(R"({"A":[[-2]],"G":[[1]],"Q":[[-1]]})", "p"));
    EXPECT_NEAR(solution.X(0, 0), -2.0 + std::sqrt(3.0), 1e-15);
    EXPECT_NE(sdre::care_text(solution).find("X is indefinite"), std::string::npos);
    EXPECT_TRUE(json::parse(sdre::care_json(solution))["X_indefinite"].get<bool>());
}

TEST(care_command, benchmark_1_4_is_solved_and_said_to_be_indefinite)
{
    const std::string file = std::string(SDRE_TEST_DATA_DIR) + "/carex/carex-1.4.json";
    const auto        run  = support::run_command({SDRE_GAINS_EXE, "care", file, "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const json output = json::parse(run.out);
    EXPECT_TRUE(output["X_indefinite"].get<bool>());
    EXPECT_NEAR(output["X"][7][7].get<double>(), 0.079489693942803, 1e-15); // the file's X_ref
    EXPECT_LT(output["closed_loop_eigenvalues"].back()[0].get<double>(), 0.0);
}

TEST(care_command, integers_and_negative_zero_are_numbers)
{
    const sdre::CareProblem problem =
        sdre::parse_care_problem(R"({"A":[[-0.0]],"G":[[18446744073709551615]],"Q":[[1e0]]})", "p");
    EXPECT_EQ(problem.G(0, 0), 18446744073709551615.0);
}

TEST(care_command_refuses, files_that_cannot_be_read)
{
    for (const std::string path : {"/nonexistent/p.json", SDRE_TEST_DATA_DIR}) {
        try {
            (void)sdre::read_care_problem(path);
            ADD_FAILURE() << path;
        } catch (const sdre::InputError &error) {
            EXPECT_EQ(error.what(), path + ": cannot be read, must be a JSON file");
        }
    }
}

TEST(care_command_refuses, texts_that_are_not_a_json_object)
{
    EXPECT_EQ(input_error(""), "p.json: not valid JSON at byte 1, must be one JSON object");
    EXPECT_EQ(input_error("{\"A\": [[NaN]]}"),
              "p.json: not valid JSON at byte 9, must be one JSON object");
    EXPECT_NE(input_error("{\"A\": [[Infinity]]}").find("not valid JSON"), std::string::npos);
    EXPECT_NE(input_error("{\"A\": \n\x01").find("not valid JSON"), std::string::npos);
    EXPECT_NE(input_error("{\"\xff\": 1}").find("not valid JSON"), std::string::npos);
    EXPECT_NE(input_error("{} {}").find("not valid JSON"), std::string::npos);
    EXPECT_EQ(input_error("[1]"), "p.json: is of type array, must be one JSON object");
    EXPECT_EQ(input_error("null"), "p.json: is of type null, must be one JSON object");
    EXPECT_NE(input_error(with("Q", "[[1e400, 0], [0, 0]]")).find("out of range"),
              std::string::npos);
}

TEST(care_command_refuses, missing_keys)
{
    EXPECT_NE(input_error("{}").find("p.json: key 'A': is missing"), std::string::npos);
    for (const char *key : {"A", "B", "R", "Q"}) {
        const std::string expected = std::string("p.json: key '") + key + "': is missing, must be";
        EXPECT_NE(input_error(without(key)).find(expected), std::string::npos) << key;
    }
}

TEST(care_command_refuses, wrong_types_in_every_key)
{
    for (const std::string key : {"A", "B", "R", "Q"}) {
        const std::string start = "p.json: key '" + key + "': ";
        EXPECT_EQ(input_error(with(key, "3")),
                  start + "is of type number, must be an array of rows");
        EXPECT_EQ(input_error(with(key, "null")),
                  start + "is of type null, must be an array of rows");
        EXPECT_EQ(input_error(with(key, "{\"a\": 1}")),
                  start + "is of type object, must be an array of rows");
        EXPECT_EQ(input_error(with(key, "[1, 2]")),
                  start + "row 1 is of type number, must be an array of numbers");
        EXPECT_EQ(input_error(with(key, "[[\"1\"]]")),
                  start + "row 1, column 1 is of type string, must be a finite number");
        EXPECT_EQ(input_error(with(key, "[[null]]")),
                  start + "row 1, column 1 is of type null, must be a finite number");
        EXPECT_EQ(input_error(with(key, "[[true]]")),
                  start + "row 1, column 1 is of type boolean, must be a finite number");
        EXPECT_EQ(input_error(with(key, "[[[1]]]")),
                  start + "row 1, column 1 is of type array, must be a finite number");
        EXPECT_EQ(input_error(with(key, "[]")), start + "has 0 rows, must have 1 to 200");
        EXPECT_EQ(input_error(with(key, "[[]]")), start + "has 0 columns, must have 1 to 200");
        EXPECT_EQ(input_error(with(key, "[[1, 2], [3]]")),
                  start + "row 2 has 1 entries, must have 2 like row 1");
    }
}

TEST(care_command_refuses, wrong_shapes)
{
    EXPECT_EQ(input_error(with("A", "[[1, 2]]")), "p.json: key 'A': is 1 x 2, must be 1 x 1");
    EXPECT_EQ(input_error(with("Q", "[[1]]")), "p.json: key 'Q': is 1 x 1, must be 2 x 2");
    EXPECT_EQ(input_error(with("B", "[[1]]")), "p.json: key 'B': is 1 x 1, must be 2 x 1");
    EXPECT_EQ(input_error(with("R", "[[1, 0], [0, 1]]")),
              "p.json: key 'R': is 2 x 2, must be 1 x 1");
    EXPECT_EQ(input_error(R"({"A":[[1]],"Q":[[1]],"G":[[1,2]]})"),
              "p.json: key 'G': is 1 x 2, must be 1 x 1");
    json huge = json::parse(good);
    huge["A"] = json(201, json(201, 0.0));
    EXPECT_EQ(input_error(huge.dump()), "p.json: key 'A': has 201 rows, must have 1 to 200");
}

TEST(care_command_refuses, problems_without_a_solution_by_name)
{
    EXPECT_EQ(design_error(with("R", "[[0]]")), "p.json: key 'R': R is not positive definite");
    EXPECT_EQ(design_error(with("R", "[[-1]]")), "p.json: key 'R': R is not positive definite");
    EXPECT_EQ(design_error(with("Q", "[[1, 1], [0, 1]]")), "Q is not symmetric");
    EXPECT_NE(design_error(with("Q", "[[-1, 0], [0, 0]]")).find("Q is not positive semidefinite"),
              std::string::npos);
    EXPECT_NE(design_error(with("B", "[[0], [0]]")).find("(A,B) is not stabilisable"),
              std::string::npos);
    EXPECT_NE(design_error(with("Q", "[[0, 0], [0, 1]]")).find("(A,Q) is not detectable"),
              std::string::npos);
    EXPECT_EQ(design_error(R"({"A":[[1]],"Q":[[1]],"G":[[-1]]})"),
              "G is not positive semidefinite: entry (1, 1) is -1");
}

TEST(care_command, extreme_weights_end_in_a_finite_solution_or_one_line)
{
    for (const char *key : {"A", "B", "R", "Q"}) {
        for (const char *value :
             {"1e300", "-1e300", "1e-300", "1e-320", "1.7976931348623157e308"}) {
            json problem       = json::parse(good);
            problem[key][0][0] = json::parse(value);
            try {
                const sdre::CareSolution solution =
                    sdre::solve_care_problem(sdre::parse_care_problem(problem.dump(), "p"));
                EXPECT_TRUE(solution.X.allFinite());
                EXPECT_EQ(sdre::care_json(solution).find("inf"), std::string::npos);
                EXPECT_EQ(sdre::care_json(solution).find("nan"), std::string::npos);
            } catch (const sdre::DesignError &error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            }
        }
    }
}

/// Solves, or ends in one of the two errors with one line; anything else escapes and fails the
/// test.
bool survives(const std::string &text)
{
    try {
        const sdre::CareSolution solution =
            sdre::solve_care_problem(sdre::parse_care_problem(text, "p.json"));
        return solution.X.allFinite() && json::accept(sdre::care_json(solution));
    } catch (const sdre::InputError &error) {
        const std::string message = error.what();
        return message.rfind("p.json: ", 0) == 0 && message.find('\n') == std::string::npos;
    } catch (const sdre::DesignError &error) {
        return std::string(error.what()).find('\n') == std::string::npos;
    }
}

TEST(care_command, truncated_files_never_crash)
{
    const std::string text = good;
    for (std::size_t length = 0; length < text.size(); ++length) {
        EXPECT_TRUE(survives(text.substr(0, length))) << length;
        EXPECT_NE(input_error(text.substr(0, length)), "<no input error>") << length;
    }
    EXPECT_TRUE(survives(text));
}

TEST(care_command, mutated_files_never_crash)
{
    const std::string text     = good;
    const std::string alphabet = "0123456789.eE+-[]{},:\"ABGRQ nulltrue\n\\\xff\x01";
    std::mt19937      generator(99);
    const auto        pick = [&](std::size_t size) { return generator() % size; };
    for (int trial = 0; trial < 4000; ++trial) {
        std::string mutant = text;
        for (std::size_t edits = 1 + pick(3); edits > 0; --edits) {
            const std::size_t place  = pick(mutant.size());
            const char        symbol = alphabet[pick(alphabet.size())];
            switch (pick(3)) {
            case 0:
                mutant[place] = symbol;
                break;
            case 1:
                mutant.insert(place, 1, symbol);
                break;
            default:
                mutant.erase(place, 1 + pick(4));
                break;
            }
        }
        EXPECT_TRUE(survives(mutant)) << mutant;
    }
}

TEST(care_command, deep_nesting_never_crashes)
{
    EXPECT_TRUE(survives(std::string(200000, '[')));
    EXPECT_TRUE(survives("{\"A\":" + std::string(200000, '[') + std::string(200000, ']') + "}"));
}

} // namespace
