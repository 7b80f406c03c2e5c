// SPDX-License-Identifier: MIT
// The page's way to a drive without a server: a line of octets to it. It has the methods of HttpLink.
import * as actions from "./actions.js";
import { Drive } from "./drive.js";
import { Master } from "./master.js";
import { SerialLine } from "./serial_line.js";
import { SIGNALS } from "./tables.js";
import { TRIGGERS } from "./captures.js";
import { Watcher } from "./watcher.js";

const NAME_OBJECTS = { name: 0x80, digest: 0x81, board: 0x83 }; // of function 43/14

export class DirectLink {
  constructor(onState) {
    Object.assign(this, { onState, watcher: null, armed: false, seen: 0, job: null, faults: [], actions });
    this.lacks = {
      commission: "Needs the program: sdre-drive commission, or its page. This page has no server.",
      image: "Needs the program: sdre-drive load, or its page. This page has no server.",
    };
    document.addEventListener("visibilitychange", () => document.hidden && this.watcher && this.watcher.release());
  }

  /** From now on this drive, until its line ends. */
  use(line, unit, timeout_ms, gone) {
    const watcher = new Watcher(new Drive(new Master(line, unit, timeout_ms)), () => this.tell());
    line.onEnd = () => {
      watcher.ends = true;
      this.watcher = this.watcher === watcher ? null : this.watcher;
      this.onState(null, gone);
    };
    this.watcher = watcher;
    watcher.watch();
  }

  tell() {
    const w = this.watcher;
    if (!w) {
      return;
    }
    const rows = w.rows;
    w.rows = [];
    this.onState({
      reading: w.reading,
      trouble: w.trouble,
      command_e_radps: w.command_e_radps,
      where: w.where,
      bench: this.bench(),
      armed: this.armed ? "me" : "none",
      viewers: 1,
      job: this.job,
      scope: { words: w.scopeWords, number: w.captures },
      parameters: { words: w.parameters.words, number: w.parametersRead },
      history: w.events.number,
      traces: { generation: w.generation, drive: rows, truth: this.truth() },
    }, "");
  }

  /** Nothing is known beside a real drive. */
  bench() {
    return null;
  }

  truth() {
    return [];
  }

  /** The drive that answers. Throws without one. */
  require() {
    if (!this.watcher || !this.watcher.reading) {
      throw new Error(`the drive does not answer: ${this.watcher ? this.watcher.trouble : "connect its port first"}`);
    }
    return this.watcher;
  }

  async do(name, args = {}) {
    if (name === "arm" || name === "disarm") {
      this.armed = name === "arm";
      if (!this.armed && this.watcher) {
        await this.watcher.release();
      }
      return "";
    }
    if (name === "parameters") {
      (this.watcher || {}).parametersWanted = true;
      return "";
    }
    const action = this.actions[name];
    if (!action) {
      throw new Error("this needs the program sdre-drive");
    }
    return action(this.require(), args, this);
  }

  /** A stop goes before all that waits. */
  async stop() {
    if (!this.watcher) {
      throw new Error("STOP did not arrive: no port is connected. Use the emergency stop.");
    }
    try {
      return await this.watcher.stop();
    } catch (error) {
      throw new Error(`STOP did not arrive: ${error.message}. Use the emergency stop.`);
    }
  }

  async get(what) {
    const w = this.require();
    if (what === "facts") {
      return this.facts(w);
    }
    if (what === "history") {
      return w.events.all.map((event) => ({ ...event, record: Boolean(event.record) }));
    }
    if (what.startsWith("record/")) {
      return w.events.all.find((event) => event.number === Number(what.slice(7))).record;
    }
    return what === "scope" ? w.capture : w.parameters;
  }

  facts(w) {
    const of = w.constants;
    const named = Object.entries(NAME_OBJECTS).map(([name, object]) => [name, w.identity[object] || ""]);
    return {
      ...Object.fromEntries(named),
      target: w.drive.master.line.words,
      pole_pairs: of.POLE_PAIRS,
      period_s: of.CONTROL_PERIOD,
      speed_max_e_radps: of.SPEED_MAX,
      current_max_A: of.CURRENT_MAX,
      turn_units: of.TURN_UNITS,
      positions: Boolean(of.SUPPORTED_MODES & 1),
      signals: SIGNALS.slice(1),
      triggers: TRIGGERS,
      faults: this.faults,
    };
  }
}
