// SPDX-License-Identifier: MIT
/// A second stack on which firmware's main(), which never returns, runs beside the model.
#pragma once

#include <ucontext.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace sdre::f28335 {

class Coroutine {
public:
    /// The body starts at the first resume().
    explicit Coroutine(std::function<void()> body);
    Coroutine(const Coroutine &)            = delete;
    Coroutine &operator=(const Coroutine &) = delete;

    /// Runs the body to its next suspend() or to its end. A body that never ends is simply left there: its
    /// stack goes with this object, so it must not own anything.
    void resume();
    /// From within the body.
    void suspend();
    bool finished() const
    {
        return finished_;
    }

private:
    static void entry(unsigned high, unsigned low);
    void        run();

    std::function<void()> body_;
    std::vector<char>     stack_;
    ucontext_t            caller_{};
    ucontext_t            self_{};
    bool                  finished_ = false;
    // AddressSanitizer's view of the two stacks.
    void       *caller_fake_stack_  = nullptr;
    void       *self_fake_stack_    = nullptr;
    const void *caller_stack_       = nullptr;
    std::size_t caller_stack_bytes_ = 0;
};

} // namespace sdre::f28335
