// SPDX-License-Identifier: MIT
// The present state of the drive: its mode, figures, faults and warnings.
import { byId, el, fixed, say } from "./dom.js";
import { speedName, speedOf, speedOfRpm } from "./units.js";

const TONES = { RUN: "good", FAULT: "bad", READY: "idle" };
const MOVING = ["PRECHARGE", "ALIGN", "RUN", "STOP"];
const POSITION = 1; // mode of operation

export class Now {
  constructor(page) {
    this.page = page;
    this.figures = new Map();
    this.shown = "";
  }

  show(state) {
    const r = state && state.reading;
    const mode = r ? r.mode : "NO DRIVE";
    say(byId("mode"), mode);
    byId("mode").className = `badge ${TONES[mode] || ""}`;
    say(byId("words"), r ? r.mode_words : this.page.trouble);
    byId("words").classList.toggle("wrong", !r);
    this.showFigures(r, state || {});
    this.showMessages(r ? r.messages : []);
  }

  showFigures(r, state) {
    const facts = this.page.facts || {};
    const decimals = speedName() === "r/min" ? 0 : 1;
    const speed = (x) => (x === null ? "-" : `${fixed(x, decimals)} ${speedName()}`);
    const turns = (units) => (state.where && facts.turn_units ? fixed(units / facts.turn_units, 2) : "-");
    const percent = (x) => (r ? `${fixed(100 * x, 0)} %` : "-");
    const positions = r && r.mode_of_operation === POSITION;
    const moves = r && MOVING.includes(r.mode);
    const known = (value, decimalsOf, unit) => (r ? `${fixed(value, decimalsOf)} ${unit}` : "-");
    this.put("speed", r ? speed(speedOf(r.speed_e_radps)) : "-");
    this.put("reference", moves && state.command_e_radps !== null && !positions ? speed(speedOf(state.command_e_radps)) : "-");
    this.put("after its ramp", moves ? speed(speedOfRpm(r.speed_demand_rpm)) : "-");
    this.put("position", state.where ? `${turns(state.where.now)} turns` : "-");
    this.put("target", state.where && positions && moves ? `${turns(state.where.target)} turns` : "-");
    this.put("i_q", known(r && r.iq_A, 2, "A"));
    this.put("i_d", known(r && r.id_A, 2, "A"));
    this.put("dc link", known(r && r.dc_link_V, 0, "V"));
    this.put("heat sink", known(r && r.temperature_degC, 0, "°C"));
    this.put("heat of motor", percent(r && r.motor_heat));
    this.put("heat of inverter", percent(r && r.inverter_heat));
    this.put("last start by", r ? ["power on", "its watchdog"][r.reset_cause] || "-" : "-");
    this.put("windows open", state.viewers ? String(state.viewers) : "-");
  }

  put(name, text) {
    if (!this.figures.has(name)) {
      const value = el("dd");
      byId("figures").append(el("div", {}, el("dt", {}, name), value));
      this.figures.set(name, value);
    }
    say(this.figures.get(name), text);
  }

  /** Built again only when something came or went; the alarm is read aloud then. */
  showMessages(entries) {
    const names = entries.map((e) => `${e.group} ${e.number}`).join();
    if (names === this.shown && byId("entries").children.length) {
      return;
    }
    this.shown = names;
    byId("alarm").textContent = entries.map((e) => `${e.name}: ${e.meaning}`).join(" ");
    byId("entries").replaceChildren(...(entries.length ? entries.map(entryCard) : [el("p", { className: "soft" }, "None.")]));
    byId("messages").scrollTop = 0;
  }
}

/** A fault or condition with causes and checks. */
export function entryCard(entry) {
  const list = (title, lines) => el("div", {}, el("small", {}, title), el("ul", {}, ...lines.map((line) => el("li", {}, line))));
  return el(
    "div",
    { className: `entry ${entry.group}` },
    el("strong", {}, `${entry.group} ${entry.number} ${entry.name}`),
    el("p", {}, entry.meaning),
    list("Causes", entry.causes),
    list("Check", entry.check),
  );
}
