// SPDX-License-Identifier: MIT
// The parameters: what the drive has, what its numbers mean, and what it shall have.
import { byId, el, numberInput, numberOf, say, short } from "./dom.js";
import { writer } from "./control.js";
import { onUnit, shownAs } from "./units.js";

export class Parameters {
  constructor(page) {
    this.page = page;
    this.number = -1;
    this.rows = [];
    this.fields = new Map();
    this.words = el("p", { id: "parameters-state", role: "status" }, "");
    this.body = el("tbody");
    const head = ["name", "value", "unit", "range", "default", "meaning"].map((word) => el("th", { scope: "col" }, word));
    const table = el("table", {}, el("thead", {}, el("tr", {}, ...head)), this.body);
    const form = el("form", { noValidate: true, "aria-label": "Parameters" }, this.buttons(), this.words, el("div", { className: "wide" }, table));
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      this.page.tried(() => this.write());
    });
    byId("parameters").append(form);
    byId("parameters").addEventListener("toggle", () => this.page.ask("parameters"));
    onUnit(() => this.draw());
  }

  buttons() {
    const button = (words, name) => {
      const one = writer(words, { id: `parameters-${name}` });
      one.addEventListener("click", () => this.page.do(name));
      return one;
    };
    return el(
      "div",
      { className: "row" },
      writer("Write what was changed", { type: "submit", id: "parameters-write", className: "main" }),
      button("Save: the drive restarts", "save"),
      button("Defaults: the drive restarts", "defaults"),
    );
  }

  show(state) {
    if (!state) {
      return;
    }
    say(this.words, state.parameters.words);
    if (state.parameters.number !== this.number) {
      this.number = state.parameters.number;
      this.fetch();
    }
  }

  async fetch() {
    try {
      this.rows = (await this.page.link.get("parameters")).rows;
      this.draw();
    } catch {
      this.number = -1;
    }
  }

  draw() {
    this.fields.clear();
    this.body.replaceChildren(...this.rows.map((row) => this.row(row)));
  }

  row(p) {
    const { name: unit, factor } = shownAs(p.unit);
    const input = p.choices.length
      ? el("select", {}, ...p.choices.map(([number, meaning]) => new Option(`${number}: ${meaning}`, number)))
      : numberInput();
    input.value = p.choices.length ? p.value : short(p.value * factor, 6);
    input.setAttribute("aria-label", `${p.name}${unit ? ` in ${unit}` : ""}`);
    input.id = `parameter-${p.name}`;
    const shown = input.value;
    this.fields.set(p.name, { p, input, factor, shown });
    const range = p.choices.length ? "see the list" : `${short(p.low * factor, 6)} .. ${short(p.high * factor, 6)}`;
    const meaning = `${p.text}${p.stopped ? " Needs a stop." : ""}`;
    const cells = [p.name, input, unit, range, short(p.default * factor, 6), meaning].map((cell) => el("td", {}, cell));
    cells[0].className = "name";
    [, , "unit", "range", "default"].forEach((label, k) => (k === 2 && !unit) || cells[k].setAttribute("data-label", label));
    return el("tr", { className: p.changed ? "changed" : "" }, ...cells);
  }

  /** Those that differ from what the drive has. */
  async write() {
    const values = {};
    for (const [name, { p, input, factor, shown }] of this.fields) {
      if (input.value !== shown) {
        const low = Number((p.low * factor).toPrecision(6));
        values[name] = p.choices.length ? Number(input.value) : numberOf(input, name, low, p.high * factor) / factor;
      }
    }
    if (!Object.keys(values).length) {
      throw new Error("Nothing was changed.");
    }
    await this.page.do("write", { values });
  }
}
