// SPDX-License-Identifier: MIT
/// Generated sequences of two masters against the application with a motor, and a model of what they may lead to.
///
/// The model has the states of CiA 402 as docs/modbus.md tells them, and the registers as docs/registers.csv does.
/// SDRE_SEQUENCES sets the number of sequences, SDRE_SEQUENCE the first seed.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fake_board.h"

extern "C" {
#include "app.h"
#include "board_config.h"
#include "gain_tables.h"
#include "modbus_frame.h"
#include "test_motor.h"
}

namespace {

constexpr int    sequences       = 48;
constexpr int    steps           = 150;
constexpr int    settle_ticks    = 250; // 50 ms: a stop from 40 rad/s, and a start
constexpr double mark_rad        = 0.7; // mechanical angle of the index mark
constexpr double speed_off_radps = 3.0;
constexpr double current_most_A  = 4.3; // limit 4 A
constexpr int    scope_samples   = 512;

// Registers.
constexpr int holding_control      = 0;
constexpr int holding_speed        = 2;
constexpr int holding_quick_option = 13;
constexpr int holding_scope        = 96;
constexpr int input_status         = 0;
constexpr int input_scope_state    = 192;
constexpr int input_samples        = 16384;
constexpr int scope_signals        = 21;

enum class State { not_ready, disabled, ready, switched, enabled, quick_stop, reaction, fault };

/// A state of CiA 402 with the memory that its transitions need.
struct Model {
    State state      = State::disabled;
    bool  armed      = false; ///< bit 3 was 0 since the last start
    bool  reset_high = false; ///< bit 7 of the word before
    bool  operator<(const Model &o) const
    {
        return std::tie(state, armed, reset_high) < std::tie(o.state, o.armed, o.reset_high);
    }
};

/// Conditions of a transition beside the control word.
struct Circumstances {
    bool in_the_way = false; ///< of a start
    bool stays      = false; ///< QUICK_STOP_OPTION 5 or 6
};

enum class When { always, stays, leaves };

/// A transition by the mask and the value of a control word.
struct Transition {
    State from;
    int   mask, value;
    State to;
    When  when = When::always;
};

const std::vector<Transition> table = {
    {State::disabled, 7, 6, State::ready},                    // 2
    {State::ready, 15, 7, State::switched},                   // 3
    {State::ready, 15, 15, State::switched},                  // 3, then 4
    {State::ready, 2, 0, State::disabled},                    // 7
    {State::ready, 6, 2, State::disabled},                    // 7
    {State::switched, 15, 15, State::enabled},                // 4
    {State::switched, 7, 6, State::ready},                    // 6
    {State::switched, 2, 0, State::disabled},                 // 10
    {State::switched, 6, 2, State::disabled},                 // 10
    {State::enabled, 15, 7, State::switched},                 // 5
    {State::enabled, 7, 6, State::ready},                     // 8
    {State::enabled, 2, 0, State::disabled},                  // 9
    {State::enabled, 6, 2, State::quick_stop},                // 11
    {State::quick_stop, 2, 0, State::disabled},               // 12
    {State::quick_stop, 0, 0, State::disabled, When::leaves}, // 12, when the shaft stands
    {State::quick_stop, 15, 15, State::enabled, When::stays}, // 16
};

/// Where a drive ends that obeys this word for long enough.
Model obey(Model m, int word, const Circumstances &now)
{
    const bool reset = (word & 128) != 0;
    if (m.state == State::fault) {
        if (reset && !m.reset_high) {
            m.state = State::disabled; // 15
            m.armed = false;
        }
    }
    m.reset_high = reset;
    for (int n = 0; n < 6 && m.state != State::fault; n++) {
        m.armed       = m.armed || (word & 8) == 0;
        const auto to = std::find_if(table.begin(), table.end(), [&](const Transition &t) {
            return t.from == m.state && (word & t.mask) == t.value &&
                   (t.when == When::always || (t.when == When::stays) == now.stays);
        });
        if (to == table.end()) {
            break;
        }
        if (to->to == State::enabled && m.state != State::quick_stop) {
            const bool starts = m.armed && !now.in_the_way;
            m.armed           = false;
            if (!starts) {
                break;
            }
        }
        m.state = to->to;
    }
    return m;
}

/// The state of a status word, by the standard's table.
std::optional<State> decode(int status)
{
    static const std::vector<std::tuple<int, int, State>> codes = {
        {0x4F, 0x00, State::not_ready}, {0x4F, 0x40, State::disabled},
        {0x6F, 0x21, State::ready},     {0x6F, 0x23, State::switched},
        {0x6F, 0x27, State::enabled},   {0x6F, 0x07, State::quick_stop},
        {0x4F, 0x0F, State::reaction},  {0x4F, 0x08, State::fault}};
    for (const auto &[mask, value, state] : codes) {
        if ((status & mask) == value) {
            return state;
        }
    }
    return std::nullopt;
}

/// Addresses of the first register of each 32-bit holding register, without the commands that restart the drive.
std::vector<int> wide_registers()
{
    std::ifstream    file(SDRE_SOURCE_DIR "/docs/registers.csv");
    std::vector<int> found;
    std::string      line;
    while (std::getline(file, line)) {
        std::istringstream       cells(line);
        std::vector<std::string> cell;
        for (std::string one; std::getline(cells, one, ',');) {
            cell.push_back(one);
        }
        if (cell.at(0) == "holding" && cell.at(2) == "2") {
            found.push_back(std::stoi(cell.at(1)));
        }
    }
    return found;
}

class Drive {
public:
    Drive()
    {
        fake_board_reset();
        config_                         = board_config;
        config_.angle.index_theta_e_rad = static_cast<float>(2.0 * mark_rad);
        motor_                          = test_motor_390w();
        EXPECT_EQ(app_init(&config_, &gain_tables_drive), CTL_OK);
        motor_.omega_m_radps = 20.0; // by hand, until the mark has passed
        ticks(2000);
        motor_.omega_m_radps = 0.0;
        ticks(50);
    }

