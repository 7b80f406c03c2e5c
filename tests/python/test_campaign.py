# SPDX-License-Identifier: MIT
"""Campaigns: interruption, summary, replay."""

from __future__ import annotations

import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Dict, List

import numpy as np
import pyarrow.parquet as pq
import pytest
from distributed import Client
from distributed.security import Security
from test_sdre import SCENARIOS, SHIPPED, TOOLS

import sdre
from sdre.scenario import changed
from sdre_campaign.batch import run_batch
from sdre_campaign.cluster import connected
from sdre_campaign.draw import even_numbers
from sdre_campaign.parts import Directory
from sdre_campaign.spec import read_spec
from sdre_campaign.summary import summarise

SHORT = f"""
scenario = "{SCENARIOS}/board_random_motors.toml"
method = "random"
cases = 240
batch = 20
worst = 3
[change]
duration_s = 0.12
"speed_reference.1.time_s" = 0.02
"load_torque.1.time_s" = 0.07
"measure.0.time_s" = 0.02
"measure.1.time_s" = 0.07
[[variable]]
name = "flux"
keys = ["plant_scale.pm_flux_Wb"]
range = [0.3, 1.5]
[[variable]]
name = "load"
keys = ["load_torque.1.value_Nm"]
range = [0.5, 2.5]
"""


def write_spec(path: Path, text: str = SHORT) -> Path:
    """A specification file."""
    path.mkdir(parents=True, exist_ok=True)
    file = path / "short.toml"
    file.write_text(text)
    return file


def command(*words: Any) -> List[str]:
    """sdre-campaign."""
    return [sys.executable, "-B", "-m", "sdre_campaign", *map(str, words)]


def campaign(*words: Any, exit_code: int = 4) -> str:
    """Runs it to its end; exit code 4: a case has failed."""
    done = subprocess.run(command(*words), capture_output=True, text=True, timeout=300)
    assert done.returncode == exit_code, done.stderr + done.stdout
    return done.stdout + done.stderr


def parts(directory: Path) -> Dict[str, bytes]:
    """Written parts of the cases."""
    return {
        path.name: path.read_bytes() for path in sorted((directory / "parts").glob("*.parquet"))
    }


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A campaign that nothing has disturbed, by one worker."""
    path = tmp_path_factory.mktemp("whole")
    campaign(write_spec(path), "--out", path / "out", "--workers", 1)
    return path / "out"


def wait_for_parts(directory: Path, count: int) -> None:
    """Until so many are there."""
    end = time.monotonic() + 60.0
    while len(list((directory / "parts").glob("part-*.parquet"))) < count:
        assert time.monotonic() < end, "no parts come"
        time.sleep(0.01)


def test_two_workers_write_the_same_bytes_as_one(whole: Path, tmp_path: Path) -> None:
    campaign(write_spec(tmp_path), "--out", tmp_path / "out", "--workers", 2)

    assert parts(tmp_path / "out") == parts(whole)
    for name in ("summary.json", "sensitivity.png"):
        assert (tmp_path / "out" / name).read_bytes() == (whole / name).read_bytes(), name


def test_killed_client_loses_and_repeats_nothing_that_was_written(
    whole: Path, tmp_path: Path
) -> None:
    spec, out = write_spec(tmp_path), tmp_path / "out"
    client = subprocess.Popen(
        command(spec, "--out", out, "--workers", 1),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    wait_for_parts(out, 2)
    client.send_signal(signal.SIGKILL)
    client.wait()
    (out / "parts" / ".part-000011.parquet.tmp").write_bytes(b"half a part")
    before = {path: path.stat().st_mtime_ns for path in (out / "parts").glob("part-*.parquet")}
    assert 2 <= len(before) < 12

    assert "--resume goes on" in campaign(spec, "--out", out, exit_code=1)
    said = campaign(spec, "--out", out, "--workers", 2, "--resume")

    assert parts(out) == parts(whole)
    assert {path: path.stat().st_mtime_ns for path in before} == before
    assert f"{240 - 20 * len(before)} cases in" in said
    assert not list((out / "parts").glob(".*"))


def test_killed_worker_is_replaced(whole: Path, tmp_path: Path) -> None:
    spec, out = write_spec(tmp_path), tmp_path / "out"
    client = subprocess.Popen(
        command(spec, "--out", out, "--workers", 2),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    wait_for_parts(out, 1)
    os.kill(worker_of(client.pid), signal.SIGKILL)

    assert client.wait(120) == 4
    assert parts(out) == parts(whole)


def worker_of(client: int) -> int:
    """The process that has computed most among those below the client."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
            if int(fields[1]) == client:
                found.append((int(fields[11]), int(stat.parent.name)))
        except (OSError, IndexError):
            continue
    assert found, "no worker below the client"
    return max(found)[1]


