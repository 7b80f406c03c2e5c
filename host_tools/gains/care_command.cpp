// SPDX-License-Identifier: MIT
#include "gains/care_command.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/json.hpp"
#include "gains/commands.hpp"

namespace sdre {

namespace {

using nlohmann::json;

// Rows or columns. Chosen: Schur forms in long double take a few seconds then, and the time grows with the third power.
constexpr std::size_t max_size = 200;

const CareOptions any_definiteness{Precision::quick, true};

/// One matrix of the file, and the words that point at it in messages.
struct Entry {
    const std::string &file;
    const char        *key;

    [[noreturn]] void fail(const std::string &what) const
    {
        throw InputError(fmt::format("{}: key '{}': {}", file, key, what));
    }
};

double number(const json &value, const Entry &entry, std::size_t row, std::size_t col)
{
    const std::string place = fmt::format("row {}, column {}", row + 1, col + 1);
    if (!value.is_number()) {
        entry.fail(
            fmt::format("{} is of type {}, must be a finite number", place, value.type_name()));
    }
    return value.get<double>(); // finite: the parser refuses numbers beyond a double
}

void require_size(std::size_t size, const char *what, const Entry &entry)
{
    if (size == 0 || size > max_size) {
        entry.fail(fmt::format("has {} {}, must have 1 to {}", size, what, max_size));
    }
}

Eigen::MatrixXd matrix(const json &problem, const Entry &entry)
{
    const auto found = problem.find(entry.key);
    if (found == problem.end()) {
        entry.fail(
            "is missing, must be an array of rows; allowed are A, Q and either B and R or G");
    }
    if (!found->is_array()) {
        entry.fail(fmt::format("is of type {}, must be an array of rows", found->type_name()));
    }
    const std::size_t rows = found->size();
    require_size(rows, "rows", entry);
    Eigen::MatrixXd M;
    for (std::size_t i = 0; i < rows; ++i) {
        const json &row = (*found)[i];
        if (!row.is_array()) {
            entry.fail(fmt::format("row {} is of type {}, must be an array of numbers", i + 1,
                                   row.type_name()));
        }
        if (i == 0) {
            require_size(row.size(), "columns", entry);
            M.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(row.size()));
        }
        if (row.size() != static_cast<std::size_t>(M.cols())) {
            entry.fail(fmt::format("row {} has {} entries, must have {} like row 1", i + 1,
                                   row.size(), M.cols()));
        }
        for (std::size_t j = 0; j < row.size(); ++j) {
            M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                number(row[j], entry, i, j);
        }
    }
    return M;
}

void require_matrix_shape(const Eigen::MatrixXd &M, Eigen::Index rows, Eigen::Index cols,
                          const Entry &entry)
{
    if (M.rows() != rows || M.cols() != cols) {
        entry.fail(fmt::format("is {} x {}, must be {} x {}", M.rows(), M.cols(), rows, cols));
    }
}

json parsed(const std::string &text, const std::string &name)
{
    try {
        return json::parse(text);
    } catch (const json::parse_error &error) {
        throw InputError(fmt::format("{}: not valid JSON at byte {}, must be one JSON object", name,
                                     error.byte));
    } catch (const json::exception &) {
        throw InputError(
            fmt::format("{}: not valid JSON: a number is out of range, must be finite", name));
    }
}

/// %.17g gives every double back exactly.
std::string number_text(double value)
{
    return fmt::format("{:.17g}", value);
}

std::string row_text(const Eigen::MatrixXd &M, Eigen::Index row, const char *separator)
{
    std::string text;
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
        text += (j > 0 ? separator : "") + number_text(M(row, j));
    }
    return text;
}

} // namespace