    void tick()
    {
        const int  before = fake_board.sample.position_cnt;
        const int  now    = test_motor_position(&motor_, mark_rad);
        const auto code   = [this](int phase) {
            return static_cast<std::uint16_t>(
                2048 + std::lround(test_motor_phase_A(&motor_, phase) * 4096.0 / 20.0));
        };
        fake_board.sample.ia_cnt       = code(0);
        fake_board.sample.ib_cnt       = code(1);
        fake_board.sample.dc_link_cnt  = static_cast<std::uint16_t>(link_V * 4096.0 / 450.0);
        fake_board.sample.index_seen   = std::abs(now - before) > 5000;
        fake_board.sample.index_cnt    = 0;
        fake_board.sample.position_cnt = static_cast<std::uint16_t>(now);
        fake_board.sample.edge_seen    = now != before;
        fake_board.sample.edge_age_cnt = static_cast<std::uint16_t>(
            std::min(test_motor_edge_age_s(&motor_, mark_rad) * BOARD_CAPTURE_Hz, 65535.0));
        app_tick();
        app_background();
        test_motor_period(&motor_, duty_.data(), fake_board.gate);
        duty_  = {fake_board.duty.a_cnt / 7500.0, fake_board.duty.b_cnt / 7500.0,
                  fake_board.duty.c_cnt / 7500.0};
        most_A = std::max(most_A, std::hypot(motor_.id_A, motor_.iq_A));
    }
    void ticks(int count)
    {
        for (int n = 0; n < count; n++) {
            tick();
        }
    }
    /// The answer without address and sum, empty when there is none.
    std::vector<int> ask(std::vector<int> request)
    {
        request.insert(request.begin(), 1);
        modbus_frame_receive(request.data(), static_cast<int>(request.size()));
        std::vector<int> answer;
        for (int quiet = 0; quiet < 30; quiet++) {
            tick();
            for (int octet = fake_board_sent(); octet >= 0; octet = fake_board_sent()) {
                answer.push_back(octet);
                quiet = 20;
            }
        }
        return answer.size() < 4 ? std::vector<int>{}
                                 : std::vector<int>(answer.begin() + 1, answer.end() - 2);
    }
    /// 0 or the exception.
    int write(int at, const std::vector<int> &words)
    {
        std::vector<int> request = {16,
                                    at >> 8,
                                    at & 255,
                                    0,
                                    static_cast<int>(words.size()),
                                    2 * static_cast<int>(words.size())};
        for (const int word : words) {
            request.push_back(word >> 8);
            request.push_back(word & 255);
        }
        return exception(ask(request));
    }
    int write_one(int at, int word)
    {
        return exception(ask({6, at >> 8, at & 255, word >> 8, word & 255}));
    }
    /// Nothing: an exception.
    std::optional<std::vector<int>> read(int function, int at, int count)
    {
        const std::vector<int> answer = ask({function, at >> 8, at & 255, 0, count});
        if (answer.size() != 2U + 2U * static_cast<std::size_t>(count)) {
            return std::nullopt;
        }
        std::vector<int> words;
        for (std::size_t n = 2; n < answer.size(); n += 2) {
            words.push_back((answer[n] << 8) | answer[n + 1]);
        }
        return words;
    }
    double speed_e_radps() const
    {
        return motor_.pole_pairs * motor_.omega_m_radps;
    }

