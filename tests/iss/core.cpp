// SPDX-License-Identifier: MIT
#include "core.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

// Unicorn 2.0 looks at each store for translated code in the same page, which takes half the time of a run. Memory that a
// program can write has no code here, see add_memory(): these take the place of Unicorn's own functions.
extern "C" {
void *page_collection_lock_arm(void *engine, std::uint64_t start, std::uint64_t end);
void  page_collection_unlock_arm(void *pages);
void  tb_invalidate_phys_page_fast_arm(void *engine, void *pages, std::uint64_t start, int octets,
                                       std::uintptr_t from);

void *page_collection_lock_arm(void * /*engine*/, std::uint64_t /*start*/, std::uint64_t /*end*/)
{
    return nullptr;
}

void page_collection_unlock_arm(void * /*pages*/) {}

void tb_invalidate_phys_page_fast_arm(void * /*engine*/, void * /*pages*/, std::uint64_t /*start*/,
                                      int /*octets*/, std::uintptr_t /*from*/)
{
}
}

namespace iss {
namespace {

constexpr std::uint32_t system_space  = 0xE000E000;
constexpr std::uint32_t nowhere       = 0xF0000000; // no program runs to this address
constexpr std::uint32_t returns       = 0xFFFFFF00; // addresses from here on end a handler
constexpr std::uint32_t thumb         = 1;
constexpr std::uint32_t state_thumb   = 0x01000000; // of XPSR
constexpr std::uint32_t state_aligned = 0x00000200;
constexpr std::uint32_t state_number  = 0x000001FF;
constexpr std::uint32_t fpu_in_use    = 4; // CONTROL.FPCA
constexpr std::uint32_t no_fpu_frame  = 0x10;
constexpr std::uint32_t to_thread     = 0x08;
constexpr std::uint32_t entry_cycles =
    12; // ARM DDI 0439, 3.9: with memory that does not wait, as the next
constexpr std::uint32_t exit_cycles   = 10;
constexpr std::size_t   blocks_known  = 1U << 14U;
constexpr std::uint32_t watched       = 4096;
constexpr std::size_t   findings_most = 100;

constexpr std::uint32_t exit_number =
    8; // of UC_HOOK_INTR: an address above `returns` was branched to
constexpr std::uint32_t call_number = 2; // SVC

constexpr std::array<int, 4> scratch{UC_ARM_REG_R0, UC_ARM_REG_R1, UC_ARM_REG_R2, UC_ARM_REG_R3};

void need(uc_err error)
{
    if (error != UC_ERR_OK) {
        throw std::runtime_error(std::string("Unicorn: ") + uc_strerror(error));
    }
}

} // namespace

std::string hex(std::uint32_t value)
{
    std::array<char, 12> text{};
    std::snprintf(text.data(), text.size(), "%08Xh", value);
    return text.data();
}

Core::Core() : known_(blocks_known)
{
    need(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &uc_));
    need(uc_ctl_set_cpu_model(uc_, UC_CPU_ARM_CORTEX_M4));
    uc_hook hook = 0;
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the library takes any function so
    need(uc_hook_add(uc_, &hook, UC_HOOK_BLOCK, reinterpret_cast<void *>(&on_block), this, 1, 0));
    need(
        uc_hook_add(uc_, &hook, UC_HOOK_INTR, reinterpret_cast<void *>(&on_interrupt), this, 1, 0));
    need(uc_hook_add(uc_, &hook, UC_HOOK_MEM_INVALID, reinterpret_cast<void *>(&on_invalid), this,
                     1, 0));
    // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
    add_device(system_space, 0x1000, exceptions_);
}

Core::~Core()
{
    uc_close(uc_);
}

void Core::add_memory(std::uint32_t base, std::uint32_t octets, bool writable)
{
    need(uc_mem_map(uc_, base, octets, UC_PROT_READ | (writable ? UC_PROT_WRITE : UC_PROT_EXEC)));
}

void Core::add_device(std::uint32_t base, std::uint32_t octets, Device &device)
{
    mapped_.push_back(std::make_unique<Mapped>(Mapped{this, &device}));
    need(uc_mmio_map(uc_, base, octets, &on_read, mapped_.back().get(), &on_write,
                     mapped_.back().get()));
}

void Core::add_guarded_memory(std::uint32_t base, std::uint32_t octets, MemoryGuard &guard)
{
    add_memory(base, octets, false);
    uc_hook hook = 0;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as above
    need(uc_hook_add(uc_, &hook, UC_HOOK_MEM_WRITE_PROT, reinterpret_cast<void *>(&on_guarded),
                     &guard, base, base + octets - 1U));
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as above
    need(uc_hook_add(uc_, &hook, UC_HOOK_MEM_READ_PROT, reinterpret_cast<void *>(&on_watched),
                     &guard, base, base + octets - 1U));
}

