// SPDX-License-Identifier: MIT
/// A Cortex-M4F that runs a program instruction by instruction. Unicorn translates the instructions; exceptions, cycles and
/// the system control space are here.
///
/// Unicorn is under the GPL, version 2. Only programs of the tests link it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <unicorn/unicorn.h>

#include "cycle_table.hpp"
#include "elf_image.hpp"
#include "exceptions.hpp"

namespace iss {

std::string hex(std::uint32_t value);

class MemoryGuard {
public:
    MemoryGuard()                               = default;
    MemoryGuard(const MemoryGuard &)            = delete;
    MemoryGuard &operator=(const MemoryGuard &) = delete;
    virtual ~MemoryGuard()                      = default;
    virtual void before_write(std::uint32_t address, unsigned octets, std::uint32_t value) = 0;
    /// Only around the addresses of watch_reads().
    virtual void before_read(std::uint32_t address)
    {
        (void)address;
    }
};

/// Told when a handler begins and ends: the way to it and back is a part of it.
class HandlerWatch {
public:
    HandlerWatch()                                          = default;
    HandlerWatch(const HandlerWatch &)                      = delete;
    HandlerWatch &operator=(const HandlerWatch &)           = delete;
    virtual ~HandlerWatch()                                 = default;
    virtual void begins(int exception, std::uint64_t cycle) = 0;
    virtual void ends(int exception, std::uint64_t cycle)   = 0;
    /// A block begins; only while watch_blocks() is on.
    virtual void block(std::uint32_t address, std::uint32_t octets, const BlockCost &cost)
    {
        (void)address;
        (void)octets;
        (void)cost;
    }
};

class Core {
public:
    Core();
    Core(const Core &)            = delete;
    Core &operator=(const Core &) = delete;
    ~Core();

    /// Multiples of 4 KB.
    void add_memory(std::uint32_t base, std::uint32_t octets, bool writable);
    void add_device(std::uint32_t base, std::uint32_t octets, Device &device);
    /// Memory of which every write is told before it happens.
    void add_guarded_memory(std::uint32_t base, std::uint32_t octets, MemoryGuard &guard);
    /// The guard is told of reads too, from now on, in the 4 KB around this address.
    void watch_reads(std::uint32_t address);
    /// Into memory, as a programming tool writes it.
    void load(const ElfImage &image);
    /// Stack pointer and program counter from the table of vectors.
    void reset(std::uint32_t vectors);

    /// Until so many cycles have passed, or a device has called stop(), or the program cannot go on. Blocks are whole: it
    /// ends up to a block late, and an interrupt comes up to a block late.
    void run_until(std::uint64_t cycles);
    void stop();
    /// The core waits for a memory.
    void wait(std::uint64_t cycles)
    {
        cycles_ += cycles;
    }

    std::uint64_t cycles() const
    {
        return cycles_;
    }
    std::uint64_t instructions() const
    {
        return instructions_;
    }
    std::uint64_t idle_cycles() const ///< slept
    {
        return idle_cycles_;
    }
    bool halted() const ///< by a fault in the handler of faults
    {
        return halted_;
    }
    Exceptions &exceptions()
    {
        return exceptions_;
    }
    void watch_handlers(HandlerWatch *watch) ///< nullptr: nobody
    {
        watch_ = watch;
    }
    void watch_blocks(bool on)
    {
        watch_blocks_ = on;
    }
    /// As if the program had masked them now.
    void mask_interrupts();
    /// The instruction there becomes a branch to itself, until a reset.
    void          hang_at(std::uint32_t address);
    std::uint32_t word(std::uint32_t address) const;
    void          read_octets(std::uint32_t address, void *to, std::size_t count) const;
    void          set_word(std::uint32_t address, std::uint32_t value);
    void          set_octets(std::uint32_t address, const std::vector<std::uint8_t> &octets);
    std::uint32_t program_counter() const;
    /// As if the program had used all of its stack down to this address.
    void fill_stack_to(std::uint32_t address);

    /// Lines that each tell what no program should do, and this one did.
    const std::vector<std::string> &findings() const
    {
        return findings_;
    }
    void find(const std::string &line);

private:
    struct Mapped {
        Core   *core;
        Device *device;
    };
    struct Known {
        std::uint32_t address = 0;
        std::uint32_t octets  = 0;
        BlockCost     cost;
    };

    static void on_block(uc_engine *uc, std::uint64_t address, std::uint32_t octets, void *core);
    static void on_interrupt(uc_engine *uc, std::uint32_t number, void *core);
    static bool on_invalid(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                           std::int64_t value, void *core);
    static bool on_guarded(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                           std::int64_t value, void *guard);
    static bool on_watched(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                           std::int64_t value, void *guard);
    static void on_stack_guard(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                               std::int64_t value, void *core);
    static std::uint64_t on_read(uc_engine *uc, std::uint64_t offset, unsigned octets,
                                 void *mapped);
    static void on_write(uc_engine *uc, std::uint64_t offset, unsigned octets, std::uint64_t value,
                         void *mapped);

    void             begin_block(std::uint32_t address, std::uint32_t octets);
    void             change_code(std::uint32_t address, const std::vector<std::uint8_t> &octets);
    const BlockCost &cost(std::uint32_t address, std::uint32_t octets);
    void             watch_stack_guard();
    void             execute();
    void             sleep();
    void             take_exceptions();
    void             enter(int exception);
    void             leave();
    void             fault(const std::string &why);
    Masks            masks() const;
    std::uint32_t    get(int reg) const;
    void             put(int reg, std::uint32_t value);
    void             push(std::uint32_t value);
    std::uint32_t    pop();

    enum class End { asked, slept, returned, failed };

    uc_engine                           *uc_     = nullptr;
    std::uint64_t                        cycles_ = 0;
    Exceptions                           exceptions_{cycles_};
    std::vector<std::unique_ptr<Mapped>> mapped_;
    std::vector<Known>                   known_; // blocks, by their address
    std::uint64_t                        idle_cycles_  = 0;
    std::uint64_t                        instructions_ = 0;
    std::uint64_t                        until_        = 0;
    HandlerWatch                        *watch_        = nullptr;
    bool                                 watch_blocks_ = false;
    std::uint32_t                        after_        = 0; // what follows the last block in memory
    std::uint32_t not_taken_ = 0; // its cost is less by this, if that comes next
    End           end_       = End::asked;
    bool          stop_      = false;
    bool          sleeps_    = false;
    bool          halted_    = false;
    std::string   why_;
    std::uint32_t hangs_at_ = 0;                            // 0: nowhere
    std::pair<std::uint32_t, std::uint32_t> guarded_{0, 0}; // by guard_hook_
    uc_hook                                 guard_hook_ = 0;
    std::vector<std::uint8_t>               hangs_in_place_of_;
    std::vector<std::string>                findings_;
};

} // namespace iss