    double link_V = 295.0;
    double most_A = 0.0;

private:
    static int exception(const std::vector<int> &answer)
    {
        return answer.empty() ? -1 : (answer[0] & 128) != 0 ? answer.at(1) : 0;
    }
    app_config_t          config_;
    test_motor_t          motor_;
    std::array<double, 3> duty_ = {0.5, 0.5, 0.5};
};

/// Every settled state with every pattern of bits 3 .. 0 that was given in it.
using Given = std::set<std::pair<State, int>>;

class Sequence {
public:
    Sequence(unsigned seed, Given &given) : random_(seed), wide_(wide_registers()), given_(given)
    {
        // Before the first word the drive has seen 0: bit 3 is low.
        may_.insert(obey({}, 0, {}));
    }
    void run()
    {
        settle();
        quick_option();
        for (int n = 0; n < steps && !::testing::Test::HasFailure(); n++) {
            one();
        }
        settle();
        if (::testing::Test::HasFailure()) {
            ADD_FAILURE() << log_;
        }
    }

private:
    int below(int n)
    {
        return static_cast<int>(random_() % static_cast<unsigned>(n));
    }
    void note(const std::string &what)
    {
        log_ += what + "\n";
    }
    void one()
    {
        switch (below(15)) {
        case 0:
        case 1:
        case 2:
        case 3:
            control(word());
            break;
        case 4: // two masters: nobody waits for what the other has asked for
            control(word());
            drive_.ticks(below(4));
            control(word());
            break;
        case 5:
            speed();
            break;
        case 6:
            half();
            break;
        case 7:
            scope_setup();
            break;
        case 8:
            scope();
            break;
        case 9:
            link();
            break;
        case 10:
            trip();
            break;
        case 11:
            quick_option();
            break;
        case 12:
        case 13:
            visit();
            break;
        default:
            settle();
            break;
        }
        if (below(2) == 0) {
            settle();
        }
    }
    /// Any word, or one that goes on.
    int word()
    {
        static const std::array<int, 8> usual = {6, 7, 15, 15, 15, 2, 0, 128};
        return below(4) == 0 ? below(65536) : usual.at(static_cast<std::size_t>(below(8)));
    }
    void control(int w)
    {
        note(fmt::format("control {:#06x}", w));
        const int got = below(2) == 0 ? drive_.write_one(holding_control, w)
                                      : drive_.write(holding_control, {w});
        ASSERT_EQ(got, 0);
        halted_ = (w & 256) != 0;
        // A word is overwritten when the next one comes before the drive has taken it.
        std::set<Model> after;
        std::set<Model> all = may_;
        all.insert(skipped_.begin(), skipped_.end());
        for (const Model &m : all) {
            after.insert(obey(m, w, {in_the_way(), stays_}));
        }
        if (skipped_.empty()) {
            given_.insert({settled_, w & 15});
        }
        skipped_ = all;
        may_     = after;
    }
    bool in_the_way() const
    {
        return drive_.link_V < 100.0;
    }
    void speed()
    {
        const bool             wrong = below(4) == 0;
        const int              tenth = wrong ? 20000 + below(1000000) : below(801) - 400;
        const auto             bits  = static_cast<std::uint32_t>(tenth);
        const std::vector<int> words = {static_cast<int>(bits >> 16U),
                                        static_cast<int>(bits & 0xFFFFU)};
        note(fmt::format("speed {}", tenth));
        ASSERT_EQ(drive_.write(holding_speed, words), wrong ? 3 : 0);
        speed_tenth_ = wrong ? speed_tenth_ : tenth;
        same_speed();
    }
    void same_speed()
    {
        const auto words = drive_.read(3, holding_speed, 2);
        ASSERT_TRUE(words);
        const auto bits = static_cast<std::uint32_t>((words->at(0) << 16) | words->at(1));
        ASSERT_EQ(static_cast<std::int32_t>(bits), speed_tenth_);
    }
    /// Half of a 32-bit register is refused, and nothing of the request is written.
    void half()
    {
        const int at    = wide_.at(static_cast<std::size_t>(below(static_cast<int>(wide_.size()))));
        const int other = below(65536);
        note(fmt::format("half of {}", at));
        const auto before = drive_.read(3, at, 2);
        ASSERT_TRUE(before);
        switch (below(4)) {
        case 0:
            ASSERT_EQ(drive_.write_one(at, other), 2);
            break;
        case 1:
            ASSERT_EQ(drive_.write_one(at + 1, other), 2);
            break;
        case 2:
            ASSERT_EQ(drive_.write(at, {other}), 2);
            break;
        default: // a whole register, then a half
            ASSERT_EQ(drive_.write(holding_control, {other, 3, other}), 2);
            break;
        }
        ASSERT_EQ(drive_.read(3, at, 2), before);
        same_speed();
    }
    void scope_setup()
    {
        // Signals, decimation, trigger, channel; each may be one too many.
        std::vector<int> words = {below(scope_signals + 2),
                                  below(scope_signals),
                                  below(scope_signals),
                                  below(scope_signals),
                                  below(5),
                                  below(4),
                                  below(6)};
        const bool       fits  = words[0] < scope_signals && words[4] > 0 && words[5] < 3 &&
                          words[6] > 0 && words[6] < 5;
        note(fmt::format("scope {}", fmt::join(words, " ")));
        ASSERT_EQ(drive_.write(holding_scope + 1, words), fits ? 0 : 3);
        if (fits) {
            scope_ = words;
        }
        ASSERT_EQ(drive_.read(3, holding_scope + 1, 7), scope_);
    }
    void scope()
    {
        const int command = below(4);
        note(fmt::format("scope command {}", command));
        ASSERT_EQ(drive_.write_one(holding_scope, command), command == 3 ? 3 : 0);
        ASSERT_EQ(drive_.read(3, holding_scope, 1), std::vector<int>{0});
        if (command == 1 || command == 2) {
            armed_         = command == 1;
            done_in_ticks_ = armed_ && scope_.at(5) == 0 ? scope_samples * scope_.at(4) : 0;
        }
        if (armed_ && done_in_ticks_ > 0 && below(2) == 0) {
            drive_.ticks(done_in_ticks_ + 2);
            ASSERT_EQ(drive_.read(4, input_scope_state, 1), std::vector<int>{4});
        }
        const auto state = drive_.read(4, input_scope_state, 1);
        ASSERT_TRUE(state);
        ASSERT_EQ(state->at(0) != 0, armed_);
        if (state->at(0) == 0 || state->at(0) == 4) { // else it may end meanwhile
            ASSERT_EQ(drive_.read(4, input_samples + 8 * below(scope_samples), 8).has_value(),
                      state->at(0) == 4);
        }
    }
    /// Any word in a state that is rare otherwise.
    void visit()
    {
        static const std::vector<std::vector<int>> ways = {{6, 15, 2}, {6, 15}, {6, 7}};
        const int                                  way  = below(4);
        if (way == 3) {
            trip();
        } else {
            for (const int w : ways.at(static_cast<std::size_t>(way))) {
                settle();
                control(w);
            }
            settle();
        }
        control(below(65536));
    }
    /// Options 3 and 4 are not there.
    void quick_option()
    {
        settle();
        if (settled_ == State::quick_stop) {
            return; // it would end
        }
        const int  option = below(2) == 0 ? below(7) : 6;
        const bool fits   = option != 3 && option != 4;
        note(fmt::format("quick stop option {}", option));
        ASSERT_EQ(drive_.write_one(holding_quick_option, option), fits ? 0 : 3);
        stays_ = fits ? option > 4 : stays_;
    }
    /// The dc link goes and comes. It trips a run, and prevents a start.
    void link()
    {
        settle();
        drive_.link_V = in_the_way() ? 295.0 : 20.0;
        note(fmt::format("link {}", drive_.link_V));
        drive_.ticks(20);
        if (in_the_way()) {
            fall();
        }
        settle();
    }
    void trip()
    {
        settle();
        note("trip");
        fake_board_fail(BOARD_FAULT_TRIP);
        drive_.ticks(2);
        fake_board.causes = 0;
        fall();
        settle();
    }
    /// A fault that a run sees.
    void fall()
    {
        std::set<Model> after;
        for (Model m : may_) {
            if (m.state == State::enabled || m.state == State::quick_stop) {
                m.state = State::fault;
                m.armed = false;
            }
            after.insert(m);
        }
        may_ = after;
    }
    /// After this time the drive is where the model says, and the model knows which of them it is.
    void settle()
    {
        drive_.ticks(settle_ticks);
        const auto status = drive_.read(4, input_status, 1);
        ASSERT_TRUE(status);
        const auto state = decode(status->at(0));
        ASSERT_TRUE(state) << fmt::format("{:#06x}", status->at(0));
        std::set<Model> now;
        std::string     allowed;
        for (const Model &m : may_) {
            allowed += fmt::format(" {}", static_cast<int>(m.state));
            if (m.state == *state) {
                now.insert(m);
            }
        }
        note(fmt::format("settled: state {}, {:.1f} rad/s", static_cast<int>(*state),
                         drive_.speed_e_radps()));
        ASSERT_FALSE(now.empty()) << "state " << static_cast<int>(*state) << ", allowed" << allowed;
        may_ = now;
        skipped_.clear();
        settled_      = *state;
        const bool on = *state == State::enabled || *state == State::quick_stop;
        ASSERT_EQ(fake_board.gate, on);
        ASSERT_EQ((status->at(0) >> 14) & 1, on ? 1 : 0);
        if (on) {
            ASSERT_NEAR(drive_.speed_e_radps(),
                        halted_ || *state == State::quick_stop ? 0.0 : 0.1 * speed_tenth_,
                        speed_off_radps);
        }
        ASSERT_LT(drive_.most_A, current_most_A);
    }

