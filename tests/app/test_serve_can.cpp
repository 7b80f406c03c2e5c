// SPDX-License-Identifier: MIT
// The CAN bus of the served drive: clients over TCP and on a pseudo-terminal, and the bus of another drive.
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "../support/temp_dir.hpp"
#include "common/errors.hpp"
#include "sil/serve/can_join.hpp"
#include "sil/serve/server.hpp"

using namespace sdre;

namespace {

constexpr double longest_s = 60.0; // simulated; the tests end it sooner

Drive shipped()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
}

void nap()
{
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

/// A client of slcan; frames of the drive itself are passed over.
class Client {
public:
    explicit Client(Descriptor fd) : fd_(std::move(fd)) {}

    void say(const std::string &text)
    {
        Octets out(text.begin(), text.end());
        ASSERT_TRUE(write_some(fd_.get(), out));
    }
    /// Waits for this text in what has come; what came before it is gone.
    bool hears(const std::string &text, int longest_ms = 10000)
    {
        for (int ms = 0; ms < longest_ms; ms += 2) {
            read_available(fd_.get(), come_);
            const std::string all(come_.begin(), come_.end());
            const std::size_t at = all.find(text);
            if (at != std::string::npos) {
                come_.erase(come_.begin(),
                            come_.begin() + static_cast<std::ptrdiff_t>(at + text.size()));
                return true;
            }
            nap();
        }
        return false;
    }

private:
    Descriptor fd_;
    Octets     come_;
};

class ServeCan : public ::testing::Test {
protected:
    void serve(CanPortOptions can)
    {
        ServeOptions o;
        o.can     = std::move(can);
        o.control = 0;
        o.end_s   = longest_s;
        server.emplace(shipped(), 1, o);
        thread = std::thread([this] { server->run(); });
    }
    Client client() const
    {
        return Client(connect_to_loopback(server->can_port()));
    }
    ~ServeCan() override
    {
        if (thread.joinable()) {
            server->stop();
            thread.join();
        }
    }

    std::optional<Server> server;
    std::thread           thread;
};

} // namespace

TEST_F(ServeCan, ClientsShareTheBus)
{
    serve({0, "", std::nullopt});
    EXPECT_NE(
        server->greeting().find(fmt::format("CAN, slcan       127.0.0.1:{}", server->can_port())),
        std::string::npos);
    Client one   = client();
    Client two   = client();
    Client three = client();
    one.say("t1230\r");
    EXPECT_TRUE(one.hears("\a")); // not open yet
    one.say("C\r\rO\r");
    EXPECT_TRUE(one.hears("\a\r\r"));
    two.say("O\r");
    three.say("L\r");
    EXPECT_TRUE(two.hears("\r") && three.hears("\r"));
    one.say("t6802BE");
    nap();
    one.say("EF\r");
    EXPECT_TRUE(two.hears("t6802BEEF\r") && three.hears("t6802BEEF\r"));
    EXPECT_TRUE(one.hears("z\r"));
    two.say("R000006804\r");
    EXPECT_TRUE(one.hears("R000006804\r"));
    EXPECT_FALSE(two.hears("R000006804\r", 100)) << "back to its sender";
}

TEST_F(ServeCan, AClientThatGoesLeavesTheBus)
{
    serve({0, "", std::nullopt});
    Client one = client();
    Client two = client();
    one.say("O\r");
    two.say("O\r");
    EXPECT_TRUE(one.hears("\r") && two.hears("\r"));
    {
        Client wrong = client();
        wrong.say("S3\rO\r"); // at another rate it destroys what others send
        EXPECT_TRUE(wrong.hears("\r\r"));
        one.say("t6801AA\r");
        EXPECT_FALSE(two.hears("t6801AA\r", 300));
    }
    one.say("C\rO\rt6802ABCD\r"); // it was in bus-off
    EXPECT_TRUE(two.hears("t6802ABCD\r"));
}

TEST_F(ServeCan, APseudoTerminalIsAClient)
{
    const support::TempDir dir;
    const std::string      path = (dir / "can").string();
    serve({0, path, std::nullopt});
    EXPECT_NE(server->greeting().find("CAN, slcan       " + path), std::string::npos);
    Client line(Descriptor(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)));
    Client one = client();
    one.say("O\r");
    line.say("\rO\r");
    EXPECT_TRUE(one.hears("\r") && line.hears("\r\r"));
    line.say("t6811AA\r");
    EXPECT_TRUE(one.hears("t6811AA\r"));
    one.say("t6821BB\r");
    EXPECT_TRUE(line.hears("t6821BB\r"));
}

TEST_F(ServeCan, APathThatExistsIsNamedWithItsOption)
{
    const support::TempDir dir;
    try {
        serve({std::nullopt, dir.path(), std::nullopt});
        FAIL() << "made over a directory";
    } catch (const InputError &e) {
        EXPECT_NE(std::string(e.what()).find("serve: --slcan-pty"), std::string::npos) << e.what();
    }
}

TEST(CanJoin, TwoBusesAreOne)
{
    const Descriptor listener = listen_on_loopback(0);
    f28335::CanBus   bus;
    bus.far_end().close();
    f28335::CanNode &local = bus.join();
    local.open();
    CanJoin    join(bus, port_of(listener));
    Client     other(accept_client(listener));
    long       now    = 0;
    const auto passes = [&] {
        for (int n = 0; n < 50; n++) {
            now += 1500;
            bus.pass(now);
        }
        join.exchange();
    };
    f28335::CanFrame frame;
    frame.id = 0x701;
    local.send(frame);
    passes();
    EXPECT_FALSE(other.hears("t7010\r", 20)) << "before it has joined";
    join.open();
    passes();
    EXPECT_TRUE(other.hears("\rC\rO\r"));
    passes();
    EXPECT_TRUE(other.hears("t7010\r"));
    other.say("\a\r\rz\rt1232A1B2\rT123");
    std::optional<f28335::CanFrame> got;
    for (int n = 0; n < 1000 && !got; n++) {
        passes();
        got = local.take();
    }
    ASSERT_TRUE(got);
    EXPECT_EQ(got->id, 0x123U);
    EXPECT_EQ(got->data[1], 0xB2);
    other = Client(Descriptor());
    EXPECT_THROW(
        {
            for (int n = 0; n < 1000; n++) {
                passes();
                nap();
            }
        },
        InputError);
}

TEST(CanJoin, NobodyThereIsSaid)
{
    f28335::CanBus bus;
    int            port = 0;
    {
        port = port_of(listen_on_loopback(0));
    }
    try {
        const CanJoin join(bus, port);
        FAIL() << "joined to nobody";
    } catch (const InputError &e) {
        EXPECT_EQ(
            std::string(e.what()),
            fmt::format("serve: --join {}: no drive with --slcan-tcp {} answers", port, port));
    }
}
