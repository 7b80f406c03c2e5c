// SPDX-License-Identifier: MIT
// Reads a drive again and again, and sees to it that a stop ends with the bridge off.
import * as captures from "./captures.js";
import * as settings from "./settings.js";
import { Events } from "./events.js";
import { MOVING, readingOf } from "./words.js";

const PERIOD_MS = 40;
const RETRY_MS = 500;
const SLOW_MS = 250; // between readings of what only a master changes
const BRAKING_MS = 10000; // chosen: a shaft that still turns then is left to coast
const STILL_E_RADPS = 5; // chosen: the shaft stands, within the noise of the estimate
const STILL_MS = 500; // chosen: a quick stop that stays enabled at rest ends after this
const SETTLED_MS = 100; // chosen: a stop on its way has arrived
const QUICK_STOP = [0x6f, 0x07]; // mask and bits of the status word: quick stop active

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

export class Watcher {
  /** @param onLook called after each look */
  constructor(drive, onLook) {
    Object.assign(this, { drive, onLook, events: new Events(), trouble: "not connected yet", reading: null });
    Object.assign(this, { constants: null, identity: {}, where: null, command_e_radps: null, slow: 0, recordWanted: null });
    Object.assign(this, { rows: [], generation: 0, startedHere: false, stopping: null, ends: false });
    Object.assign(this, { capture: null, captures: 0, scopeWords: "", setup: null });
    Object.assign(this, { parameters: { words: "", rows: [] }, parametersRead: 0, parametersWanted: false });
  }

  async watch() {
    while (!this.ends) {
      const next = performance.now() + PERIOD_MS;
      try {
        await this.look();
        this.trouble = "";
      } catch (error) {
        Object.assign(this, { trouble: error.message, reading: null, where: null, command_e_radps: null });
      }
      this.onLook();
      await pause(this.trouble ? RETRY_MS : Math.max(next - performance.now(), 0));
    }
  }

  /** A drive is known by its registers first. */
  async read() {
    if (!this.constants) {
      this.identity = await this.drive.require();
      this.constants = await this.drive.values("CONSTANTS");
    }
    return readingOf(await this.drive.values("LIVE"), this.constants.CONTROL_PERIOD);
  }

  async look() {
    const asked = performance.now();
    const reading = await this.read();
    if (this.last && reading.time_s < this.last.time_s) {
      this.rows = [];
      this.generation++;
      this.identity = await this.drive.require();
    }
    this.reading = reading;
    this.last = reading;
    await this.lookAtMotion(asked);
    this.take(reading);
    await this.stopAgain(asked, reading);
    this.startedHere = this.startedHere && reading.mode !== "FAULT";
    await this.lookAtFault(reading);
    await this.lookAtScope();
    if (this.parametersWanted) {
      this.parametersWanted = false;
      this.parameters = await settings.read(this);
      this.parametersRead++;
    }
  }

  async lookAtMotion(asked) {
    if (asked > this.slow + SLOW_MS) {
      this.command_e_radps = (await this.drive.values("COMMAND")).SPEED;
      this.slow = asked;
    }
    if (this.constants.SUPPORTED_MODES & 1) {
      const { POSITION_NOW: now, POSITION_TARGET: target } = await this.drive.values("POSITION");
      this.where = { now, target };
    }
  }

  take(r) {
    const { POLE_PAIRS, ENCODER_POSITIONS } = this.constants;
    const demand = (r.speed_demand_rpm * POLE_PAIRS * Math.PI) / 30;
    const turns = this.where && ENCODER_POSITIONS ? this.where.now / ENCODER_POSITIONS : null;
    this.rows.push([r.time_s, r.speed_e_radps, demand, r.iq_A, r.id_A, r.dc_link_V, turns]);
  }

  /** A drive that was stopped brakes, or its bridge is opened. A reading from before the stop tells nothing. */
  async stopAgain(asked, reading) {
    if (this.stopping === null || asked < this.stopping + SETTLED_MS) {
      return;
    }
    const age = asked - this.stopping;
    const still = Math.abs(reading.speed_e_radps) < STILL_E_RADPS && age > STILL_MS;
    if (![...MOVING, "COMMISSION"].includes(reading.mode)) {
      this.stopping = null;
    } else if ((reading.statusword & QUICK_STOP[0]) !== QUICK_STOP[1] || still || age > BRAKING_MS) {
      await this.drive.off();
    }
  }

  async lookAtFault(reading) {
    this.recordWanted = this.events.see(reading) || this.recordWanted;
    if (this.recordWanted !== null) {
      const number = this.recordWanted;
      this.recordWanted = null;
      this.events.keep(number, await captures.record(this.drive, this.constants.CONTROL_PERIOD));
    }
  }

  async lookAtScope() {
    if (!this.setup) {
      return;
    }
    const state = (await this.drive.values("TRACES")).SCOPE_STATE;
    if (state === captures.DONE) {
      this.capture = await captures.read(this.drive, this.setup, this.constants.CONTROL_PERIOD);
      this.captures++;
    }
    this.scopeWords = captures.STATES[state] || "";
    if (state === captures.DONE || state === 0) {
      this.setup = null; // read; or the drive has restarted, or another master gave up
    }
  }

  /** The motor is started from here; a stop before that is over. */
  begin() {
    this.startedHere = true;
    this.stopping = null;
  }

  /** Brakes, then opens the bridge. Asked once more, it opens the bridge at once. */
  async stop() {
    this.startedHere = false;
    const brake = Boolean(this.reading && this.reading.mode === "RUN" && this.stopping === null);
    this.stopping = performance.now(); // before: a stop that gets lost is sent again
    await this.drive.stopNow(brake);
    this.stopping = performance.now();
    return brake ? "STOP: brakes; once more opens the bridge at once" : "STOP: bridge off";
  }

  /** Stops the motor if it was started here. */
  async release() {
    if (this.startedHere) {
      await this.stop().catch(() => undefined); // it stops by itself
    }
  }

  speedWords(speed_e_radps) {
    const rpm = (speed_e_radps / this.constants.POLE_PAIRS) * (30 / Math.PI);
    return `${rpm.toFixed(0)} r/min (${speed_e_radps.toFixed(1)} rad/s electrical)`;
  }
}
