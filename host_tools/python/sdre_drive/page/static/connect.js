// SPDX-License-Identifier: MIT
// Asks for a serial port, where the page has no server.
import { byId, el, field, numberInput, numberOf } from "./dom.js";
import { FORMATS } from "./direct/serial_line.js";

const BAUDS = [115200, 57600, 38400, 19200, 9600];

export class Connect {
  constructor(page) {
    if (!page.link.connect) {
      return;
    }
    this.baud = el("select", { id: "baud" }, ...BAUDS.map((baud) => new Option(`${baud} Bd`, baud)));
    this.format = el("select", { id: "line-format" }, ...Object.keys(FORMATS).map((name) => new Option(name, name)));
    this.unit = numberInput({ id: "unit-address", value: "1" });
    this.form = el(
      "form",
      { id: "connect-form", noValidate: true, "aria-label": "Serial port" },
      el("div", { className: "row" }, field("baud rate", this.baud), field("format", this.format), field("address", this.unit)),
      el("div", { className: "row" }, el("button", { type: "submit", id: "connect", className: "main" }, "Connect a serial port")),
      el("small", {}, "A hidden window stops what it started. STOP needs this window: keep an emergency stop at hand."),
    );
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      page.tried(async () => {
        const unit = Math.round(numberOf(this.unit, "address", 1, 247));
        page.say(await page.link.connect(Number(this.baud.value), this.format.value, unit));
      });
    });
    byId("control-title").after(this.form);
  }

  show(state) {
    if (this.form) {
      this.form.hidden = state !== null;
    }
  }
}
