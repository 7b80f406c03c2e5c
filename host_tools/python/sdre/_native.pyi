# SPDX-License-Identifier: MIT
from typing import Any, Dict, List, Optional, Sequence, Tuple

class InputError(ValueError): ...
class DesignError(RuntimeError): ...

tool_version: str
trace_columns: List[str]
metric_names: List[str]

class Drive:
    name: str
    law: str
    digest: str
    control_period_s: float
    trip_speed_e_radps: float
    dc_link_V: float
    motor: Dict[str, float]

class Scenario:
    name: str
    drive: Drive
    duration_s: float
    initial_speed_e_radps: float
    seed: int

class Run:
    table: Any
    csv: str
    json: str
    marks: str
    text: str

class Loop:
    def __init__(self, scenario: Scenario) -> None: ...
    def step(
        self, omega_ref_e_radps: float, extra_load_Nm: float
    ) -> Tuple[List[float], str, bool]: ...

class Core:
    fault: str
    values: List[float]
    def __init__(self, scenario: Scenario) -> None: ...
    def tick(
        self, sample: Tuple[Any, ...], omega_ref_e_radps: float, run: bool
    ) -> Tuple[float, float, float, bool]: ...
    def reset(self) -> None: ...

class Plant:
    sample: Tuple[Any, ...]
    state: List[float]
    def __init__(self, scenario: Scenario) -> None: ...
    def step(self, legs: Tuple[Any, ...], extra_load_Nm: float) -> Tuple[Any, ...]: ...

class Cases:
    measures: List[str]
    def check(self, values: List[float]) -> None: ...
    def run(self, values: Any, seeds: Any) -> Tuple[Any, Any, Any, Any, Any]: ...

def read_drive(text: str, source: str) -> Drive: ...
def report(drive: Drive, extended: bool) -> str: ...
def tune(text: str, source: str) -> Tuple[str, str]: ...
def care(A: Any, B: Any, R: Any, G: Any, Q: Any) -> Tuple[Any, bool, float, Any]: ...
def read_scenario(
    text: str, source: str, name: str, where: str, drive: Optional[Drive]
) -> Scenario: ...
def run(scenario: Scenario) -> Run: ...
def duty_of(
    vd_V: float, vq_V: float, theta_e_rad: float, dc_link_V: float
) -> Tuple[float, float, float, float]: ...
def cases(
    text: str,
    source: str,
    name: str,
    drive: Drive,
    own_law_file: str,
    variables: Sequence[Tuple[List[List[str]], bool]],
    metrics: List[str],
) -> Cases: ...
def draw_motors(scenario: Scenario, seed: int, first: int, count: int) -> Any: ...
def fault_name(fault: int) -> str: ...
