// SPDX-License-Identifier: MIT
// The drive's oscilloscope: what to take, and what was taken.
import { byId, el, field, numberInput, numberOf, say } from "./dom.js";
import { Capture } from "./capture.js";
import { writer } from "./control.js";
import { onUnit, shownAs } from "./units.js";

const FIRST = ["SPEED", "SPEED_WANTED", "IQ", "DC_LINK"];
const NOTHING = "-";

export class Scope {
  constructor(page) {
    this.page = page;
    this.number = 0;
    this.words = el("p", { id: "scope-state", role: "status" }, "");
    byId("scope").append(this.form(), this.words);
    this.capture = new Capture(byId("scope"), "Scope", "scope");
    onUnit(() => this.units());
  }

  form() {
    this.signals = FIRST.map((_, k) => el("select", { id: `signal-${k + 1}` }));
    this.every = numberInput({ id: "every", value: "1" });
    this.trigger = el("select", { id: "trigger" });
    this.channel = el("select", { id: "channel" }, ...[1, 2, 3, 4].map((n) => new Option(n, n)));
    this.channel.addEventListener("change", () => this.units());
    this.level = numberInput({ id: "level", value: "0" });
    this.levelField = field("level", this.level);
    this.before = numberInput({ id: "before", value: "100" });
    this.signals.forEach((select) => select.addEventListener("change", () => this.units()));
    const form = el(
      "form",
      { noValidate: true, "aria-label": "Settings of the scope" },
      el("div", { className: "row" }, ...this.signals.map((select, k) => field(`signal ${k + 1}`, select))),
      el(
        "div",
        { className: "row" },
        field("every .. periods", this.every),
        field("trigger", this.trigger),
        field("of signal", this.channel),
        this.levelField,
        field("samples before", this.before),
      ),
      el("div", { className: "row" }, writer("Take", { type: "submit", id: "take", className: "main" })),
    );
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      this.page.tried(() => this.take());
    });
    return form;
  }

  know(facts) {
    if (this.units_ === undefined) {
      this.units_ = Object.fromEntries(facts.signals.map((s) => [s.name, s.unit]));
      this.signals.forEach((select, k) => {
        select.replaceChildren(new Option(NOTHING, NOTHING), ...facts.signals.map((s) => new Option(s.name, s.name)));
        select.value = FIRST[k];
      });
      this.trigger.replaceChildren(...facts.triggers.map((name) => new Option(name, name)));
    }
    this.units();
  }

  /** Unit of the signal that triggers. */
  unit() {
    const names = this.signals.map((s) => s.value).filter((name) => name !== NOTHING);
    return shownAs((this.units_ || {})[names[Number(this.channel.value) - 1]] || "");
  }

  units() {
    const { name } = this.unit();
    this.levelField.querySelector("label").textContent = name ? `level [${name}]` : "level";
  }

  async take() {
    const signals = this.signals.map((s) => s.value).filter((name) => name !== NOTHING);
    if (Number(this.channel.value) > signals.length) {
      throw new Error(`The signal that triggers is number ${this.channel.value} of ${signals.length}.`);
    }
    await this.page.do("scope", {
      signals,
      decimation: Math.round(numberOf(this.every, "every .. periods", 1, 65535)),
      trigger: this.trigger.value,
      channel: Number(this.channel.value),
      level: numberOf(this.level, "level") / this.unit().factor,
      before: Math.round(numberOf(this.before, "samples before", 0, 511)),
    });
  }

  show(state) {
    if (!state) {
      return;
    }
    say(this.words, state.scope.words ? `The scope: ${state.scope.words}.` : "");
    if (state.scope.number !== this.number) {
      this.number = state.scope.number;
      this.fetch();
    }
  }

  async fetch() {
    try {
      const found = await this.page.link.get("scope");
      this.capture.show(found, found ? `${found.time_s.length} samples` : "");
    } catch {
      this.number = -1; // with the next state
    }
  }
}
