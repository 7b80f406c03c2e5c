// SPDX-License-Identifier: MIT
// The page's way to a virtual drive that runs in the page itself.
import * as actions from "./actions.js";
import { Bench } from "./bench.js";
import { DirectLink } from "./link.js";
import { SimulatedLine } from "./simulated_line.js";
import { BENCH_FAULTS } from "./tables.js";

const SILENT_MS = 200;
const UNIT = 1; // address of every shipped drive
const LOOK_MS = 40; // as the drive itself

export class SimulatedLink extends DirectLink {
  /** @param name of a shipped drive */
  constructor(onState, name) {
    super(onState);
    this.faults = Object.keys(BENCH_FAULTS);
    this.begin(name).catch((error) => onState(null, error.message));
  }

  async begin(name) {
    const line = await SimulatedLine.open(name);
    this.beside = new Bench(line);
    this.actions = { ...actions, ...this.beside.actions() };
    this.use(line, UNIT, SILENT_MS, "the virtual drive has ended: load the page again");
    this.look();
  }

  async look() {
    const { watcher } = this;
    let generation = 0;
    while (!watcher.ends) {
      if (generation !== watcher.generation) {
        ({ generation } = watcher);
        this.beside.forget();
      }
      await this.beside.look(watcher.reading && watcher.reading.time_s);
      await new Promise((done) => setTimeout(done, LOOK_MS));
    }
  }

  bench() {
    return this.beside.state;
  }

  truth() {
    return this.beside.take();
  }
}