CareProblem parse_care_problem(const std::string &text, const std::string &name)
{
    const json file = parsed(text, name);
    if (!file.is_object()) {
        throw InputError(
            fmt::format("{}: is of type {}, must be one JSON object", name, file.type_name()));
    }
    CareProblem problem;
    const Entry keyA{name, "A"};
    problem.A            = matrix(file, keyA);
    const Eigen::Index n = problem.A.rows();
    require_matrix_shape(problem.A, n, n, keyA);
    const Entry keyQ{name, "Q"};
    problem.Q = matrix(file, keyQ);
    require_matrix_shape(problem.Q, n, n, keyQ);

    const bool has_b_and_r = file.contains("B") && file.contains("R");
    if (!has_b_and_r && file.contains("G")) {
        const Entry keyG{name, "G"};
        problem.G = matrix(file, keyG);
        require_matrix_shape(problem.G, n, n, keyG);
        return problem;
    }
    const Entry keyB{name, "B"};
    problem.B = matrix(file, keyB);
    require_matrix_shape(problem.B, n, problem.B.cols(), keyB);
    const Entry keyR{name, "R"};
    problem.R = matrix(file, keyR);
    require_matrix_shape(problem.R, problem.B.cols(), problem.B.cols(), keyR);
    try {
        problem.G = control_weight(problem.B, problem.R);
    } catch (const DesignError &error) {
        throw DesignError(fmt::format("{}: key 'R': {}", name, error.what()));
    }
    return problem;
}

CareProblem read_care_problem(const std::filesystem::path &path)
{
    std::error_code error;
    std::ifstream   stream(path, std::ios::binary);
    if (!stream || std::filesystem::is_directory(path, error)) {
        throw InputError(fmt::format("{}: cannot be read, must be a JSON file", path.string()));
    }
    const std::string text{std::istreambuf_iterator<char>(stream),
                           std::istreambuf_iterator<char>()};
    if (stream.bad()) {
        throw InputError(fmt::format("{}: cannot be read, must be a JSON file", path.string()));
    }
    return parse_care_problem(text, path.string());
}

CareSolution solve_care_problem(const CareProblem &problem)
{
    if (problem.B.size() > 0) {
        return solve_care(problem.A, problem.B, problem.R, problem.Q, any_definiteness);
    }
    return solve_care(problem.A, problem.G, problem.Q, any_definiteness);
}

std::string care_text(const CareSolution &solution)
{
    std::string text = "X =\n";
    for (Eigen::Index i = 0; i < solution.X.rows(); ++i) {
        text += "  " + row_text(solution.X, i, "  ") + "\n";
    }
    if (!solution.semidefinite) {
        text += "X is indefinite: Q is not positive semidefinite\n";
    }
    text += fmt::format("relative residual = {:.3g}\nclosed-loop eigenvalues =\n",
                        solution.relative_residual);
    for (const std::complex<double> &s : solution.closed_loop_eigenvalues) {
        text += fmt::format("  {:.17g} {} {:.17g}j\n", s.real(), std::signbit(s.imag()) ? '-' : '+',
                            std::abs(s.imag()));
    }
    return text;
}

std::string care_json(const CareSolution &solution)
{
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < solution.X.rows(); ++i) {
        Json row = Json::array();
        for (Eigen::Index j = 0; j < solution.X.cols(); ++j) {
            row.push_back(solution.X(i, j));
        }
        rows.push_back(row);
    }
    Json modes = Json::array();
    for (const std::complex<double> &s : solution.closed_loop_eigenvalues) {
        modes.push_back({s.real(), s.imag()});
    }
    Json out;
    out["X"]                       = rows;
    out["X_indefinite"]            = !solution.semidefinite;
    out["relative_residual"]       = solution.relative_residual;
    out["closed_loop_eigenvalues"] = modes;
    return out.text();
}

namespace {

struct Options {
    std::string problem;
    bool        json = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("PROBLEM", o.problem, "JSON file with A, Q and B, R (or G)");
    list.flag("--json", o.json, "one JSON object");
}

int run(const Options &o)
{
    const CareSolution solution = solve_care_problem(read_care_problem(o.problem));
    fmt::print("{}", o.json ? care_json(solution) : care_text(solution));
    return exit_ok;
}

} // namespace

Command care_command()
{
    return command<Options>("care", "solve A'X + XA - XBR^-1B'X + Q = 0", declare, run,
                            "sdre-gains care problem.json --json");
}

} // namespace sdre
