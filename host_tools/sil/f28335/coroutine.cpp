// SPDX-License-Identifier: MIT
#include "sil/f28335/coroutine.hpp"

#include <cstdint>
#include <utility>

#if defined(__SANITIZE_ADDRESS__)
#define SDRE_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SDRE_ASAN 1
#endif
#endif

#ifdef SDRE_ASAN
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace sdre::f28335 {
namespace {

// Chosen: the firmware needs below 1 kB on its target; the rest is for the sanitizers' frames.
constexpr std::size_t stack_bytes = 256 * 1024;

void start_switch(void **own_fake_stack, const void *to_stack, std::size_t to_bytes)
{
#ifdef SDRE_ASAN
    __sanitizer_start_switch_fiber(own_fake_stack, to_stack, to_bytes);
#else
    (void)own_fake_stack;
    (void)to_stack;
    (void)to_bytes;
#endif
}

void finish_switch(void *own_fake_stack, const void **from_stack, std::size_t *from_bytes)
{
#ifdef SDRE_ASAN
    __sanitizer_finish_switch_fiber(own_fake_stack, from_stack, from_bytes);
#else
    (void)own_fake_stack;
    (void)from_stack;
    (void)from_bytes;
#endif
}

} // namespace

Coroutine::Coroutine(std::function<void()> body) : body_(std::move(body)), stack_(stack_bytes)
{
    getcontext(&self_);
    self_.uc_stack.ss_sp   = stack_.data();
    self_.uc_stack.ss_size = stack_.size();
    self_.uc_link          = nullptr;
    const auto self        = reinterpret_cast<std::uintptr_t>(this);
    // makecontext passes int-sized arguments only.
    makecontext(&self_, reinterpret_cast<void (*)()>(&Coroutine::entry), 2,
                static_cast<unsigned>(static_cast<std::uint64_t>(self) >> 32U),
                static_cast<unsigned>(self & 0xFFFFFFFFU));
}

void Coroutine::entry(unsigned high, unsigned low)
{
    const std::uint64_t self = (static_cast<std::uint64_t>(high) << 32U) | low;
    reinterpret_cast<Coroutine *>(static_cast<std::uintptr_t>(self))->run();
}

void Coroutine::run()
{
    finish_switch(nullptr, &caller_stack_, &caller_stack_bytes_);
    body_();
    finished_ = true;
    start_switch(nullptr, caller_stack_, caller_stack_bytes_); // nullptr: this stack is done with
    setcontext(&caller_);
}

void Coroutine::resume()
{
    if (finished_) {
        return;
    }
    start_switch(&caller_fake_stack_, stack_.data(), stack_.size());
    swapcontext(&caller_, &self_);
    finish_switch(caller_fake_stack_, nullptr, nullptr);
}

void Coroutine::suspend()
{
    start_switch(&self_fake_stack_, caller_stack_, caller_stack_bytes_);
    swapcontext(&self_, &caller_);
    finish_switch(self_fake_stack_, &caller_stack_, &caller_stack_bytes_);
}

} // namespace sdre::f28335
