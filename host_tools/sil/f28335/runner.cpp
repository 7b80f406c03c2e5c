// SPDX-License-Identifier: MIT
#include "sil/f28335/runner.hpp"

namespace sdre::f28335 {

Runner::Runner(const Firmware &firmware, bool own_stack) : firmware_(firmware)
{
#ifndef __EMSCRIPTEN__
    if (own_stack) {
        main_ = std::make_unique<Coroutine>([firmware] { firmware.main(); });
    }
#else
    (void)own_stack;
#endif
}

void Runner::resume()
{
#ifndef __EMSCRIPTEN__
    main_->resume();
#endif
}

void Runner::pass()
{
    if (pass_) {
        firmware_.pass(*pass_);
    } else {
        pass_ = firmware_.start();
    }
}

bool Runner::suspend(bool abandoned)
{
#ifndef __EMSCRIPTEN__
    if (main_) {
        main_->suspend();
        return true;
    }
#endif
    if (abandoned) {
        throw Abandoned{};
    }
    return false;
}

bool Runner::has_stack() const
{
#ifndef __EMSCRIPTEN__
    return main_ != nullptr;
#else
    return false;
#endif
}

bool Runner::finished() const
{
#ifndef __EMSCRIPTEN__
    return main_ && main_->finished();
#else
    return false;
#endif
}

} // namespace sdre::f28335