void Core::watch_reads(std::uint32_t address)
{
    need(uc_mem_protect(uc_, address & ~(watched - 1U), watched, UC_PROT_EXEC));
}

bool Core::on_watched(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                      std::int64_t value, void *guard)
{
    (void)uc;
    (void)type;
    (void)octets;
    (void)value;
    static_cast<MemoryGuard *>(guard)->before_read(static_cast<std::uint32_t>(address));
    return true; // the library reads
}

bool Core::on_guarded(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                      std::int64_t value, void *guard)
{
    (void)type;
    static_cast<MemoryGuard *>(guard)->before_write(static_cast<std::uint32_t>(address),
                                                    static_cast<unsigned>(octets),
                                                    static_cast<std::uint32_t>(value));
    need(uc_mem_write(uc, address, &value, static_cast<std::size_t>(octets)));
    return true; // the library itself writes nothing
}

void Core::load(const ElfImage &image)
{
    for (const ElfSegment &s : image.segments) {
        set_octets(s.address, s.octets);
    }
}

void Core::set_octets(std::uint32_t address, const std::vector<std::uint8_t> &octets)
{
    need(uc_mem_write(uc_, address, octets.data(), octets.size()));
}

void Core::read_octets(std::uint32_t address, void *to, std::size_t count) const
{
    need(uc_mem_read(uc_, address, to, count));
}

void Core::reset(std::uint32_t vectors)
{
    if (hangs_at_ != 0U) {
        change_code(hangs_at_, hangs_in_place_of_);
        hangs_at_ = 0;
    }
    exceptions_.reset(vectors);
    put(UC_ARM_REG_XPSR, state_thumb);
    put(UC_ARM_REG_CONTROL, 0);
    put(UC_ARM_REG_PRIMASK, 0);
    put(UC_ARM_REG_BASEPRI, 0);
    put(UC_ARM_REG_FAULTMASK, 0);
    put(UC_ARM_REG_SP, word(vectors));
    put(UC_ARM_REG_PC, word(vectors + 4U) & ~thumb);
    sleeps_ = false;
    halted_ = false;
}

std::uint32_t Core::get(int reg) const
{
    std::uint32_t value = 0;
    need(uc_reg_read(uc_, reg, &value));
    return value;
}

void Core::put(int reg, std::uint32_t value)
{
    need(uc_reg_write(uc_, reg, &value));
}

std::uint32_t Core::word(std::uint32_t address) const
{
    std::uint32_t value = 0;
    need(uc_mem_read(uc_, address, &value, sizeof value));
    return value;
}

void Core::set_word(std::uint32_t address, std::uint32_t value)
{
    need(uc_mem_write(uc_, address, &value, sizeof value));
}

void Core::mask_interrupts()
{
    put(UC_ARM_REG_PRIMASK, 1);
}

void Core::hang_at(std::uint32_t address)
{
    hangs_at_ = address & ~thumb;
    hangs_in_place_of_.resize(2);
    read_octets(hangs_at_, hangs_in_place_of_.data(), hangs_in_place_of_.size());
    change_code(hangs_at_, {0xFE, 0xE7});
}

void Core::change_code(std::uint32_t address, const std::vector<std::uint8_t> &octets)
{
    set_octets(address, octets);
    need(uc_ctl_flush_tlb(uc_)); // of translated code
    known_.assign(blocks_known, Known{});
}

std::uint32_t Core::program_counter() const
{
    return get(UC_ARM_REG_PC);
}

void Core::find(const std::string &line)
{
    if (findings_.size() < findings_most) {
        findings_.push_back(line);
    }
}

// -- hooks --

void Core::on_block(uc_engine *uc, std::uint64_t address, std::uint32_t octets, void *core)
{
    (void)uc;
    static_cast<Core *>(core)->begin_block(static_cast<std::uint32_t>(address), octets);
}

void Core::on_interrupt(uc_engine *uc, std::uint32_t number, void *core)
{
    auto *const c = static_cast<Core *>(core);
    if (number == exit_number) {
        c->end_ = End::returned;
    } else if (number == call_number) {
        c->exceptions_.pend(exception_sv_call);
        c->end_ = End::asked;
    } else {
        c->why_ = "exception " + std::to_string(number) + " of the core";
        c->end_ = End::failed;
    }
    uc_emu_stop(uc);
}

bool Core::on_invalid(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                      std::int64_t value, void *core)
{
    (void)uc;
    (void)octets;
    (void)value;
    const bool  writes = type == UC_MEM_WRITE_UNMAPPED || type == UC_MEM_WRITE_PROT;
    const bool  runs   = type == UC_MEM_FETCH_UNMAPPED || type == UC_MEM_FETCH_PROT;
    auto *const c      = static_cast<Core *>(core);
    c->why_            = std::string(writes ? "write to "
                                     : runs ? "jump to "
                                            : "read from ") +
              hex(static_cast<std::uint32_t>(address));
    c->end_ = End::failed;
    return false;
}

