# SPDX-License-Identifier: MIT
"""Designs, simulates and tries out sdre drives from Python: the numbers of `sdre-gains` and
`sdre-sil`, to the bit.

    >>> import sdre
    >>> drive = sdre.Drive.from_toml("firmware/config/drives/ipmsm_390w.toml")
    >>> sdre.design(drive).certificate.certified
    True
    >>> run = sdre.simulate(drive, "host_tools/sil/scenarios/board_load_step.toml")
    >>> run.trace.omega_e_radps.max()

Quantities have their SI unit in the name; `e` is electrical, `m` mechanical; `d`, `q` are axes of
the rotor. Wrong input raises InputError (a ValueError), a drive without an acceptable design
DesignError (a RuntimeError), each with one line. design(), tune(), simulate(), care() and
Cases.run() release the interpreter's lock: threads run side by side.
"""

from sdre._native import DesignError, InputError, tool_version
from sdre.cases import Cases, CaseTable, Variable
from sdre.drive import Drive, Motor
from sdre.gains import (
    CareSolution,
    Certificate,
    Design,
    GainSeries,
    LoopVerdict,
    SampledLoop,
    care,
    design,
    tune,
)
from sdre.loop import (
    CORE_QUANTITIES,
    NO_VOLTAGE,
    Bridge,
    Core,
    Plant,
    PlantState,
    Sample,
    Simulation,
    State,
    voltage_duty,
)
from sdre.run import UNITS, Run, Trace, simulate, simulate_with
from sdre.scenario import Scenario
from sdre.virtual_drive import VirtualDrive

__version__ = tool_version
__all__ = [
    "Bridge",
    "CORE_QUANTITIES",
    "CareSolution",
    "CaseTable",
    "Cases",
    "Certificate",
    "Core",
    "Design",
    "DesignError",
    "Drive",
    "GainSeries",
    "InputError",
    "LoopVerdict",
    "Motor",
    "NO_VOLTAGE",
    "Plant",
    "PlantState",
    "Run",
    "Sample",
    "SampledLoop",
    "Scenario",
    "Simulation",
    "State",
    "Trace",
    "UNITS",
    "Variable",
    "VirtualDrive",
    "care",
    "design",
    "simulate",
    "simulate_with",
    "tune",
    "voltage_duty",
]
