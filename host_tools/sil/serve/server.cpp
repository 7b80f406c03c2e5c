// SPDX-License-Identifier: MIT
#include "sil/serve/server.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <vector>

#include <poll.h>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/serve/boot_rom.hpp"
#include "sil/served/served_f28335.hpp"

namespace sdre {
namespace {

// Chosen: the simulation moves on in steps of this; an operating system wakes a sleeper within as much.
constexpr double slice_s = 1e-3;
// Chosen: a machine that was late by more does not catch up. Otherwise half a second of the drive would pass between two
// octets of a client, and look like a client that has gone.
constexpr double most_late_s = 0.02;
// Chosen: a pause in a client's octets ends a frame. Longer than the line's own 1.75 ms: an operating system may deliver a
// frame in pieces.
constexpr double       frame_pause_s     = 4e-3;
constexpr int          end_check_ms      = 100; // chosen: a person does not notice it
constexpr std::size_t  longest_frame     = 256;
constexpr std::size_t  longest_line      = 4096;
constexpr std::size_t  most_clients      = 32;
constexpr std::size_t  most_unread       = 16'000'000; // chosen: some of the longest traces
constexpr std::uint8_t own_unit          = 1;
constexpr long         own_client        = -2; // the server's own request
constexpr std::uint8_t gateway_busy      = 0x06;
constexpr std::uint8_t no_gateway_answer = 0x0B;

volatile std::sig_atomic_t asked_to_end = 0;

void ask_to_end(int /*signal*/)
{
    asked_to_end = 1;
}

double wall_now_s()
{
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// No command is as long, or has a zero. Whoever looks for a drive here with Modbus/TCP need not wait for an answer.
bool is_text(const Octets &come)
{
    const bool whole = std::find(come.begin(), come.end(), '\n') != come.end();
    const bool zero  = std::find(come.begin(), come.end(), 0) != come.end();
    return whole || (come.size() <= longest_line && !zero);
}

} // namespace

Server::Server(const Drive &drive, std::uint64_t seed, const ServeOptions &options)
    : options_(options), flash_(options.flash),
      drive_(std::make_unique<ServedF28335>(
          drive, Machine{options.machine.value_or(drive), options.cogging_share}, seed,
          flash_.words())),
      pace_(options.speed_factor)
{
    open_all();
}

Server::Server(std::unique_ptr<ServedDrive> drive, const ServeOptions &options)
    : options_(options), flash_(""), drive_(std::move(drive)), pace_(options.speed_factor)
{
    open_all();
}

void Server::open_all()
{
    open(Kind::tcp, options_.tcp);
    open(Kind::rtu, options_.rtu_tcp);
    open(Kind::control, options_.control);
    if (options_.can.any()) {
        can_.emplace(*drive_, options_.can);
    }
    if (!options_.pty.empty()) { // last: a link is made by a run that has everything else
        pty_ = std::make_unique<PseudoTerminal>(options_.pty);
        clients_.emplace(0, Client{Kind::pty, {}, {}, 0.0, {}, 0});
    }
}

void Server::open(Kind kind, std::optional<int> port)
{
    if (port) {
        listeners_.emplace(kind, listen_on_loopback(*port));
    }
}

std::string Server::greeting() const
{
    std::string s = fmt::format("{} on {}, unit 1:\n", drive_->drive().name, drive_->board());
    if (pty_) {
        s += fmt::format("  Modbus RTU       {}\n", options_.pty);
    }
    for (const auto &[kind, listener] : listeners_) {
        const char *name = kind == Kind::tcp   ? "Modbus/TCP    "
                           : kind == Kind::rtu ? "RTU over TCP  "
                                               : "control       ";
        s += fmt::format("  {}   127.0.0.1:{}\n", name, port_of(listener));
    }
    return can_ ? s + can_->greeting() : s;
}

/// When all places are taken, the client that has been quiet for longest goes.
void Server::make_room()
{
    if (clients_.size() < most_clients) {
        return;
    }
    const auto quietest =
        std::min_element(clients_.begin(), clients_.end(), [](const auto &one, const auto &other) {
            const bool line = one.second.kind == Kind::pty;
            return line == (other.second.kind == Kind::pty)
                       ? one.second.last_s < other.second.last_s
                       : !line;
        });
    bus_.forget(quietest->first);
    clients_.erase(quietest);
}

void Server::accept_all(double wall_s)
{
    for (auto &[kind, listener] : listeners_) {
        for (Descriptor client = accept_client(listener); client;
             client            = accept_client(listener)) {
            make_room();
            clients_.emplace(next_client_++, Client{kind, std::move(client), {}, wall_s, {}, 0});
        }
    }
}

/// A frame has ended when its line has been quiet for a while; the firmware checks its content.
void Server::take_frame(long id, Client &client, double wall_s)
{
    const bool quiet = wall_s > client.last_s + frame_pause_s;
    while (!client.come.empty() && (quiet || client.come.size() >= longest_frame)) {
        const auto n   = std::min(client.come.size(), longest_frame);
        const auto end = client.come.begin() + static_cast<std::ptrdiff_t>(n);
        bus_.push({id, 0, own_unit, Octets(client.come.begin(), end)});
        client.come.erase(client.come.begin(), end);
    }
}

void Server::take_requests(long id, Client &client)
{
    bool broken = false;
    while (auto request = take_tcp_request(client.come, broken)) {
        const std::uint8_t unit = request->unit_and_pdu[0];
        if (unit == 0xFF) { // what clients of Modbus/TCP name a device that is alone
            request->unit_and_pdu[0] = own_unit;
        }
        const Octets busy{unit, static_cast<std::uint8_t>(request->unit_and_pdu[1] | 0x80U),
                          gateway_busy};
        if (!bus_.push({id, request->transaction, unit, rtu_frame(request->unit_and_pdu)}) &&
            unit != 0) {
            send(client, tcp_answer(request->transaction, busy));
        }
    }
    if (broken) {
        client.fd = {};
    }
}

/// A client of the control port gets an answer when it has taken the one before.
bool Server::takes_more(const Client &client) const
{
    return client.kind != Kind::control || client.come.size() <= longest_line;
}

ServerReport Server::report() const
{
    const auto tcp = listeners_.find(Kind::tcp);
    return {pace_,
            tcp == listeners_.end() ? std::nullopt : std::optional<int>(port_of(tcp->second))};
}

/// Answers the waiting client whose turn on the control port is longest ago. An answer may take longer than a slice,
/// and Modbus is served in between.
void Server::answer_one_line()
{
    Client *next = nullptr;
    for (auto &[id, client] : clients_) {
        const bool waits =
            client.kind == Kind::control && client.fd && client.go.empty() &&
            std::find(client.come.begin(), client.come.end(), '\n') != client.come.end();
        if (waits && (next == nullptr || client.turn < next->turn)) {
            next = &client;
        }
    }
    if (next == nullptr) {
        return;
    }
    const auto  end = std::find(next->come.begin(), next->come.end(), '\n');
    std::string line(next->come.begin(), end);
    next->come.erase(next->come.begin(), end + 1);
    next->turn = next_turn_++;
    if (!line.empty() && line.back() == '\r') {
        line.pop_back();
    }
    const std::string answer = control_answer(line, *drive_, record_, report());
    send(*next, Octets(answer.begin(), answer.end()));
}

void Server::read_from(long id, Client &client, double wall_s)
{
    const std::size_t before = client.come.size();
    if (takes_more(client) && !read_available(client.fd_of(pty_.get()), client.come) &&
        client.kind != Kind::pty) {
        client.fd = {};
        return;
    }
    write_rest(client);
    client.last_s = client.come.size() > before ? wall_s : client.last_s;
    if (client.kind == Kind::control) {
        if (!is_text(client.come)) {
            client.fd = {};
        }
    } else if (client.kind == Kind::tcp) {
        take_requests(id, client);
    } else {
        take_frame(id, client, wall_s);
    }
}

void Server::read_all(double wall_s)
{
    for (auto at = clients_.begin(); at != clients_.end();) {
        read_from(at->first, at->second, wall_s);
        const bool gone = at->second.kind != Kind::pty && !at->second.fd;
        if (gone) {
            bus_.forget(at->first);
        }
        at = gone ? clients_.erase(at) : std::next(at);
    }
}

void Server::deliver(const BusRequest &request, const Octets &answer)
{
    if (request.client == own_client) {
        node_->answered(answer);
    }
    const auto found = clients_.find(request.client);
    if (found == clients_.end()) {
        return;
    }
    Client &client = found->second;
    Octets  out    = answer;
    if (client.kind == Kind::tcp) {
        std::optional<Octets> content = rtu_content(answer);
        if (!content && request.unit == 0) {
            return; // a broadcast has no answer
        }
        if (!content) {
            content = Octets{request.unit, static_cast<std::uint8_t>(request.frame[1] | 0x80U),
                             no_gateway_answer};
        }
        (*content)[0] = request.unit;
        out           = tcp_answer(request.transaction, *content);
    }
    send(client, out);
}

void Server::send(Client &client, const Octets &octets)
{
    client.go.insert(client.go.end(), octets.begin(), octets.end());
    write_rest(client);
}

/// Writes now what the client accepts, and the rest later. A client that reads nothing is left;
/// read_all() then removes it.
void Server::write_rest(Client &client)
{
    const bool gone = !write_some(client.fd_of(pty_.get()), client.go);
    if (client.kind == Kind::pty) {
        client.go.clear(); // a line does not wait
    } else if (gone || client.go.size() > most_unread) {
        client.fd = {};
    }
}

void Server::run_until(double time_s)
{
    while (drive_->time_s() < time_s) {
        drive_->period();
        record_.note(*drive_);
        bus_.step(*drive_, [this](const BusRequest &r, const Octets &a) { deliver(r, a); });
        step_can();
    }
}

/// The drive gets its number while it is alone, so that another drive is not reset.
void Server::begin_can()
{
    if (options_.node) {
        node_.emplace(*drive_, *options_.node);
        bus_.push({own_client, 0, own_unit, node_->request()});
    } else if (can_) {
        can_->join();
    }
}

void Server::step_can()
{
    if (node_) {
        node_->step();
        if (node_->done()) {
            node_.reset();
            if (can_) {
                can_->join();
            }
        }
    }
    if (can_) {
        can_->step();
    }
}

void Server::wait(double seconds)
{
    std::vector<pollfd> all;
    if (pty_) {
        all.push_back({pty_->fd(), POLLIN, 0});
    }
    for (const auto &[kind, listener] : listeners_) {
        all.push_back({listener.get(), POLLIN, 0});
    }
    for (const auto &[id, client] : clients_) {
        if (client.fd && takes_more(client)) {
            all.push_back({client.fd.get(), POLLIN, 0});
        }
    }
    if (can_) {
        can_->add_to(all);
    }
    const int ms = std::max(static_cast<int>(1e3 * seconds), 1);
    poll(all.data(), all.size(), ms); // early when something has come
}

/// The boot ROM has the line. The firmware starts after it: this device has no processor for the words that were loaded.
void Server::boot()
{
    BootRom rom;
    while (asked_to_end == 0 && !stopped_ && !rom.over()) {
        Octets come;
        Octets go;
        read_available(pty_->fd(), come);
        for (const std::uint8_t octet : come) {
            if (const auto answer = rom.answer(octet)) {
                go.push_back(*answer);
            }
        }
        write_some(pty_->fd(), go);
        pollfd line{pty_->fd(), POLLIN, 0};
        poll(&line, 1, end_check_ms);
    }
    if (rom.over()) {
        fmt::print("{}; the firmware starts\n", rom.said());
        std::fflush(stdout);
    }
}

void Server::run()
{
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGINT, ask_to_end);
    std::signal(SIGTERM, ask_to_end);
    if (options_.boot_rom) {
        boot();
    }
    begin_can();
    double origin_s = wall_now_s() - drive_->time_s() / pace_.speed_factor();
    while (asked_to_end == 0 && !stopped_ &&
           (options_.end_s <= 0.0 || drive_->time_s() < options_.end_s)) {
        const double wall_s   = wall_now_s();
        const double wanted_s = (wall_s - origin_s) * pace_.speed_factor();
        const double late_s   = wanted_s - drive_->time_s() - most_late_s;
        if (late_s > 0.0) {
            origin_s += late_s / pace_.speed_factor();
            pace_.slip(late_s);
        }
        pace_.note(wall_s, drive_->time_s());
        if (pace_.has_become_slow()) {
            fmt::print("slow: {:.2f} s of the drive in a second of the clock; the drive does not "
                       "notice it\n",
                       pace_.real_time_factor());
            std::fflush(stdout);
        }
        accept_all(wall_s);
        read_all(wall_s);
        if (can_) {
            can_->read();
        }
        answer_one_line();
        run_until(std::min(wanted_s, drive_->time_s() + most_late_s));
        flash_.keep();
        wait(slice_s);
    }
}

} // namespace sdre
