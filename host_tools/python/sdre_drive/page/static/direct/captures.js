// SPDX-License-Identifier: MIT
// The drive's oscilloscope and the record of its last fault.
import { SCOPE, SIGNALS } from "./tables.js";
import { Refused } from "./rtu.js";

const { ARM, BLOCK, CHANNELS, RECORD_FIRST, RECORD_SIGNALS, SAMPLES, SCOPE_FIRST } = SCOPE;
export const { DONE, STATES, TRIGGERS } = SCOPE;

const numberOf = (name) => {
  const number = SIGNALS.findIndex((s) => s.name === name);
  if (number < 1) {
    throw new Error(`there is no signal "${name}"`);
  }
  return number;
};
const named = (names) => names.map((name) => SIGNALS[numberOf(name)]);
const every = (values, count) => Array.from({ length: count }, (_, k) => values.filter((_x, n) => n % count === k));

/** Begins; what was taken before is gone. */
export async function arm(drive, { signals, decimation, trigger, channel, level, before }) {
  const numbers = signals.map(numberOf);
  for (let k = 0; k < CHANNELS; k++) {
    await drive.write(`SCOPE_SIGNAL_${k + 1}`, numbers[k] || 0);
  }
  await drive.write("SCOPE_DECIMATION", decimation);
  await drive.write("SCOPE_TRIGGER", TRIGGERS.indexOf(trigger));
  await drive.write("SCOPE_CHANNEL", channel);
  await drive.write("SCOPE_LEVEL", level);
  await drive.write("SCOPE_BEFORE", before);
  await drive.write("SCOPE_COMMAND", ARM);
}

async function floats(drive, first, count) {
  const octets = new DataView(new ArrayBuffer(4 * count));
  for (let at = 0; at < 2 * count; at += BLOCK) {
    const words = await drive.master.input(first + at, Math.min(BLOCK, 2 * count - at));
    words.forEach((word, k) => octets.setUint16(2 * (at + k), word));
  }
  return Array.from({ length: count }, (_, k) => octets.getFloat32(4 * k));
}

/** The most that the firmware has: beyond its last register it refuses. */
async function samplesOf(drive) {
  for (const samples of SAMPLES) {
    try {
      await drive.master.input(SCOPE_FIRST + 2 * CHANNELS * samples - 1, 1);
      return samples;
    } catch (error) {
      if (!(error instanceof Refused)) {
        throw error;
      }
    }
  }
  throw new Error("this firmware has no scope that this page knows");
}

/** Samples taken with this setting; time 0 is the trigger. */
export async function read(drive, setup, period_s) {
  const samples = await samplesOf(drive);
  const values = every(await floats(drive, SCOPE_FIRST, CHANNELS * samples), CHANNELS);
  const time_s = Array.from({ length: samples }, (_, k) => (k - setup.before) * period_s * setup.decimation);
  return { signals: named(setup.signals), time_s, values: values.slice(0, setup.signals.length) };
}

/** The last periods before the last fault; time 0 is the fault. */
export async function record(drive, period_s) {
  for (let n = 0; n < 2; n++) {
    const { RECORD_COUNT: count, RECORD_NUMBER: number } = await drive.values("TRACES");
    const values = every(await floats(drive, RECORD_FIRST, count * RECORD_SIGNALS.length), RECORD_SIGNALS.length);
    if ((await drive.values("TRACES")).RECORD_NUMBER === number) {
      const time_s = Array.from({ length: count }, (_, k) => (k + 1 - count) * period_s);
      return { signals: named(RECORD_SIGNALS), time_s, values };
    }
  }
  throw new Error("the drive trips again and again");
}
