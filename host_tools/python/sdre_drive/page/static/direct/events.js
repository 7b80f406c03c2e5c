// SPDX-License-Identifier: MIT
// Events of the drive while the page watched: faults with their records, restarts, stops by silence.
import { entry, oneLine } from "./words.js";

const MOST = 50; // chosen: more than a screen shows
const SILENT = 2; // condition: the master was silent

export class Events {
  constructor() {
    Object.assign(this, { number: 0, all: [], before: null });
  }

  /** Notes what is new in a reading. The number of a new fault: its record is to be fetched. */
  see(reading) {
    const { before } = this;
    this.before = reading;
    if (before && reading.time_s < before.time_s) {
      this.note(reading, "restart", `the drive has restarted: ${reading.reset_words}`, []);
    }
    if (reading.mode === "FAULT" && (!before || before.mode !== "FAULT")) {
      const { faults } = reading;
      return this.note(reading, "fault", faults.length ? oneLine(faults[0]) : "a fault", faults);
    }
    if (before && reading.conditions & SILENT && !(before.conditions & SILENT)) {
      const silent = entry("condition", SILENT);
      this.note(reading, "stop", oneLine(silent), [silent]);
    }
    return null;
  }

  /** The periods before a fault. */
  keep(number, record) {
    this.all.filter((event) => event.number === number).forEach((event) => (event.record = record));
    this.number++;
  }

  note(reading, kind, what, entries) {
    const at = kind === "fault" ? reading.first : { ...reading, wanted_e_radps: null };
    const { time_s, speed_e_radps, wanted_e_radps } = at;
    const clock = new Date().toTimeString().slice(0, 8);
    this.number++;
    this.all.unshift({ number: this.number, kind, what, clock, time_s, speed_e_radps, wanted_e_radps, entries, record: null });
    this.all.length = Math.min(this.all.length, MOST);
    return this.number;
  }
}
