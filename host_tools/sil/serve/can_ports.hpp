// SPDX-License-Identifier: MIT
/// Where clients connect to the CAN bus of a served drive: slcan over TCP and on a pseudo-terminal, and the bus of another
/// served drive. POSIX.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <poll.h>

#include "sil/serve/can_join.hpp"
#include "sil/serve/endpoints.hpp"
#include "sil/served/served_drive.hpp"
#include "sil/served/slcan.hpp"

namespace sdre {

struct CanPortOptions {
    std::optional<int> tcp;  ///< port of slcan over TCP; 0: any
    std::string        pty;  ///< path of a pseudo-terminal with slcan; none when empty
    std::optional<int> join; ///< port of another drive's slcan over TCP
    bool               any() const
    {
        return tcp || !pty.empty() || join;
    }
};

class CanPorts {
public:
    /// The bus has only these clients from now on: a drive that nobody listens to gets no acknowledgement.
    CanPorts(ServedDrive &drive, const CanPortOptions &options);

    /// Lines with what a client needs to connect.
    std::string greeting() const;
    /// Takes new clients, and what all have sent. InputError: the other drive is gone.
    void read();
    /// After each control period: the frames that have come for the clients.
    void step();
    /// The other drive's bus is joined from now on; before, the two are apart.
    void join();
    void add_to(std::vector<pollfd> &all) const;
    /// Port of slcan over TCP, which has to be open.
    int tcp_port() const
    {
        return port_of(listener_);
    }

private:
    struct Client {
        Client(f28335::CanBus &bus, Descriptor socket) : fd(std::move(socket)), channel(bus) {}
        Descriptor   fd; ///< not of the pseudo-terminal
        SlcanChannel channel;
        Octets       go; ///< what its connection has not taken yet
    };
    int  fd_of(const Client &client) const;
    bool read_from(Client &client);
    bool write_to(Client &client);

    ServedDrive                    &drive_;
    CanPortOptions                  options_;
    Descriptor                      listener_;
    std::unique_ptr<PseudoTerminal> pty_;
    std::unique_ptr<CanJoin>        join_;
    std::list<Client>               clients_;
};

} // namespace sdre
