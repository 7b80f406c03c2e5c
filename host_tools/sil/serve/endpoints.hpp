// SPDX-License-Identifier: MIT
/// Where clients connect: a pseudo-terminal, ports on the loopback interface. POSIX.
#pragma once

#include <string>

#include "sil/served/rtu_frame.hpp"

namespace sdre {

/// A file descriptor that closes itself.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor &&other) noexcept : fd_(other.fd_)
    {
        other.fd_ = -1;
    }
    Descriptor &operator=(Descriptor &&other) noexcept;
    Descriptor(const Descriptor &)            = delete;
    Descriptor &operator=(const Descriptor &) = delete;
    ~Descriptor();

    int get() const
    {
        return fd_;
    }
    explicit operator bool() const
    {
        return fd_ >= 0;
    }

private:
    int fd_ = -1;
};

/// A pseudo-terminal whose other end has a name of the user's: a symbolic link, removed at the end. A link that something
/// else has put in its place stays.
class PseudoTerminal {
public:
    /// InputError when the path exists and is no link of a killed run, or cannot be made.
    /// @param option Name of the command-line option, for the message when the path exists.
    explicit PseudoTerminal(std::string path, const char *option = "--pty");
    PseudoTerminal(PseudoTerminal &&) noexcept            = default;
    PseudoTerminal &operator=(PseudoTerminal &&) noexcept = default;
    ~PseudoTerminal();
    int fd() const
    {
        return master_.get();
    }

private:
    std::string path_;
    std::string name_; ///< the link's target
    Descriptor  master_;
    Descriptor  slave_; ///< held open: the line stays when a client hangs up
};

/// Listens on 127.0.0.1; port 0 takes any.
Descriptor listen_on_loopback(int port);
int        port_of(const Descriptor &listener);
/// Connects to 127.0.0.1; none: nobody listens there.
Descriptor connect_to_loopback(int port);
/// A client, or none.
Descriptor accept_client(const Descriptor &listener);

/// Reads the available octets; false when the other end is gone.
bool read_available(int fd, Octets &into);
/// Writes the octets that the other end accepts now and removes them from `octets`. False when it
/// is gone.
bool write_some(int fd, Octets &octets);

} // namespace sdre
