// SPDX-License-Identifier: MIT
#include "sil/serve/endpoints.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

constexpr int waiting_clients = 16;

[[noreturn]] void fail(const std::string &what)
{
    throw InputError(fmt::format("serve: {}: {}", what, std::strerror(errno)));
}

void set_non_blocking(int fd)
{
    const int flags = fcntl(fd, F_GETFL);
    if (flags < 0 || fcntl(fd, F_SETFL, flags | O_NONBLOCK) < 0) {
        fail("a descriptor");
    }
}

void set_raw(int fd)
{
    termios t{};
    if (tcgetattr(fd, &t) != 0) {
        fail("the pseudo-terminal");
    }
    cfmakeraw(&t);
    if (tcsetattr(fd, TCSANOW, &t) != 0) {
        fail("the pseudo-terminal");
    }
}

sockaddr_in on_loopback(int port)
{
    sockaddr_in address{};
    address.sin_family      = AF_INET;
    address.sin_port        = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

/// A write goes out at once, and nothing waits for the other end.
void send_at_once(const Descriptor &connection)
{
    const int on = 1;
    set_non_blocking(connection.get());
    setsockopt(connection.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// Target of a symbolic link; empty: the path is none.
std::string link_target(const std::string &path)
{
    std::array<char, 256> target{};
    const ssize_t         n = readlink(path.c_str(), target.data(), target.size());
    return n > 0 ? std::string(target.data(), static_cast<std::size_t>(n)) : std::string();
}

/// A link that a killed run has left: to a pseudo-terminal that is no more.
bool is_left_over(const std::string &path)
{
    struct stat       s {};
    const std::string target = link_target(path);
    return target.rfind("/dev/pts/", 0) == 0 && stat(target.c_str(), &s) != 0;
}

} // namespace

Descriptor &Descriptor::operator=(Descriptor &&other) noexcept
{
    std::swap(fd_, other.fd_);
    return *this;
}

Descriptor::~Descriptor()
{
    if (fd_ >= 0) {
        close(fd_);
    }
}

PseudoTerminal::PseudoTerminal(std::string path, const char *option)
    : path_(std::move(path)), master_(posix_openpt(O_RDWR | O_NOCTTY))
{
    if (!master_ || grantpt(master_.get()) != 0 || unlockpt(master_.get()) != 0) {
        fail("no pseudo-terminal");
    }
    const char *name = ptsname(master_.get());
    slave_           = Descriptor(name != nullptr ? open(name, O_RDWR | O_NOCTTY) : -1);
    if (!slave_) {
        fail("the pseudo-terminal");
    }
    set_raw(slave_.get());
    set_non_blocking(master_.get());
    name_ = name;
    if (is_left_over(path_)) {
        unlink(path_.c_str());
    }
    if (symlink(name, path_.c_str()) != 0) {
        name_.clear(); // the path is not ours
        if (errno == EEXIST) {
            throw InputError(fmt::format("serve: {} {} exists: remove it, or choose another path",
                                         option, path_));
        }
        fail(path_);
    }
}

PseudoTerminal::~PseudoTerminal()
{
    if (master_ && !name_.empty() && link_target(path_) == name_) {
        unlink(path_.c_str());
    }
}

Descriptor listen_on_loopback(int port)
{
    Descriptor listener(socket(AF_INET, SOCK_STREAM, 0));
    const int  on = 1;
    if (!listener || setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0) {
        fail("no socket");
    }
    const sockaddr_in address = on_loopback(port);
    if (bind(listener.get(), reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0 ||
        listen(listener.get(), waiting_clients) != 0) {
        fail(fmt::format("port {}", port));
    }
    set_non_blocking(listener.get());
    return listener;
}

Descriptor connect_to_loopback(int port)
{
    Descriptor        other(socket(AF_INET, SOCK_STREAM, 0));
    const sockaddr_in address = on_loopback(port);
    if (!other ||
        connect(other.get(), reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0) {
        return {};
    }
    send_at_once(other);
    return other;
}

int port_of(const Descriptor &listener)
{
    sockaddr_in address{};
    socklen_t   size = sizeof address;
    if (getsockname(listener.get(), reinterpret_cast<sockaddr *>(&address), &size) != 0) {
        fail("a port");
    }
    return ntohs(address.sin_port);
}

Descriptor accept_client(const Descriptor &listener)
{
    Descriptor client(accept(listener.get(), nullptr, nullptr));
    if (client) {
        send_at_once(client);
    }
    return client;
}

bool read_available(int fd, Octets &into)
{
    std::array<std::uint8_t, 4096> buffer{};
    const ssize_t                  n = read(fd, buffer.data(), buffer.size());
    if (n > 0) {
        into.insert(into.end(), buffer.begin(), buffer.begin() + n);
        return true;
    }
    return n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == EIO);
}

bool write_some(int fd, Octets &octets)
{
    if (octets.empty()) {
        return true;
    }
    const ssize_t n = write(fd, octets.data(), octets.size());
    if (n > 0) {
        octets.erase(octets.begin(), octets.begin() + n);
    }
    return n >= 0 || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == EIO;
}

} // namespace sdre
