// SPDX-License-Identifier: MIT
// Turns the live registers into a reading, and faults and conditions into words.
import { FAULTS, MODES, RESET_WORDS } from "./tables.js";

const APPLICATION_BOARD = 2; // what sends the reader on to another group
const APPLICATION_DRIVE = 10;
const NOT_A_WARNING = 4; // a condition that needs no action
export const NO_START = 1 | 8 | 16 | 2048 | 4096; // conditions that keep a drive from starting
export const MOVING = ["PRECHARGE", "ALIGN", "RUN"];

/** One of a newer firmware gets a plain one. */
export function entry(group, number) {
  const found = FAULTS[group].find((e) => e.number === number) || {
    number,
    name: "UNKNOWN",
    meaning: "This page does not know that number.",
    causes: ["the firmware is newer than the page"],
    check: ["docs/modbus.md of the firmware"],
  };
  return { group, ...found };
}

/** An entry for each bit that is set. */
export function bits(group, value) {
  return Array.from({ length: 16 }, (_, k) => 1 << k)
    .filter((bit) => value & bit)
    .map((bit) => entry(group, bit));
}

/** Faults of the drive, the most specific first. */
export function explain({ FAULT, DRIVE_FAULT, BOARD_FAULTS }) {
  if (FAULT === 0) {
    return [];
  }
  const first = entry("application", FAULT);
  if (FAULT === APPLICATION_DRIVE && DRIVE_FAULT) {
    return [entry("drive", DRIVE_FAULT), first];
  }
  return FAULT === APPLICATION_BOARD && BOARD_FAULTS ? [...bits("board", BOARD_FAULTS), first] : [first];
}

export const oneLine = (e) => `${e.group} ${e.number} ${e.name}: ${e.meaning}`;

/** A reading as the page shows it, from the live registers. */
export function readingOf(raw, period_s) {
  const [mode, mode_words] = MODES[raw.MODE] || ["UNKNOWN", `unknown mode ${raw.MODE}`];
  return {
    mode,
    mode_words,
    mode_of_operation: raw.MODE_NOW,
    statusword: raw.STATUSWORD,
    conditions: raw.CONDITIONS,
    reset_cause: raw.RESET_CAUSE,
    reset_words: RESET_WORDS[raw.RESET_CAUSE] || `unknown cause ${raw.RESET_CAUSE}`,
    time_s: raw.TICKS * period_s,
    speed_e_radps: raw.SPEED_NOW,
    speed_demand_rpm: raw.SPEED_DEMAND_RPM,
    iq_A: raw.IQ,
    id_A: raw.ID,
    dc_link_V: raw.DC_LINK,
    temperature_degC: raw.TEMPERATURE,
    motor_heat: raw.MOTOR_HEAT,
    inverter_heat: raw.INVERTER_HEAT,
    derating: raw.DERATING,
    faults: explain(raw),
    messages: [...explain(raw), ...bits("condition", raw.CONDITIONS & ~NOT_A_WARNING)],
    first: { time_s: raw.FIRST_TICKS * period_s, speed_e_radps: raw.FIRST_SPEED, wanted_e_radps: raw.FIRST_WANTED },
  };
}
