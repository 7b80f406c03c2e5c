// SPDX-License-Identifier: MIT
/// Runs firmware beside the model, until the model's time is over.
///
/// On a stack of its own, main() is suspended anywhere and goes on there. Where nobody can switch stacks, as in
/// WebAssembly, the device runs main()'s passes, and waits between them itself. A pass that waits, as for the flash, runs to
/// its end, and what comes from outside meanwhile comes after it. A reset leaves a pass by an exception.
#pragma once

#include <memory>
#include <optional>

#include "sil/f28335/firmware.hpp"
#ifndef __EMSCRIPTEN__
#include "sil/f28335/coroutine.hpp"
#endif

namespace sdre::f28335 {

#ifdef __EMSCRIPTEN__
constexpr bool can_switch_stacks = false;
#else
constexpr bool can_switch_stacks = true;
#endif

/// Thrown through firmware that is left for good.
struct Abandoned {};

class Runner {
public:
    explicit Runner(const Firmware &firmware, bool own_stack);

    bool has_stack() const;
    /// With a stack: the firmware goes on until it is suspended or has ended.
    void resume();
    /// Without: the start, then one pass of main() for each call.
    void pass();
    /// From within the firmware. False: it cannot be suspended, the pass goes on.
    /// @param abandoned The device was reset: without a stack of its own the firmware is left by Abandoned.
    bool suspend(bool abandoned);
    bool finished() const;

private:
    Firmware                       firmware_;
    std::optional<firmware_pass_t> pass_; ///< after the start
#ifndef __EMSCRIPTEN__
    std::unique_ptr<Coroutine> main_;
#endif
};

} // namespace sdre::f28335
