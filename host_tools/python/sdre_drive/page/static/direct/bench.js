// SPDX-License-Identifier: MIT
// The bench of a virtual drive in this page: what it tells, and its actions by the names that the program's server has too.
import { BENCH_FAULTS } from "./tables.js";

const COLUMNS = ["time_s", "speed_e_radps", "iq_A", "id_A", "dc_link_V", "torque_Nm", "load_Nm"];
const STEP_S = 5e-3; // the bench has a sample per millisecond; a screen shows less
const LOOK_S = 0.5; // of its record with each look; longer than the longest pause between two

/** A fault of the bench's state ("phase_open a") in words. */
function wordsOf(broken) {
  const [kind, phase] = broken.split(" ");
  const is = (line) => line.includes(`"${kind}"`) && (!phase || line.includes(`phase = "${phase}"`));
  const found = Object.entries(BENCH_FAULTS).find(([, line]) => is(line));
  return found ? found[0] : broken;
}

export class Bench {
  constructor(line) {
    Object.assign(this, { line, state: null, rows: [] });
    this.forget();
  }

  /** The drive has restarted: its time begins again. */
  forget() {
    Object.assign(this, { until_s: -1, ahead_s: Infinity });
  }

  /** Asks for state and record; new samples are at the drive's time. */
  async look(drive_time_s) {
    await this.tell("state");
    const trace = await this.line.control(`trace ${LOOK_S}`);
    if (drive_time_s === null) {
      return;
    }
    this.ahead_s = Math.min(this.ahead_s, this.state.time_s - drive_time_s); // asked later: the least is the nearest
    trace.time_s.forEach((t, k) => {
      if (t >= this.until_s + STEP_S) {
        this.until_s = t;
        this.rows.push(COLUMNS.map((name) => (name === "time_s" ? t - this.ahead_s : trace[name][k])));
      }
    });
  }

  async tell(command) {
    const told = await this.line.control(command);
    this.state = { ...told, broken: told.broken.map(wordsOf) };
    return told;
  }

  /** The samples since the last call. */
  take() {
    const { rows } = this;
    this.rows = [];
    return rows;
  }

  actions() {
    return {
      load: async (_watcher, { load_Nm, kind }) => {
        await this.tell(`load ${load_Nm} ${kind}`);
        return "";
      },
      dc_link: async (_watcher, { dc_link_V }) => {
        await this.tell(`dc_link ${dc_link_V}`);
        return `the supply has ${dc_link_V} V`;
      },
      break: async (_watcher, { fault }) => {
        const { note } = await this.tell(BENCH_FAULTS[fault]);
        return note ? `broken: ${fault}; ${note}` : `broken: ${fault}`;
      },
      mend: async () => {
        await this.tell("mend");
        return "all is whole, without load";
      },
      power_cycle: async () => {
        await this.tell("power_cycle");
        return "power off and on";
      },
    };
  }
}
