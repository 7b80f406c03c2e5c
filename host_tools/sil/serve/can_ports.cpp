// SPDX-License-Identifier: MIT
#include "sil/serve/can_ports.hpp"

#include <fmt/format.h>

namespace sdre {
namespace {

constexpr std::size_t most_clients = 32;
constexpr std::size_t most_unread  = 1'000'000; // chosen: seconds of a full bus

} // namespace

CanPorts::CanPorts(ServedDrive &drive, const CanPortOptions &options)
    : drive_(drive), options_(options)
{
    if (options.tcp) {
        listener_ = listen_on_loopback(*options.tcp);
    }
    if (options.join) {
        join_ = std::make_unique<CanJoin>(drive.can_bus(), *options.join);
    }
    if (!options.pty.empty()) { // last: a link is made by a run that has everything else
        pty_ = std::make_unique<PseudoTerminal>(options.pty, "--slcan-pty");
        clients_.emplace_back(drive.can_bus(), Descriptor());
    }
    drive.can_bus().far_end().close();
}

std::string CanPorts::greeting() const
{
    std::string s;
    if (listener_) {
        s += fmt::format("  CAN, slcan       127.0.0.1:{}\n", port_of(listener_));
    }
    if (pty_) {
        s += fmt::format("  CAN, slcan       {}\n", options_.pty);
    }
    if (join_) {
        s += fmt::format("  on the CAN bus of the drive at 127.0.0.1:{}\n", *options_.join);
    }
    return s;
}

int CanPorts::fd_of(const Client &client) const
{
    return client.fd ? client.fd.get() : pty_->fd();
}

/// False: the client is gone. A pseudo-terminal stays.
bool CanPorts::read_from(Client &client)
{
    Octets     come;
    const bool there = read_available(fd_of(client), come);
    client.channel.take(come, client.go);
    return write_to(client) && (there || !client.fd);
}

bool CanPorts::write_to(Client &client)
{
    const bool there = write_some(fd_of(client), client.go);
    if (!client.fd) {
        client.go.clear(); // a line does not wait
        return true;
    }
    return there && client.go.size() <= most_unread;
}

void CanPorts::read()
{
    if (listener_) {
        for (Descriptor client = accept_client(listener_); client;
             client            = accept_client(listener_)) {
            if (clients_.size() < most_clients) { // one more is turned away
                clients_.emplace_back(drive_.can_bus(), std::move(client));
            }
        }
    }
    clients_.remove_if([this](Client &client) { return !read_from(client); });
    if (join_) {
        join_->exchange();
    }
}

void CanPorts::step()
{
    for (Client &client : clients_) {
        client.channel.collect(drive_.time_s(), client.go);
    }
    clients_.remove_if([this](Client &client) { return !client.go.empty() && !write_to(client); });
    if (join_) {
        join_->exchange();
    }
}

void CanPorts::join()
{
    if (join_) {
        join_->open();
    }
}

void CanPorts::add_to(std::vector<pollfd> &all) const
{
    if (listener_) {
        all.push_back({listener_.get(), POLLIN, 0});
    }
    for (const Client &client : clients_) {
        all.push_back({fd_of(client), POLLIN, 0});
    }
    if (join_) {
        all.push_back({join_->fd(), POLLIN, 0});
    }
}

} // namespace sdre
