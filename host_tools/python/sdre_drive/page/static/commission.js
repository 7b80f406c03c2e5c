// SPDX-License-Identifier: MIT
// The drive finds its motor: bounds, progress, and the file of what it found.
import { byId, el, field, fixed, keep, numberInput, numberOf } from "./dom.js";
import { writer } from "./control.js";
import { JobView } from "./job.js";
import { mRadpsOf, onUnit, speedName, speedOf, unit } from "./units.js";

const CURRENT_SHARE = 0.75; // of the drive's limit, proposed
const SPEED_SHARE = 0.5;

export class Commission {
  constructor(page) {
    this.page = page;
    this.current = numberInput({ id: "commission-current" });
    this.speed = numberInput({ id: "commission-speed" });
    this.currentField = field("largest current [A], peak", this.current, " ");
    this.speedField = field("largest speed", this.speed, " ");
    const form = el(
      "form",
      { noValidate: true, "aria-label": "Commissioning" },
      el("p", {}, "The shaft turns both ways and has to be free. It takes about a minute. STOP ends it with the bridge off."),
      el("div", { className: "row" }, this.currentField, this.speedField),
      el("div", { className: "row" }, writer("Find the motor", { type: "submit", id: "commission-start", className: "main" })),
    );
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      this.page.tried(() => this.start());
    });
    this.file = el("button", { type: "button", id: "commission-file", hidden: true }, "Keep the file");
    this.file.addEventListener("click", () => this.page.tried(() => this.fetch()));
    this.job = new JobView(["commissioning"]);
    byId("commission").append(form, this.job.box, this.file);
    onUnit(() => this.units());
  }

  know() {
    this.units();
  }

  units() {
    const facts = this.page.facts || {};
    if (!facts.current_max_A) {
      return;
    }
    const largest = speedOf(facts.speed_max_e_radps);
    this.currentField.querySelector("small").textContent = `up to ${fixed(facts.current_max_A, 2)} A`;
    this.speedField.querySelector("label").textContent = `largest speed [${speedName()}]`;
    this.speedField.querySelector("small").textContent = "of the shaft";
    this.current.value = fixed(CURRENT_SHARE * facts.current_max_A, 2);
    this.speed.value = fixed(SPEED_SHARE * largest, unit() === "rpm" ? 0 : 1);
  }

  async start() {
    const current = numberOf(this.current, "largest current", 0.01, this.page.facts.current_max_A);
    const speed = numberOf(this.speed, "largest speed", 0.01);
    await this.page.do("commission", { current_A: current, speed_m_radps: mRadpsOf(speed) });
  }

  async fetch() {
    const found = await this.page.link.get("result");
    keep(found.name, found.text);
  }

  show(state) {
    const job = state && state.job;
    this.job.show(job);
    this.file.hidden = !(job && job.name === "commissioning" && job.file_name);
  }
}
