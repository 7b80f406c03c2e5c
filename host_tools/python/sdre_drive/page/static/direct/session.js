// SPDX-License-Identifier: MIT
// Starting and resetting a drive, and moves, with its own rules: docs/modbus.md.
import { CONTROL } from "./drive.js";
import { MOVING, NO_START, bits, oneLine } from "./words.js";

const VELOCITY = 3; // modes of operation
const POSITION = 1;
const BOOT_WAIT_S = 3; // chosen: the firmware needs 0.3 s
const ANSWER_WAIT_S = 1; // a command acts within a tick or two
const RUN_WAIT_S = 20; // chosen: the angle is found before
const PERIOD_MS = 25;
const FAR_TURNS = 10; // chosen: beyond, a shaft that counts from another zero unwinds for long
const [NEW, AT_ONCE, RELATIVE] = [1 << 4, 1 << 5, 1 << 6]; // of the control word
const ACKNOWLEDGED = 1 << 12; // of the status word
const ANGLE_KNOWN = 1 << 15;

/** The first matching reading; null when it does not come. Time is the drive's own. */
async function waitFor(watcher, wanted, longest_s) {
  let begin_s = null;
  for (;;) {
    const reading = await watcher.read();
    if (wanted(reading)) {
      return reading;
    }
    if (begin_s === null || reading.time_s < begin_s) {
      begin_s = reading.time_s; // it has restarted
    }
    if (reading.time_s > begin_s + longest_s) {
      return null;
    }
    await new Promise((done) => setTimeout(done, PERIOD_MS));
  }
}

function requireNoTrip(reading) {
  if (reading.mode === "FAULT") {
    throw new Error(`the drive has tripped: ${reading.faults.length ? oneLine(reading.faults[0]) : "unknown"}`);
  }
}

function requireSpeed(watcher, speed) {
  const most = watcher.constants.SPEED_MAX;
  if (Math.abs(speed) > most) {
    throw new Error(`${watcher.speedWords(speed)} is out of the drive's range: at most ${watcher.speedWords(most)}, either way`);
  }
}

function requireMode(reading, mode) {
  if (MOVING.includes(reading.mode) && reading.mode_of_operation !== mode) {
    throw new Error("the drive runs in another mode of operation: stop it first");
  }
}

/** Starts it in a mode of operation, or gives one that runs in it this speed. */
async function start(watcher, speed, mode, stops) {
  const { drive } = watcher;
  const ready = await waitFor(watcher, (r) => ["READY", "FAULT", ...MOVING].includes(r.mode), BOOT_WAIT_S);
  if (!ready) {
    throw new Error("the drive does not get ready");
  }
  requireNoTrip(ready);
  requireMode(ready, mode);
  await drive.write("SPEED", speed);
  if (MOVING.includes(ready.mode)) {
    return;
  }
  const inTheWay = bits("condition", ready.conditions & NO_START);
  if (inTheWay.length) {
    throw new Error(`the drive cannot start: ${inTheWay.map((e) => e.meaning).join(" ")}`);
  }
  await drive.write("MODE_OF_OPERATION", mode);
  await drive.off(); // enabling has to rise
  await drive.write("CONTROLWORD", CONTROL.shutDown);
  await drive.write("CONTROLWORD", CONTROL.enable, stops);
  const started = await waitFor(watcher, (r) => r.mode !== "READY", ANSWER_WAIT_S);
  if (!started) {
    throw new Error("the drive does not start");
  }
  requireNoTrip(started);
}

/** Runs at a speed, rad/s electrical. */
export async function run(watcher, speed) {
  const { stops } = watcher.drive;
  requireSpeed(watcher, speed);
  await start(watcher, speed, VELOCITY, stops);
}

async function requireNear(watcher, units, relative, far) {
  const now = (await watcher.drive.values("POSITION")).POSITION_NOW;
  const turns = Math.abs(relative ? units : units - now) / watcher.constants.TURN_UNITS;
  if (turns > FAR_TURNS && !far) {
    throw new Error(`that is ${turns.toFixed(1)} turns away: allow more than ten turns first`);
  }
}

async function setPoint(watcher, units, how, stops) {
  const { drive } = watcher;
  await drive.write("CONTROLWORD", CONTROL.enable, stops);
  await drive.write("TARGET_POSITION", units);
  await drive.write("CONTROLWORD", CONTROL.enable | how | NEW, stops);
  if (!(await waitFor(watcher, (r) => r.statusword & ACKNOWLEDGED, ANSWER_WAIT_S))) {
    throw new Error("the drive does not take the position");
  }
  await drive.write("CONTROLWORD", CONTROL.enable, stops);
}

/** To a number of position units, or by it. Whatever goes wrong once the drive is ours: it is stopped. */
export async function move(watcher, { units, relative, far, speed }) {
  const { drive } = watcher;
  const { stops } = drive;
  const reading = await watcher.read();
  requireMode(reading, POSITION);
  requireSpeed(watcher, speed);
  if (reading.statusword & ANGLE_KNOWN) {
    await requireNear(watcher, units, relative, far);
  }
  await drive.write("PROFILE_VELOCITY", speed);
  try {
    await start(watcher, 0, POSITION, stops);
    const runs = await waitFor(watcher, (r) => ["RUN", "FAULT", "READY"].includes(r.mode), RUN_WAIT_S);
    if (!runs || runs.mode === "READY") {
      throw new Error("the drive does not come to run");
    }
    requireNoTrip(runs);
    await requireNear(watcher, units, relative, far);
    await setPoint(watcher, units, AT_ONCE | (relative ? RELATIVE : 0), stops);
  } catch (error) {
    if (drive.stops === stops) {
      await drive.off().catch(() => undefined); // it stops by itself
    }
    throw error;
  }
}

/** Leaves FAULT when what caused it has gone. */
export async function reset(watcher) {
  for (const word of [CONTROL.disable, CONTROL.faultReset, CONTROL.disable]) {
    await watcher.drive.write("CONTROLWORD", word);
  }
  if (!(await waitFor(watcher, (r) => r.mode === "READY", ANSWER_WAIT_S))) {
    requireNoTrip(await watcher.read());
    throw new Error("the drive does not leave its fault");
  }
}
