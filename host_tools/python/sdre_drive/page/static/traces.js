// SPDX-License-Identifier: MIT
// The last seconds: what the drive tells, and what the true motor of a virtual drive does.
import { byId, csv, el, keep } from "./dom.js";
import { Stack } from "./plot.js";
import { onUnit, speedColumn, speedName, speedOf } from "./units.js";

const KEPT_S = 120;
const LENGTHS_S = [5, 10, 30, 60];
const PLOT_HEIGHT = 84;
const MOST_ROWS = 30000;
const DRIVE = ["time_s", "speed", "ramp", "iq_A", "id_A", "dc_link_V", "position_turns"];
const TRUTH = ["time_s", "speed", "iq_A", "id_A", "dc_link_V", "torque_Nm", "load_Nm"];

const empty = (names) => Object.fromEntries(names.map((name) => [name, []]));

/** Columns that grow at one end and are cut at the other. */
function append(columns, names, rows) {
  for (const row of rows) {
    names.forEach((name, k) => columns[name].push(row[k]));
  }
  const times = columns.time_s;
  const last = times[times.length - 1];
  if (times.length > MOST_ROWS || (times.length && times[0] < last - 1.2 * KEPT_S)) {
    const first = Math.max(times.findIndex((t) => t >= last - KEPT_S), times.length - MOST_ROWS);
    names.forEach((name) => (columns[name] = columns[name].slice(first)));
  }
}

export class Traces {
  constructor(page) {
    this.page = page;
    this.clear();
    this.held = null; // time of the right end while paused
    const heading = el("div", { className: "heading" }, byId("traces-title"), this.tools());
    byId("traces").append(heading);
    this.stack = new Stack(byId("traces"), "Traces of the last seconds. Arrow keys move a cursor.", PLOT_HEIGHT);
    onUnit(() => this.draw());
  }

  tools() {
    this.hold = el("button", { type: "button", id: "pause", "aria-pressed": "false" }, "Pause");
    this.hold.addEventListener("click", () => this.pause());
    this.length = el("select", { id: "length", "aria-label": "seconds shown" }, ...LENGTHS_S.map((s) => new Option(`${s} s`, s)));
    this.length.value = "10";
    this.length.addEventListener("change", () => this.draw());
    const table = el("button", { type: "button", id: "traces-csv" }, "CSV");
    table.addEventListener("click", () => keep("traces.csv", this.file(), "text/csv"));
    const picture = el("button", { type: "button", id: "traces-png" }, "PNG");
    picture.addEventListener("click", () => this.stack.picture((blob) => keep("traces.png", blob)));
    return el("div", { className: "tools" }, this.hold, this.length, table, picture);
  }

  clear() {
    this.drive = empty(DRIVE);
    this.truth = empty(TRUTH);
  }

  pause() {
    this.held = this.held === null ? this.now() : null;
    this.hold.setAttribute("aria-pressed", String(this.held !== null));
    this.hold.textContent = this.held === null ? "Pause" : "Go on";
    this.stack.look = null;
    this.draw();
  }

  now() {
    const times = this.drive.time_s;
    return times.length ? times[times.length - 1] : 0;
  }

  /** Time of the right end, and of the left. */
  range() {
    const end = this.held === null ? this.now() : this.held;
    return [end - Number(this.length.value), end];
  }

  show(state) {
    if (!state) {
      return;
    }
    const { generation, drive, truth } = state.traces;
    if (generation !== this.generation) {
      this.generation = generation;
      this.clear();
      if (this.held !== null) {
        this.pause();
      }
    }
    append(this.drive, DRIVE, drive);
    append(this.truth, TRUTH, truth);
    if (this.held === null) {
      this.draw();
    }
  }

  draw() {
    if (!this.stack || this.drawn) {
      return;
    }
    this.drawn = true; // once in a frame
    requestAnimationFrame(() => {
      this.drawn = false;
      this.stack.show(this.plots(), this.range());
    });
  }

  plots() {
    const d = this.drive;
    const m = this.truth;
    const speeds = (column) => column.map((x) => (x === null ? null : speedOf(x)));
    const truth = (y) => ({ name: "true motor", colour: 2, x: m.time_s, y });
    const told = (y) => ({ name: "drive", colour: 1, x: d.time_s, y });
    const pair = (name) => (m.time_s.length ? [truth(m[name]), told(d[name])] : [told(d[name])]);
    const speed = [{ name: "ramp", dash: true, x: d.time_s, y: speeds(d.ramp) }, told(speeds(d.speed))];
    const plots = [
      { title: "speed", unit: speedName(), series: m.time_s.length ? [truth(speeds(m.speed)), ...speed] : speed },
      { title: "i_q", unit: "A", series: pair("iq_A") },
      { title: "i_d", unit: "A", series: pair("id_A") },
      { title: "dc link", unit: "V", series: pair("dc_link_V") },
    ];
    if (this.page.facts && this.page.facts.positions) {
      plots.push({ title: "position", unit: "turns", series: [told(d.position_turns)] });
    }
    return plots;
  }

  /** The part that is seen, in the order of time; a source without a sample then has empty cells. */
  file() {
    const [from, to] = this.stack.seen;
    const speed = `speed_${speedColumn()}`;
    const drive = DRIVE.slice(1);
    const truth = TRUTH.slice(1);
    const name = (word) => (word === "speed" ? speed : word === "ramp" ? `ramp_${speedColumn()}` : word);
    const value = (columns, word, k) => (word === "speed" || word === "ramp" ? speedOf(columns[word][k]) : columns[word][k]);
    const rows = [];
    this.drive.time_s.forEach((t, k) => rows.push([t, ...drive.map((w) => value(this.drive, w, k)), ...truth.map(() => null)]));
    this.truth.time_s.forEach((t, k) => rows.push([t, ...drive.map(() => null), ...truth.map((w) => value(this.truth, w, k))]));
    const seen = rows.filter((row) => row[0] >= from && row[0] <= to).sort((one, other) => one[0] - other[0]);
    return csv(["time_s", ...drive.map((w) => `drive_${name(w)}`), ...truth.map((w) => `motor_${name(w)}`)], seen);
  }
}
