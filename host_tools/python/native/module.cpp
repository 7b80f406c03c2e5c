// SPDX-License-Identifier: MIT
#include "bindings.hpp"

#include "common/errors.hpp"
#include "common/version.hpp"

NB_MODULE(_native, m)
{
    nanobind::exception<sdre::InputError>(m, "InputError", PyExc_ValueError);
    nanobind::exception<sdre::DesignError>(m, "DesignError", PyExc_RuntimeError);
    m.attr("tool_version") = sdre::tool_version;
    sdre::bind_design(m);
    sdre::bind_runs(m);
    sdre::bind_loop(m);
    sdre::bind_cases(m);
}
