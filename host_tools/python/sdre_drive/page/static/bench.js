// SPDX-License-Identifier: MIT
// The bench of a virtual drive. Everything shown is what the bench tells, whoever changed it.
import { byId, el, field, fixed, follow, numberInput, numberOf, say } from "./dom.js";
import { speedName, speedOf } from "./units.js";
import { writer } from "./control.js";

const SLIDER_SHARE = 0.25; // of the bench's limit: about that of the motor at its current limit

export class Bench {
  constructor(page) {
    this.page = page;
    this.kind = el("select", { id: "load-kind" }, new Option("brake", "brake"), new Option("active", "active"));
    this.kind.addEventListener("change", () => (this.kindTyped = true));
    this.slider = el("input", { type: "range", id: "load-slider", step: 0.05, "aria-label": "load in newton metres" });
    this.slider.addEventListener("input", () => this.soon());
    this.load = numberInput({ id: "load" });
    this.load.addEventListener("input", () => (this.typed = true));
    this.supply = numberInput({ id: "supply" });
    this.supply.addEventListener("input", () => (this.supplyTyped = true));
    this.fault = el("select", { id: "fault" });
    this.figures = el("p", { id: "truth" }, "");
    this.broken = el("p", { id: "broken" }, "");
    this.pace = el("p", { id: "pace", className: "soft" }, "");
    const state = el("div", { id: "bench-state" }, this.figures, this.broken, this.pace);
    byId("bench").append(state, this.loadForm(), this.supplyForm(), this.faultForm());
  }

  form(id, name, work, ...parts) {
    const form = el("form", { id, noValidate: true, "aria-label": name }, ...parts);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.page.tried(work);
    });
    return form;
  }

  loadForm() {
    const set = writer("Set", { type: "submit", id: "set-load" });
    const row = el("div", { className: "row" }, field("Load [N m]", this.load), field("kind", this.kind), set);
    return this.form("load-form", "Load", () => this.setLoad(), row, this.slider);
  }

  supplyForm() {
    const set = writer("Set", { type: "submit", id: "set-supply" });
    const row = el("div", { className: "row" }, field("Supply [V]", this.supply), set);
    return this.form("supply-form", "Supply", () => this.setSupply(), row);
  }

  faultForm() {
    const mend = writer("Mend all", { id: "mend" });
    mend.addEventListener("click", () => this.page.do("mend"));
    const power = writer("Power off and on", { id: "power-cycle" });
    power.addEventListener("click", () => this.page.do("power_cycle"));
    const row = el("div", { className: "row" }, writer("Break it", { type: "submit", id: "break" }), mend, power);
    const fault = field("Break", this.fault, "Mend all: nothing is broken, load 0");
    return this.form("fault-form", "Faults", () => this.page.do("break", { fault: this.fault.value }), fault, row);
  }

  know(facts) {
    if (!this.fault.options.length) {
      this.fault.replaceChildren(...facts.faults.map((name) => new Option(name, name)));
    }
  }

  async setLoad() {
    const load_Nm = numberOf(this.load, "load", -1e5, 1e5);
    this.typed = !(await this.page.do("load", { load_Nm, kind: this.kind.value }));
    this.kindTyped = this.typed;
  }

  async setSupply() {
    const voltage = numberOf(this.supply, "supply", 1, 1e4);
    this.supplyTyped = !(await this.page.do("dc_link", { dc_link_V: voltage }));
  }

  /** The slider is dragged: the last place is sent when the one before has arrived. */
  async soon() {
    this.wanted = Number(this.slider.value);
    if (this.sending) {
      return;
    }
    this.sending = true;
    while (this.wanted !== null) {
      const load_Nm = this.wanted;
      this.wanted = null;
      await this.page.do("load", { load_Nm, kind: this.kind.value });
    }
    this.sending = false;
  }

  show(state) {
    const truth = state && state.bench;
    if (!truth) {
      say(this.figures, "The bench does not answer.");
      say(this.pace, "");
      return;
    }
    byId("bench").hidden = false; // and stays: nothing moves when the bench is late
    say(
      this.figures,
      `True motor: ${fixed(speedOf(truth.speed_e_radps), 0)} ${speedName()}, torque ${fixed(truth.torque_Nm, 2)} N m, ` +
        `load ${fixed(truth.load_Nm, 2)} N m, ${fixed(truth.dc_link_V, 0)} V.`,
    );
    this.showBroken(truth);
    say(this.pace, `Simulated time runs at ${fixed(truth.real_time_factor, 2)} of the clock.`);
    this.showSettings(truth);
  }

  showBroken(truth) {
    say(this.broken, `Broken: ${truth.broken.join(", ") || "nothing"}. ${truth.note}`.trim());
  }

  /** A field follows the bench unless somebody types into it. */
  showSettings(truth) {
    follow(this.kind, this.kindTyped, truth.load_kind);
    follow(this.load, this.typed, fixed(truth.load_Nm, 2));
    follow(this.supply, this.supplyTyped, fixed(truth.source_V, 0));
    const most = Math.max(SLIDER_SHARE * truth.load_most_Nm, Math.abs(truth.load_Nm));
    this.slider.max = most;
    this.slider.min = this.kind.value === "brake" ? 0 : -most;
    this.slider.step = most / 50;
    if (!this.sending) {
      this.slider.value = truth.load_Nm;
    }
  }
}