def test_cluster_of_others_writes_the_same_bytes(whole: Path, tmp_path: Path) -> None:
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=1,
        threads_per_worker=2,
        processes=False,
        dashboard_address="127.0.0.1:0",
        protocol="tcp://",
    ) as cluster:
        campaign(
            write_spec(tmp_path),
            "--out",
            tmp_path / "out",
            "--scheduler",
            cluster.scheduler_address,
        )

    assert parts(tmp_path / "out") == parts(whole)


def test_local_scheduler_runs_nothing_of_strangers() -> None:
    with connected(None, 1) as client:
        address = client.scheduler.address
        assert client.submit(sum, (1, 2)).result() == 3
        for secret in (None, Security.temporary()):
            stranger = address if secret else address.replace("tls:", "tcp:")
            with pytest.raises(OSError):
                Client(stranger, security=secret, timeout=5)


def test_part_that_has_changed_is_computed_again(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    shutil.copytree(whole, out)
    spec = read_spec(write_spec(tmp_path))
    with Directory(out, spec, resume=True) as directory:
        assert directory.missing() == []
        part = out / "parts/part-000003.parquet"
        octets = part.read_bytes()
        for bit in range(
            0, 8 * len(octets), 61
        ):  # a prime: every part of the file, every bit of an octet
            changed_octets = bytearray(octets)
            changed_octets[bit // 8] ^= 1 << bit % 8
            part.write_bytes(changed_octets)
            assert directory.missing() == [3], bit
        with pytest.raises(sdre.InputError, match="part-000003.*is damaged"):
            list(directory.tables())
        (out / "sums/part-000005.sha256").unlink()
        assert directory.missing() == [3, 5]
    campaign(tmp_path / "short.toml", "--out", out, "--workers", 1, "--resume")
    assert parts(out) == parts(whole)


@pytest.mark.parametrize("text", ["", "{", "[]", "\x00", '{"digest": 3}'])
def test_damaged_campaign_file_is_one_clear_line(whole: Path, tmp_path: Path, text: str) -> None:
    out = tmp_path / "out"
    shutil.copytree(whole, out)
    (out / "campaign.json").write_text(text)
    said = campaign(
        write_spec(tmp_path), "--out", out, "--workers", 1, "--resume", exit_code=1
    ).strip()
    assert len(said.splitlines()) == 1 and str(out) in said
    assert parts(out) == parts(whole)


def test_full_disk_is_one_clear_line(whole: Path, tmp_path: Path) -> None:
    spec, out = write_spec(tmp_path), tmp_path / "out"
    most = 3000  # octets of a file; campaign.json has fewer, a part has more
    done = subprocess.run(
        command(spec, "--out", out, "--workers", 1),
        capture_output=True,
        text=True,
        timeout=300,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
    )
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == 1 and "cannot be written" in done.stderr, done.stderr
    assert not list((out / "parts").glob("*.parquet"))
    campaign(spec, "--out", out, "--workers", 1, "--resume")
    assert parts(out) == parts(whole)


def test_no_scheduler_is_one_clear_line(tmp_path: Path) -> None:
    said = campaign(
        write_spec(tmp_path),
        "--out",
        tmp_path / "out",
        "--scheduler",
        "tcp://127.0.0.1:9",
        exit_code=1,
    )
    assert said.strip().splitlines() == [
        "sdre-campaign: tcp://127.0.0.1:9: no scheduler answers; --resume goes on"
    ]


def test_more_cases_keep_those_there_are(whole: Path, tmp_path: Path) -> None:
    spec, out = write_spec(tmp_path), tmp_path / "out"
    campaign(spec, "--out", out, "--workers", 1, "--cases", 50)
    campaign(spec, "--out", out, "--workers", 1, "--resume")

    assert parts(out) == parts(whole)


def test_summary_counts_what_the_parts_say(whole: Path) -> None:
    said = json.loads((whole / "summary.json").read_text())
    table = pq.read_table(whole / "parts")
    failed = table["failed"].to_numpy()
    margin = np.minimum(table["current_margin"].to_numpy(), table["speed_margin"].to_numpy())

    assert said["cases"] == 240 == table.num_rows
    assert said["failures"] == failed.sum() > 0
    assert said["margin"]["least"] == margin.min()
    assert said["negative_margins"] == (margin < 0.0).sum() >= said["failures"]
    edges, speed = np.array(said["histograms"]["edges"]), table["speed_margin"].to_numpy()
    assert (
        said["histograms"]["speed"] == np.histogram(np.maximum(speed, edges[0]), edges)[0].tolist()
    )
    assert sum(said["histograms"]["least"]) == 240
    flux = said["worst"][0]["values"]["flux"]
    assert said["worst"][0]["places"]["flux"] == pytest.approx((flux - 0.3) / 1.2)
    assert said["margin"]["mean"] == pytest.approx(margin.mean())
    assert said["interval_95"][0] < said["failures"] / 240 < said["interval_95"][1]
    order = np.lexsort((table["case"].to_numpy(), margin, ~failed))
    assert [one["case"] for one in said["worst"]] == table["case"].to_numpy()[order][:3].tolist()


def test_worst_cases_replay_to_the_bit(whole: Path, tmp_path: Path) -> None:
    files = sorted((whole / "worst").glob("*.toml"))
    table = pq.read_table(whole / "parts")
    assert len(files) == 3
    for file in files:
        out = tmp_path / "run.json"
        subprocess.run(
            [str(TOOLS / "sdre-sil"), "run", str(file), "--json", str(out)],
            check=False,
            capture_output=True,
        )
        said = json.loads(out.read_text())
        row = table.slice(int(file.stem.split("_case_")[1]), 1).to_pylist()[0]
        assert said["seed"] == row["seed"] and (said["fault"] == "none") == (row["fault"] == 0)
        for measure, metrics in said["measures"].items():
            for name in ("settling_time_s", "dip_e_radps", "ripple_e_radps"):
                kept = row[f"{measure}.{name}"]
                assert (metrics[name] is None and np.isnan(kept)) or metrics[name] == kept, (
                    file,
                    measure,
                    name,
                )


def test_motors_are_those_of_sdre_sil(tmp_path: Path) -> None:
    text = (
        f'scenario = "{SCENARIOS}/board_random_motors.toml"\nmethod = "motors"\ncases = 6\nseed '
        f"= 1\n"
    )
    spec = read_spec(write_spec(tmp_path, text))
    subprocess.run(
        [
            str(TOOLS / "sdre-sil"),
            "motors",
            str(SCENARIOS / "board_random_motors.toml"),
            "--count",
            "6",
            "--csv",
            str(tmp_path / "m.csv"),
        ],
        check=False,
        capture_output=True,
    )
    rows = list(csv.DictReader((tmp_path / "m.csv").open()))
    ours = run_batch(spec, 0).table.to_pylist()

    assert len(rows) == len(ours) == 6
    for row, case in zip(rows, ours):
        assert int(row["motor"]) == case["seed"] and bool(int(row["failed"])) == case["failed"]
        for name in ("resistance", "d_axis_inductance", "q_axis_inductance", "flux", "inertia"):
            assert float(row[name]) == pytest.approx(case[f"value.{name}"], rel=1e-5)


def test_margins_are_those_of_the_trace() -> None:
    drive = sdre.Drive.from_toml(SHIPPED)
    loads = [1.0, 1.5, 9.0]  # the last is more than the motor can carry
    cases = sdre.Cases(
        sdre.Scenario(SCENARIOS / "board_load_step.toml"),
        drive,
        [sdre.Variable("load", ("load_torque.1.value_Nm",))],
        ["peak_current_A"],
    )
    result = cases.run(np.array([loads]).T, np.array([5, 6, 7], dtype=np.uint64))

    assert result.failed.tolist() == [False, False, True]
    assert ((np.minimum(result.current_margin, result.speed_margin) < 0.0) == result.failed).all()
    for k, load in enumerate(loads[:2]):
        keys = changed(SCENARIOS / "board_load_step.toml", {"load_torque.1.value_Nm": load})
        trace = sdre.simulate(drive, keys, seed=5 + k).trace
        assert result.current_margin[k] == 1.0 - trace.peak_current_A.max() / (1.1 * 4.0)
        assert result.speed_margin[k] == 1.0 - worst_in_tails(trace, keys)


def worst_in_tails(trace: sdre.Trace, keys: Dict[str, Any]) -> float:
    """Largest speed error in the last fifth of each measure, over its band."""
    begins = [
        int(np.searchsorted(trace.time_s, measure["time_s"] - 1e-9)) for measure in keys["measure"]
    ]
    worst = 0.0
    for begin, end, measure in zip(begins, begins[1:] + [len(trace)], keys["measure"]):
        assert "tail_s" not in measure
        tail = slice(end - int(0.2 * (end - begin)), end)
        error = np.abs(trace.omega_e_radps[tail] - trace.omega_ref_e_radps[end - 1])
        worst = max(worst, float(error.max()) / measure["band_e_radps"])
    return worst


def test_first_order_index_of_a_known_margin(whole: Path, tmp_path: Path) -> None:
    spec = read_spec(write_spec(tmp_path))
    table = pq.read_table(whole / "parts")
    n = 20000
    u = even_numbers(1, 0, n, 2)
    flux, load = 0.3 + 1.2 * u[:, 0], 0.5 + 2.0 * u[:, 1]
    margin = 0.2 * (2.0 * u[:, 0] + u[:, 1])  # explains 4 : 1
    kinds = {
        "case": np.arange(n),
        "seed": np.arange(n),
        "failed": margin < 0.1,
        "fault": np.zeros(n, dtype=np.int32),
        "current_margin": margin,
        "speed_margin": np.ones(n),
        "value.flux": flux,
        "value.load": load,
    }
    made = table.schema.empty_table().from_pydict(kinds)
    said = summarise(spec, [made.slice(0, 7000), made.slice(7000)]).as_dict()

    assert said["first_order"] == pytest.approx({"flux": 0.8, "load": 0.2}, abs=0.01)
    few = summarise(
        spec, [made.slice(0, 400)]
    ).as_dict()  # ten cases a bin: by chance alone it would be 0.1 more
    assert few["first_order"]["load"] == pytest.approx(0.2, abs=0.05)


@pytest.mark.parametrize("bounds", ["[-0.5, 1.5]", "[0.5, 150.0]"])
def test_value_that_a_scenario_cannot_have_is_refused_before_the_first_case(
    bounds: str, tmp_path: Path
) -> None:
    spec = write_spec(tmp_path, SHORT.replace("[0.3, 1.5]", bounds))
    said = campaign(spec, "--out", tmp_path / "out", "--workers", 1, exit_code=1)

    assert len(said.strip().splitlines()) == 1 and "pm_flux_Wb" in said
    assert not (tmp_path / "out").exists()


def test_directory_of_another_campaign_stays(whole: Path, tmp_path: Path) -> None:
    before = parts(whole)
    said = campaign(
        write_spec(tmp_path, SHORT.replace("[0.5, 2.5]", "[0.5, 2.0]")),
        "--out",
        whole,
        "--resume",
        exit_code=1,
    )

    assert "has parts of another campaign" in said
    assert parts(whole) == before


SCHEDULER = """
import asyncio
from distributed import Scheduler

async def main():
    async with Scheduler(host="127.0.0.1", port=0, dashboard_address="127.0.0.1:0") as scheduler:
        print(scheduler.address, flush=True)
        await scheduler.finished()

asyncio.run(main())
"""
WORKER = """
import asyncio, sys
from distributed import Worker

async def main():
    async with Worker(sys.argv[1], nthreads=1, dashboard_address="127.0.0.1:0") as worker:
        await worker.finished()

asyncio.run(main())
"""


def test_killed_scheduler_ends_the_client_and_loses_nothing_that_was_written(
    whole: Path, tmp_path: Path
) -> None:
    spec, out = write_spec(tmp_path), tmp_path / "out"
    quiet = {"stderr": subprocess.DEVNULL, "text": True}
    scheduler = subprocess.Popen([sys.executable, "-c", SCHEDULER], stdout=subprocess.PIPE, **quiet)
    assert scheduler.stdout
    address = scheduler.stdout.readline().strip()
    worker = subprocess.Popen(
        [sys.executable, "-c", WORKER, address], stdout=subprocess.DEVNULL, **quiet
    )
    client = subprocess.Popen(
        command(spec, "--out", out, "--scheduler", address),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_for_parts(out, 2)
        scheduler.send_signal(signal.SIGKILL)
        _, said = client.communicate(timeout=60)
    finally:
        for process in (scheduler, worker, client):
            process.kill()
            process.wait()

    assert client.returncode == 1 and said.strip().splitlines()[-1].endswith("--resume goes on"), (
        said
    )
    before = {path: path.stat().st_mtime_ns for path in (out / "parts").glob("part-*.parquet")}
    campaign(spec, "--out", out, "--workers", 1, "--resume")
    assert parts(out) == parts(whole)
    assert {path: path.stat().st_mtime_ns for path in before} == before
