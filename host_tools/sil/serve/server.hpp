// SPDX-License-Identifier: MIT
/// Serves a drive to Modbus clients, in real time.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "sil/serve/can_ports.hpp"
#include "sil/serve/endpoints.hpp"
#include "sil/serve/flash_file.hpp"
#include "sil/served/control.hpp"
#include "sil/served/node_number.hpp"
#include "sil/served/serial_bus.hpp"

namespace sdre {

struct ServeOptions {
    std::string          pty;     ///< path of the pseudo-terminal; none when empty
    std::optional<int>   tcp;     ///< port of Modbus/TCP
    std::optional<int>   rtu_tcp; ///< port of RTU frames over TCP
    std::optional<int>   control; ///< port of control.hpp's commands
    std::optional<Drive> machine; ///< motor and disc on the bench; the drive's own when not given
    double               cogging_share = 0.0; ///< of the machine, as in Machine
    std::string          flash;               ///< file that keeps the flash; none when empty
    CanPortOptions       can;
    std::optional<int>
           node; ///< of this drive on the CAN bus, 1 .. 127; as the firmware has it when not given
    double speed_factor = 1.0;
    double end_s        = 0.0; ///< simulated time after which it ends; 0: never
    bool   boot_rom =
        false; ///< the pseudo-terminal is first the boot ROM's, until it has loaded a program
};

class Server {
public:
    /// The firmware on the virtual F28335.
    Server(const Drive &drive, std::uint64_t seed, const ServeOptions &options);
    /// A drive of another board: without a file for its flash, without a boot ROM.
    Server(std::unique_ptr<ServedDrive> drive, const ServeOptions &options);

    /// Lines with everything that a person needs to connect.
    std::string greeting() const;
    /// Runs until a signal, stop(), or the end of the time.
    void run();
    /// From any thread.
    void stop()
    {
        stopped_ = true;
    }
    /// Port of Modbus/TCP, which has to be open.
    int tcp_port() const
    {
        return port_of(listeners_.at(Kind::tcp));
    }
    /// Port of slcan over TCP, which has to be open.
    int can_port() const
    {
        return can_->tcp_port();
    }

private:
    enum class Kind { pty, rtu, tcp, control };
    struct Client {
        Kind       kind;
        Descriptor fd; ///< not of the pseudo-terminal
        Octets     come;
        double     last_s = 0.0; ///< when something came last, or when it was accepted
        Octets     go;           ///< what its connection has not taken yet
        long       turn = 0;     ///< number of its last answer on the control port
        int        fd_of(const PseudoTerminal *pty) const
        {
            return kind == Kind::pty ? pty->fd() : fd.get();
        }
    };

    void         open(Kind kind, std::optional<int> port);
    void         open_all();
    void         accept_all(double wall_s);
    void         make_room();
    void         read_all(double wall_s);
    void         read_from(long id, Client &client, double wall_s);
    void         take_frame(long id, Client &client, double wall_s);
    void         take_requests(long id, Client &client);
    bool         takes_more(const Client &client) const;
    ServerReport report() const;
    void         answer_one_line();
    void         send(Client &client, const Octets &octets);
    void         write_rest(Client &client);
    void         deliver(const BusRequest &request, const Octets &answer);
    void         begin_can();
    void         step_can();
    void         boot();
    void         run_until(double time_s);
    void         wait(double seconds);

    ServeOptions                    options_;
    FlashFile                       flash_;
    std::unique_ptr<ServedDrive>    drive_;
    MotorRecord                     record_;
    SerialBus                       bus_;
    Pace                            pace_;
    std::optional<CanPorts>         can_;
    std::optional<NodeNumber>       node_;
    std::unique_ptr<PseudoTerminal> pty_;
    std::map<Kind, Descriptor>      listeners_;
    std::map<long, Client>          clients_;
    long                            next_client_ = 1;
    long                            next_turn_   = 1;
    std::atomic<bool>               stopped_{false};
};

} // namespace sdre
