// SPDX-License-Identifier: MIT
/// Another drive, in a process of its own: the firmware has one state. It goes period by period with the first one.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "served_client.hpp"
#include "sil/f28335/can_frame.hpp"

namespace sdre {

class SecondDrive {
public:
    /// A period brings this to it, or from it.
    struct Parcel {
        int                              frames = 0;
        std::array<f28335::CanFrame, 16> frame{};
        double                           omega_e_radps = 0.0;
        int                              findings      = 0;
    };

    /// Has to come before the first drive: the other process inherits none.
    explicit SecondDrive(std::uint64_t seed)
    {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()) != 0) {
            std::abort();
        }
        child_ = fork();
        if (child_ == 0) {
            close(ends[0]);
            serve(ends[1], seed);
            _exit(0);
        }
        close(ends[1]);
        fd_ = ends[0];
    }
    ~SecondDrive()
    {
        close(fd_); // it ends
        waitpid(child_, nullptr, 0);
    }
    SecondDrive(const SecondDrive &)            = delete;
    SecondDrive &operator=(const SecondDrive &) = delete;

    void hear(const f28335::CanFrame &frame)
    {
        if (go_.frames < static_cast<int>(go_.frame.size())) {
            go_.frame.at(static_cast<std::size_t>(go_.frames++)) = frame;
        }
    }
    /// A period with what it has heard.
    Parcel period()
    {
        Parcel come;
        if (::send(fd_, &go_, sizeof go_, 0) != static_cast<ssize_t>(sizeof go_) ||
            recv(fd_, &come, sizeof come, 0) != static_cast<ssize_t>(sizeof come)) {
            come.findings = 1;
        }
        go_.frames = 0;
        return come;
    }

private:
    static void serve(int fd, std::uint64_t seed)
    {
        ServedBoard drive(shipped_drive(), seed);
        Parcel      go;
        while (recv(fd, &go, sizeof go, 0) == static_cast<ssize_t>(sizeof go)) {
            Parcel come;
            for (int n = 0; n < go.frames; n++) {
                drive.can_bus().far_end().send(go.frame.at(static_cast<std::size_t>(n)));
            }
            drive.period();
            while (come.frames < static_cast<int>(come.frame.size())) {
                const std::optional<f28335::CanFrame> f = drive.can_bus().far_end().take();
                if (!f) {
                    break;
                }
                come.frame.at(static_cast<std::size_t>(come.frames++)) = *f;
            }
            come.omega_e_radps = drive.plant_state().omega_e_radps;
            come.findings      = static_cast<int>(drive.findings().size());
            if (::send(fd, &come, sizeof come, 0) < 0) {
                break;
            }
        }
    }

    pid_t  child_ = -1;
    int    fd_    = -1;
    Parcel go_;
};

} // namespace sdre
