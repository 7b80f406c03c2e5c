// SPDX-License-Identifier: MIT
// Puts the page together: one link to the drive, and cards that show its states.
import { byId, el, say } from "./dom.js";
import { SerialLink } from "./direct/serial_link.js";
import { SimulatedLink } from "./direct/simulated_link.js";
import { HttpLink } from "./link.js";
import { chooseUnit, onUnit, unit, usePolePairs } from "./units.js";
import { Bench } from "./bench.js";
import { Commission } from "./commission.js";
import { Connect } from "./connect.js";
import { Control } from "./control.js";
import { History } from "./history.js";
import { Image } from "./image.js";
import { Now } from "./now.js";
import { Parameters } from "./parameters.js";
import { Scope } from "./scope.js";
import { Traces } from "./traces.js";

/** The page's address chooses: sdre-drive's server, a serial port, or a drive in the page itself. */
function linkOf(address, onState) {
  const drive = address.get("drive");
  if (drive === "simulated") {
    return new SimulatedLink(onState, address.get("name") || "ipmsm_390w");
  }
  return drive === "serial" ? new SerialLink(onState) : new HttpLink(onState);
}

class Page {
  constructor() {
    this.state = null;
    this.facts = null;
    this.link = linkOf(new URLSearchParams(location.search), (state, why) => this.take(state, why));
    this.cards = [Connect, Now, Control, Bench, Traces, Scope, History, Parameters, Commission, Image].map((Card) => new Card(this));
    Object.entries(this.link.lacks).forEach(([id, why]) => this.unable(id, why));
    byId("stop").addEventListener("click", () => this.stop());
    byId("unit").value = unit();
    byId("unit").addEventListener("change", (e) => chooseUnit(e.target.value));
    onUnit(() => this.show());
    window.addEventListener("keydown", (e) => this.key(e), true);
    window.addEventListener("keyup", (e) => this.key(e), true);
  }

  /** Switches a card off and says why. */
  unable(id, why) {
    byId(id).querySelectorAll("input, select, button").forEach((input) => (input.disabled = true));
    byId(id).querySelector("summary").after(el("p", { className: "lacks" }, why));
  }

  /** The space bar stops, wherever the focus is: it never presses a button and never types. */
  key(e) {
    if (e.code !== "Space" || e.ctrlKey || e.altKey || e.metaKey) {
      return;
    }
    e.preventDefault();
    e.stopImmediatePropagation();
    if (e.type === "keydown" && !e.repeat) {
      this.stop();
    }
  }

  async stop() {
    try {
      this.say(await this.link.stop());
    } catch (error) {
      this.say(error.message, true);
    }
  }

  get armed() {
    return this.state !== null && this.state.armed === "me";
  }

  /** An action of a card that writes; whether it was done. */
  async do(name, args = {}) {
    if (!this.armed) {
      this.say("Arm this window first.", true);
      return false;
    }
    return this.ask(name, args);
  }

  /** An action that needs no arm switch. */
  async ask(name, args = {}) {
    try {
      const said = await this.link.do(name, args);
      if (said) {
        this.say(said);
      }
      return true;
    } catch (error) {
      this.say(error.message, true);
      return false;
    }
  }

  /** Does the work of a form: a wrong field is named, and nothing is sent. */
  async tried(work) {
    try {
      return await work();
    } catch (error) {
      this.say(error.message, true);
      return false;
    }
  }

  say(text, wrong = false) {
    byId("said").classList.toggle("wrong", wrong);
    byId("said").textContent = text;
  }

  take(state, why) {
    this.state = state;
    this.trouble = state ? state.trouble : why;
    if (state && state.reading && (this.facts === null || this.generation !== state.traces.generation)) {
      this.generation = state.traces.generation;
      this.fetchFacts();
    }
    this.show();
  }

  async fetchFacts() {
    try {
      this.facts = await this.link.get("facts");
      usePolePairs(this.facts.pole_pairs);
      say(byId("target"), `${this.facts.name} at ${this.facts.target}`);
      this.cards.forEach((card) => card.know && card.know(this.facts));
      this.show();
    } catch {
      this.generation = undefined; // with the next state
    }
  }

  show() {
    const armed = String(!this.armed);
    for (const button of document.querySelectorAll("[data-writes]")) {
      if (button.getAttribute("aria-disabled") !== armed) {
        button.setAttribute("aria-disabled", armed);
      }
    }
    this.cards.forEach((card) => card.show(this.state));
  }
}

window.page = new Page();
