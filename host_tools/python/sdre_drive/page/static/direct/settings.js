// SPDX-License-Identifier: MIT
// The parameters of a drive, which it keeps over power: docs/parameters.md.
import { register, wordsOf } from "./drive.js";
import { PARAMETERS, PARAMETER_GROUPS, SIGNATURES, STORED_WORDS } from "./tables.js";

const DONE = 1; // of register PARAMETERS_DONE
const NEW_S = 1; // a drive that has just started: its time would not tell a restart
const AGAIN_MS = 100;
const BACK_MS = 90000; // two sectors of flash are erased in 30 s at most; the rest is for lost answers

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

function storedWords({ PARAMETERS_STATE: state, PARAMETERS_NUMBER: number, PARAMETERS_DROPPED: dropped }) {
  const known = STORED_WORDS[state] || `state ${state}`;
  const less = dropped ? `, but ${dropped} that this firmware does not have` : "";
  return (number ? `${known}, writing ${number}` : known) + less;
}

/** All of them as rows of the page, and where they come from. */
export async function read({ drive, constants }) {
  const raw = {};
  for (const group of PARAMETER_GROUPS) {
    Object.assign(raw, await drive.values(group));
  }
  const rows = PARAMETERS.map((p) => {
    const { step, unit } = register(p.name);
    const value = raw[p.name];
    const largest = p.name === "MAX_CURRENT" ? Math.min(p.high, constants.CURRENT_MAX) : p.high;
    const first = p.default === null ? constants.CURRENT_MAX : p.default;
    return { ...p, unit, step, value, high: largest, default: first, changed: Math.abs(value - first) > 0.5 * (step || 1) };
  });
  return { words: `at its start the drive had ${storedWords(await drive.values("STORED"))}`, rows };
}

/** Those that are given. The address comes last: from then on the drive has another one. */
export async function write({ drive, constants }, wanted) {
  const names = Object.keys(wanted).sort((one, other) => (one === "MODBUS_ADDRESS") - (other === "MODBUS_ADDRESS"));
  for (const name of names) {
    const p = PARAMETERS.find((one) => one.name === name);
    const most = name === "MAX_CURRENT" ? constants.CURRENT_MAX : p && p.high;
    if (!p || !(wanted[name] >= p.low && wanted[name] <= most)) {
      throw new Error(`${name}: ${wanted[name]} is not within ${p && p.low} .. ${most}`);
    }
    wordsOf(register(name), wanted[name]);
  }
  for (const name of names) {
    await drive.write(name, wanted[name]).catch((error) => {
      throw new Error(`${name}: ${error.message}${PARAMETERS.find((p) => p.name === name).stopped ? "; only while stopped" : ""}`);
    });
    drive.master.unit = name === "MODBUS_ADDRESS" ? wanted[name] : drive.master.unit;
  }
}

async function back(watcher, before, begun_s) {
  const end = performance.now() + BACK_MS;
  while (performance.now() < end) {
    await pause(AGAIN_MS);
    let now;
    let reading;
    try {
      now = await watcher.drive.values("STORED");
      reading = await watcher.read();
    } catch {
      begun_s = Infinity; // it restarts, or its flash keeps it
      continue;
    }
    if (reading.time_s < begun_s || now.PARAMETERS_NUMBER !== before.PARAMETERS_NUMBER) {
      if (now.PARAMETERS_DONE !== DONE) {
        throw new Error(`the flash did not take it; in force: ${storedWords(now)}`);
      }
      return `in force: ${storedWords(now)}`;
    }
  }
  throw new Error("the drive does not come back: switch it off and on");
}

/** Stores all as they are, or forgets what is stored: STORE_PARAMETERS, RESTORE_PARAMETERS. The drive restarts. */
export async function command(watcher, name) {
  const { drive } = watcher;
  const before = await drive.values("STORED");
  await pause(1000 * Math.max(NEW_S - (await watcher.read()).time_s, 0));
  const begun_s = (await watcher.read()).time_s;
  await drive.write(name, SIGNATURES[name]);
  return back(watcher, before, begun_s);
}
