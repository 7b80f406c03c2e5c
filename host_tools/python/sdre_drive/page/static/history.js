// SPDX-License-Identifier: MIT
// Events since the page's program was started: faults with the periods before them, restarts, stops by silence.
import { byId, el, fixed } from "./dom.js";
import { Capture } from "./capture.js";
import { entryCard } from "./now.js";
import { onUnit, speedName, speedOf } from "./units.js";

export class History {
  constructor(page) {
    this.page = page;
    this.number = -1;
    this.events = [];
    this.list = el("ul", { className: "list", id: "events" });
    byId("history").append(this.list);
    this.capture = new Capture(byId("history"), "The last periods before a fault", "fault");
    this.draw();
    onUnit(() => this.draw());
  }

  show(state) {
    if (state && state.history !== this.number) {
      this.number = state.history;
      this.fetch();
    }
  }

  async fetch() {
    try {
      const first = this.newest === undefined;
      this.events = await this.page.link.get("history");
      const newest = this.events[0];
      if (newest && newest.number !== this.newest && newest.kind !== "fault" && !first) {
        this.page.say(newest.what); // a fault is shown by its card
      }
      this.newest = newest ? newest.number : 0;
      this.draw();
    } catch {
      this.number = -1;
    }
  }

  draw() {
    const rows = this.events.map((event) => this.row(event));
    this.list.replaceChildren(...(rows.length ? rows : [el("li", { className: "soft" }, "Nothing has happened yet.")]));
  }

  row(event) {
    const speed = (x) => `${fixed(speedOf(x), 0)} ${speedName()}`;
    const wanted = event.wanted_e_radps === null ? "" : `, reference ${speed(event.wanted_e_radps)}`;
    const row = el(
      "li",
      {},
      el("strong", {}, event.what),
      el("p", { className: "soft" }, `${event.clock}, ${fixed(event.time_s, 4)} s after its start, at ${speed(event.speed_e_radps)}${wanted}`),
    );
    if (event.record) {
      const button = el("button", { type: "button", className: "record" }, "Show the periods before it");
      button.addEventListener("click", () => this.record(event));
      row.append(button);
    }
    if (event.entries.length) {
      row.append(el("details", {}, el("summary", {}, "Causes and checks"), ...event.entries.map(entryCard)));
    }
    return row;
  }

  async record(event) {
    await this.page.tried(async () => {
      const found = await this.page.link.get(`record/${event.number}`);
      this.capture.show(found, `Before ${event.what.split(":")[0]}, ${event.clock}`);
    });
  }
}