std::uint64_t Core::on_read(uc_engine *uc, std::uint64_t offset, unsigned octets, void *mapped)
{
    (void)uc;
    return static_cast<Mapped *>(mapped)->device->read(static_cast<std::uint32_t>(offset), octets);
}

void Core::on_write(uc_engine *uc, std::uint64_t offset, unsigned octets, std::uint64_t value,
                    void *mapped)
{
    (void)uc;
    const auto *const m = static_cast<Mapped *>(mapped);
    m->device->write(static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(value), octets);
    if (m->core->exceptions_.guarded() != m->core->guarded_) {
        m->core->stop(); // before the next block, so that the guard is watched
    }
}

// -- running --

const BlockCost &Core::cost(std::uint32_t address, std::uint32_t octets)
{
    Known &k = known_[(address >> 1U) % blocks_known];
    if (k.address != address || k.octets != octets) {
        std::vector<std::uint8_t> code(octets);
        need(uc_mem_read(uc_, address, code.data(), code.size()));
        k = {address, octets, cost_of(code.data(), code.size())};
    }
    return k.cost;
}

void Core::begin_block(std::uint32_t address, std::uint32_t octets)
{
    const bool due = stop_ || cycles_ >= until_ || exceptions_.wants_reset() ||
                     (exceptions_.any_pending() && exceptions_.next(masks()) != 0);
    if (due) {
        end_ = End::asked;
        uc_emu_stop(uc_); // before the block
        return;
    }
    const BlockCost &c = cost(address, octets);
    cycles_ += c.cycles;
    cycles_ -= address == after_ ? not_taken_ : 0U;
    after_     = address + octets;
    not_taken_ = c.not_taken;
    instructions_ += c.instructions;
    if (watch_blocks_) {
        watch_->block(address, octets, c);
    }
    if (c.uses_fpu && !exceptions_.fpu_enabled()) {
        why_ = "an instruction of the FPU, which CPACR has not enabled, in the block at " +
               hex(address);
        end_ = End::failed;
        uc_emu_stop(uc_);
    }
}

Masks Core::masks() const
{
    return {(get(UC_ARM_REG_PRIMASK) & 1U) != 0U, (get(UC_ARM_REG_FAULTMASK) & 1U) != 0U,
            get(UC_ARM_REG_BASEPRI) & 0xFFU};
}

void Core::stop()
{
    stop_ = true;
}

void Core::run_until(std::uint64_t cycles)
{
    until_ = cycles;
    stop_  = false;
    while (cycles_ < until_ && !stop_ && !halted_ && !exceptions_.wants_reset()) {
        if (sleeps_) {
            sleep();
        }
        if (!sleeps_) {
            take_exceptions();
            execute();
        }
    }
    if (halted_ && cycles_ < until_) {
        cycles_ = until_;
    }
}

void Core::sleep()
{
    sleeps_ = !exceptions_.wakes(masks());
    if (sleeps_) {
        idle_cycles_ += until_ - cycles_;
        cycles_ = until_;
    }
}

/// The region of the MPU that nobody may touch. Only writes are looked at.
void Core::watch_stack_guard()
{
    if (exceptions_.guarded() == guarded_) {
        return;
    }
    if (guard_hook_ != 0) {
        need(uc_hook_del(uc_, guard_hook_));
        guard_hook_ = 0;
    }
    guarded_ = exceptions_.guarded();
    if (guarded_.first != guarded_.second) {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as above
        need(uc_hook_add(uc_, &guard_hook_, UC_HOOK_MEM_WRITE,
                         reinterpret_cast<void *>(&on_stack_guard), this, guarded_.first,
                         guarded_.second - 1U));
        need(uc_ctl_flush_tlb(uc_)); // code that was translated before does not ask
    }
}

void Core::on_stack_guard(uc_engine *uc, uc_mem_type type, std::uint64_t address, int octets,
                          std::int64_t value, void *core)
{
    (void)type;
    (void)octets;
    (void)value;
    auto *const c = static_cast<Core *>(core);
    c->why_ = "write to " + hex(static_cast<std::uint32_t>(address)) + ", which the MPU guards";
    c->end_ = End::failed;
    uc_emu_stop(uc);
}

void Core::fill_stack_to(std::uint32_t address)
{
    put(UC_ARM_REG_SP, address);
}

void Core::execute()
{
    watch_stack_guard();
    end_               = End::slept; // unless a hook knows better
    const uc_err error = uc_emu_start(uc_, get(UC_ARM_REG_PC) | thumb, nowhere, 0, 0);
    if (error != UC_ERR_OK && end_ != End::failed) {
        why_ = uc_strerror(error);
        end_ = End::failed;
    }
    if (end_ == End::failed) {
        fault(why_);
    } else if (end_ == End::returned) {
        leave();
    } else {
        sleeps_ = end_ == End::slept;
    }
}

