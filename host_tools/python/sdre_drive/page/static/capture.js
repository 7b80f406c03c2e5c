// SPDX-License-Identifier: MIT
// A capture of the scope, or the record of a fault: plots, CSV, PNG.
import { csv, el, keep } from "./dom.js";
import { Stack } from "./plot.js";
import { onUnit, shownAs } from "./units.js";

const PLOT_HEIGHT = 96;
const MS = { name: "ms", factor: 1000 };

export class Capture {
  constructor(parent, name, file) {
    this.file = file;
    this.found = null;
    this.box = el("div", { className: "capture", hidden: true });
    const table = el("button", { type: "button", className: "csv" }, "CSV");
    table.addEventListener("click", () => keep(`${this.file}.csv`, this.table(), "text/csv"));
    const picture = el("button", { type: "button", className: "png" }, "PNG");
    picture.addEventListener("click", () => this.stack.picture((blob) => keep(`${this.file}.png`, blob)));
    const all = el("button", { type: "button" }, "Show all");
    all.addEventListener("click", () => this.stack.closer(null));
    this.title = el("strong", {}, "");
    this.box.append(el("div", { className: "heading" }, this.title, el("div", { className: "tools" }, all, table, picture)));
    parent.append(this.box);
    this.stack = new Stack(this.box, `${name}. Drag, or + and -, to look closer. Arrow keys move a cursor.`, PLOT_HEIGHT);
    onUnit(() => this.draw());
  }

  show(found, title) {
    this.found = found;
    this.title.textContent = title;
    this.box.hidden = !found;
    this.stack.look = null;
    this.draw();
  }

  /** Values of a signal in the unit of the page. */
  column(k) {
    const { factor } = shownAs(this.found.signals[k].unit);
    return this.found.values[k].map((x) => factor * x);
  }

  draw() {
    if (!this.found) {
      return;
    }
    const { signals, time_s: x } = this.found;
    const plots = signals.map((s, k) => ({
      title: s.name,
      unit: shownAs(s.unit).name,
      series: [{ name: s.name, colour: (k % 4) + 1, step: true, x, y: this.column(k) }],
    }));
    this.stack.show(plots, [x[0], x[x.length - 1]], MS);
  }

  table() {
    const { signals, time_s: times } = this.found;
    const columns = signals.map((_, k) => this.column(k));
    const head = signals.map((s) => (s.unit ? `${s.name} [${shownAs(s.unit).name}]` : s.name));
    return csv(["time_s", ...head], times.map((t, n) => [t, ...columns.map((column) => column[n])]));
  }
}
