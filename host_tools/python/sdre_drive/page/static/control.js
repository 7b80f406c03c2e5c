// SPDX-License-Identifier: MIT
// The arm switch, speed runs, moves, reset.
import { byId, el, field, fixed, follow, numberInput, numberOf, say } from "./dom.js";
import { eRadpsOf, onUnit, speedName, speedOf, unit } from "./units.js";

const FAR_TURNS = 10;
const FIRST_RPM = 1000;
const FIRST_MOVE_RPM = 300;
const RPM_PER_RADPS = 30 / Math.PI;

const first = (rpm) => fixed(unit() === "rpm" ? rpm : rpm / RPM_PER_RADPS, unit() === "rpm" ? 0 : 1);

/** A button that writes: it says so to all who cannot see its colour. */
export function writer(words, properties = {}) {
  return el("button", { type: "button", "data-writes": "", "aria-disabled": "true", ...properties }, words);
}

export class Control {
  constructor(page) {
    this.page = page;
    this.arm = el("button", { type: "button", id: "arm", role: "switch", "aria-checked": "false" }, "");
    this.arm.addEventListener("click", () => this.turn());
    this.note = el("small", {}, "");
    byId("control").append(this.arm, this.note, this.runForm(), this.moveForm(), this.faultRow());
    onUnit(() => this.units());
    this.units();
  }

  runForm() {
    this.speed = numberInput({ id: "speed" });
    this.speed.addEventListener("input", () => (this.typed = true));
    this.speedField = field("speed", this.speed, " ");
    const form = el(
      "form",
      { id: "run-form", noValidate: true, "aria-label": "Run at a speed" },
      this.speedField,
      el("div", { className: "row" }, writer("Run", { type: "submit", id: "run", className: "main" })),
    );
    form.addEventListener("submit", (e) => this.submit(e, () => this.run()));
    return form;
  }

  moveForm() {
    this.turns = numberInput({ id: "turns", value: "1" });
    this.way = el("select", { id: "way" }, new Option("by", "by"), new Option("to", "to"));
    this.moveSpeed = numberInput({ id: "move-speed" });
    this.far = el("input", { type: "checkbox", id: "far" });
    this.moveSpeedField = field("move-speed", this.moveSpeed);
    this.moves = el(
      "form",
      { id: "move-form", noValidate: true, hidden: true, "aria-label": "Move to a position" },
      el("div", { className: "row" }, field("move", this.way), field("turns", this.turns), this.moveSpeedField),
      el("small", {}, "to: from the index mark, or from the alignment"),
      el("div", { className: "row" }, el("label", { className: "check" }, this.far, `more than ${FAR_TURNS} turns`)),
      el("div", { className: "row" }, writer("Move and hold", { type: "submit", id: "move", className: "main" })),
    );
    this.moves.addEventListener("submit", (e) => this.submit(e, () => this.move()));
    return this.moves;
  }

  faultRow() {
    const reset = writer("Reset the fault", { id: "reset" });
    reset.addEventListener("click", () => this.page.do("reset"));
    return el("div", { className: "block" }, el("div", { className: "row" }, reset));
  }

  submit(event, work) {
    event.preventDefault();
    this.page.tried(work);
  }

  know(facts) {
    this.moves.hidden = !facts.positions;
    this.units();
  }

  /** Labels and limits in the unit that is chosen; what was typed begins anew. */
  units() {
    const facts = this.page.facts || {};
    this.speedField.querySelector("label").textContent = `Speed [${speedName()}]`;
    this.moveSpeedField.querySelector("label").textContent = `largest speed [${speedName()}]`;
    this.largest = facts.speed_max_e_radps ? speedOf(facts.speed_max_e_radps) : Infinity;
    this.speedField.querySelector("small").textContent = facts.speed_max_e_radps
      ? `-${fixed(this.largest, 0)} .. ${fixed(this.largest, 0)}; Enter runs`
      : " ";
    this.speed.value = first(FIRST_RPM);
    this.moveSpeed.value = first(FIRST_MOVE_RPM);
    this.typed = false;
  }

  async turn() {
    const armed = this.page.state ? this.page.state.armed : "none";
    if (armed === "me") {
      await this.page.ask("disarm");
    } else {
      await this.page.ask("arm", { take_over: armed === "other" });
    }
  }

  async run() {
    const speed = numberOf(this.speed, "speed", -this.largest, this.largest);
    this.typed = !(await this.page.do("run", { speed_e_radps: eRadpsOf(speed) }));
  }

  async move() {
    const turns = numberOf(this.turns, "turns");
    const speed = numberOf(this.moveSpeed, "largest speed", 0, this.largest);
    const relative = this.way.value === "by";
    const where = this.page.state && this.page.state.where;
    const way = relative || !where ? turns : turns - where.now / this.page.facts.turn_units;
    if (Math.abs(way) > FAR_TURNS && !this.far.checked) {
      throw new Error(`That is ${fixed(way, 1)} turns from here. Allow "more than ${FAR_TURNS} turns" first.`);
    }
    await this.page.do("move", { turns, relative, far: this.far.checked, speed_e_radps: eRadpsOf(speed) });
    this.far.checked = false;
  }

  show(state) {
    const armed = state ? state.armed : "none";
    const words = {
      me: "This window is armed",
      other: "Take over: another is armed",
      none: "Arm this window",
    };
    say(this.arm, words[armed]);
    this.arm.setAttribute("aria-checked", String(armed === "me"));
    const noted = { me: "Disarming stops a motor that was started here.", other: "One window is armed at a time. STOP always works.", none: "Only an armed window writes to the drive. STOP always works." };
    say(this.note, noted[armed]);
    this.follow(state);
  }

  /** The field has what the drive was told last, unless somebody types. */
  follow(state) {
    const r = state && state.reading;
    const runs = r && r.mode_of_operation === 3 && ["RUN", "ALIGN", "PRECHARGE"].includes(r.mode);
    if (runs && state.command_e_radps !== null) {
      follow(this.speed, this.typed, fixed(speedOf(state.command_e_radps), unit() === "rpm" ? 0 : 1));
    }
  }
}