void Core::fault(const std::string &why)
{
    find(why + ", at " + hex(get(UC_ARM_REG_PC)));
    if (exceptions_.is_active(exception_hard_fault)) {
        halted_ = true;
    } else {
        exceptions_.pend(exception_hard_fault);
    }
}

// -- exceptions: ARMv7-M, B1.5 --

void Core::take_exceptions()
{
    if (exceptions_.any_pending()) {
        const int next = exceptions_.next(masks());
        if (next != 0) {
            enter(next);
        }
    }
}

void Core::push(std::uint32_t value)
{
    const std::uint32_t sp = get(UC_ARM_REG_SP) - 4U;
    put(UC_ARM_REG_SP, sp);
    if (uc_mem_write(uc_, sp, &value, sizeof value) != UC_ERR_OK) {
        halted_ = true;
        find("no memory for the stack at " + hex(sp));
    }
}

std::uint32_t Core::pop()
{
    const std::uint32_t sp    = get(UC_ARM_REG_SP);
    std::uint32_t       value = 0;
    if (uc_mem_read(uc_, sp, &value, sizeof value) != UC_ERR_OK) {
        halted_ = true;
        find("no memory for the stack at " + hex(sp));
    }
    put(UC_ARM_REG_SP, sp + 4U);
    return value;
}

void Core::enter(int exception)
{
    const std::uint32_t state   = get(UC_ARM_REG_XPSR);
    const bool          handler = (state & state_number) != 0U;
    const std::uint32_t control = get(UC_ARM_REG_CONTROL);
    const bool          fpu     = (control & fpu_in_use) != 0U;
    const bool          odd     = (get(UC_ARM_REG_SP) & 4U) != 0U;
    if (odd) {
        put(UC_ARM_REG_SP, get(UC_ARM_REG_SP) - 4U);
    }
    if (fpu) {
        push(0);
        push(get(UC_ARM_REG_FPSCR));
        for (int n = 15; n >= 0; n--) {
            push(get(UC_ARM_REG_S0 + n));
        }
    }
    push((state & ~state_aligned) | (odd ? state_aligned : 0U));
    push(get(UC_ARM_REG_PC));
    push(get(UC_ARM_REG_LR));
    push(get(UC_ARM_REG_R12));
    for (int n = 3; n >= 0; n--) {
        push(get(scratch.at(static_cast<std::size_t>(n))));
    }
    exceptions_.enter(exception);
    if (watch_ != nullptr) {
        watch_->begins(exception, cycles_);
    }
    put(UC_ARM_REG_LR, 0xFFFFFFE1U | (fpu ? 0U : no_fpu_frame) | (handler ? 0U : to_thread));
    put(UC_ARM_REG_CONTROL, control & ~fpu_in_use);
    put(UC_ARM_REG_XPSR, state_thumb | static_cast<std::uint32_t>(exception));
    put(UC_ARM_REG_PC, word(exceptions_.vector_of(exception)) & ~thumb);
    cycles_ += entry_cycles;
    sleeps_ = false;
}

void Core::leave()
{
    const std::uint32_t kind  = get(UC_ARM_REG_PC) | thumb;
    const std::uint32_t state = get(UC_ARM_REG_XPSR);
    if (kind < returns || (state & state_number) == 0U) {
        fault("return from no handler");
        return;
    }
    exceptions_.leave(static_cast<int>(state & state_number));
    for (const int reg : scratch) {
        put(reg, pop());
    }
    put(UC_ARM_REG_R12, pop());
    put(UC_ARM_REG_LR, pop());
    const std::uint32_t counter = pop();
    const std::uint32_t old     = pop();
    const bool          fpu     = (kind & no_fpu_frame) == 0U;
    if (fpu) {
        for (int n = 0; n < 16; n++) {
            put(UC_ARM_REG_S0 + n, pop());
        }
        put(UC_ARM_REG_FPSCR, pop());
        (void)pop();
    }
    if ((old & state_aligned) != 0U) {
        put(UC_ARM_REG_SP, get(UC_ARM_REG_SP) + 4U);
    }
    const std::uint32_t control = get(UC_ARM_REG_CONTROL) & ~fpu_in_use;
    put(UC_ARM_REG_CONTROL, control | (fpu ? fpu_in_use : 0U));
    put(UC_ARM_REG_FAULTMASK, 0);
    put(UC_ARM_REG_XPSR, old & ~state_aligned);
    put(UC_ARM_REG_PC, counter & ~thumb);
    cycles_ += exit_cycles;
    if (watch_ != nullptr) {
        watch_->ends(static_cast<int>(state & state_number), cycles_);
    }
}

} // namespace iss