    std::mt19937     random_;
    std::vector<int> wide_;
    Given           &given_;
    Drive            drive_;
    std::set<Model>  may_;     ///< where the last word may have led
    std::set<Model>  skipped_; ///< where the words before it may have led
    std::vector<int> scope_         = {0, 0, 0, 0, 1, 0, 1};
    bool             armed_         = false;
    bool             halted_        = false;
    bool             stays_         = false;
    State            settled_       = State::not_ready;
    int              done_in_ticks_ = 0;
    int              speed_tenth_   = 0;
    std::string      log_;
};

int number(const char *name, int otherwise)
{
    const char *text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : otherwise;
}

} // namespace

TEST(Sequences, EveryOneEndsWhereTheModelSays)
{
    const int first = number("SDRE_SEQUENCE", 1);
    Given     given;
    for (int n = 0; n < number("SDRE_SEQUENCES", sequences) && !HasFailure(); n++) {
        SCOPED_TRACE(fmt::format("seed {}", first + n));
        Sequence(static_cast<unsigned>(first + n), given).run();
    }
    if (std::getenv("SDRE_SEQUENCES") == nullptr) {
        for (const State state : {State::disabled, State::ready, State::switched, State::enabled,
                                  State::quick_stop, State::fault}) {
            for (int bits = 0; bits < 16; bits++) {
                EXPECT_TRUE(given.count({state, bits}))
                    << "state " << static_cast<int>(state) << ", bits " << bits;
            }
        }
    }
}
