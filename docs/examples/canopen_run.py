#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a drive by CANopen. Loads its data sheet, starts the node and enables the operation in
profile velocity. Follows the speed for a while and comes to rest.

    pip install canopen==2.4.1 python-can==4.6.1
    python canopen_run.py --channel socket://127.0.0.1:1600 --speed 500

The commanded speed is in r/min of the shaft. Ends with 1 after an emergency or when a state does
not come.
"""

import argparse
import pathlib
import sys
import time

import canopen
from canopen.sdo.exceptions import SdoError

EDS = pathlib.Path(__file__).resolve().parent.parent / "sdre-drive.eds"
PROFILE_VELOCITY = 3
SHUT_DOWN, ENABLE_OPERATION, DISABLE_VOLTAGE = 0x06, 0x0F, 0x00
STATE_BITS = 0x6F
READY_TO_SWITCH_ON, OPERATION_ENABLED = 0x21, 0x27
TURNS_STEP = 0.1  # r/min of a count of 60FFh and 606Ch


class Stopped(Exception):
    """One line."""


def wait(node: canopen.RemoteNode, state: int, longest_s: float) -> None:
    """Until the status word shows the state."""
    end = time.monotonic() + longest_s
    while node.sdo[0x6041].raw & STATE_BITS != state:
        if node.emcy.active:
            raise Stopped(f"emergency {node.emcy.active[-1].code:04X}h")
        if time.monotonic() > end:
            raise Stopped(f"status word {node.sdo[0x6041].raw:04X}h after {longest_s:g} s")
        time.sleep(0.02)


def run(node: canopen.RemoteNode, speed_rpm: float, seconds: float) -> None:
    """From the pre-operational state to a turning motor, and to rest."""
    node.sdo[0x1017].raw = 200  # ms between two heartbeats
    node.tpdo.read()  # what each PDO has, as the drive says
    node.rpdo.read()
    node.nmt.state = "OPERATIONAL"

    node.sdo[0x6060].raw = PROFILE_VELOCITY
    node.sdo[0x60FF].raw = round(speed_rpm / TURNS_STEP)
    node.sdo[0x6040].raw = SHUT_DOWN
    wait(node, READY_TO_SWITCH_ON, 1.0)
    node.sdo[0x6040].raw = ENABLE_OPERATION
    wait(node, OPERATION_ENABLED, 5.0)

    speeds = node.tpdo[4]  # status word and speed, with every SYNC
    node.network.sync.start(0.01)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if speeds.wait_for_reception(0.5) is None:
            raise Stopped("no speed after a SYNC")
        if node.emcy.active:
            raise Stopped(f"emergency {node.emcy.active[-1].code:04X}h")
        print(f"\r{speeds['SPEED_NOW_RPM'].raw * TURNS_STEP:8.1f} r/min", end="", flush=True)
    print()
    node.network.sync.stop()


def main() -> int:
    """The command line."""
    options = argparse.ArgumentParser(description="Runs a drive by CANopen.")
    options.add_argument("--interface", default="slcan", help="of python-can (default: slcan)")
    options.add_argument("--channel", required=True, help="socket://HOST:PORT, or a device")
    options.add_argument("--bitrate", type=int, default=500000, help="bit/s (default: 500000)")
    options.add_argument("--node", type=int, default=1, help="number of the node (default: 1)")
    options.add_argument("--speed", type=float, default=500.0, help="r/min (default: 500)")
    options.add_argument("--seconds", type=float, default=5.0, help="at that speed (default: 5)")
    given = options.parse_args()

    network = canopen.Network()
    node = network.add_node(given.node, str(EDS))
    network.connect(interface=given.interface, channel=given.channel, bitrate=given.bitrate)
    try:
        run(node, given.speed, given.seconds)
    except (Stopped, SdoError) as e:
        print(f"canopen_run: {e}", file=sys.stderr)
        return 1
    finally:
        try:
            node.sdo[0x6040].raw = DISABLE_VOLTAGE
        except SdoError:
            pass  # the drive has gone
        network.disconnect()
    return 0


if __name__ == "__main__":
    sys.exit(main())
