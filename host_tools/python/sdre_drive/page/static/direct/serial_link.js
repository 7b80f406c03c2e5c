// SPDX-License-Identifier: MIT
// The page's way to a drive by Web Serial.
import { DirectLink } from "./link.js";
import { SerialLine } from "./serial_line.js";

const SILENT_MS = 200;
const SLOW_OCTETS = 300; // of a line so slow that the longest answer takes more than that
const NO_SERIAL = "this browser has no Web Serial: use Chromium, Chrome or Edge, at https or localhost";

export class SerialLink extends DirectLink {
  constructor(onState) {
    super(onState);
    setTimeout(() => onState(null, "serial" in navigator ? "Connect the serial port of the drive." : NO_SERIAL));
  }

  /** From a click: the browser asks for the port. */
  async connect(baud, format, unit) {
    if (!("serial" in navigator)) {
      throw new Error(NO_SERIAL);
    }
    const line = await SerialLine.open(baud, format);
    this.use(line, unit, Math.max(SILENT_MS, (1000 * SLOW_OCTETS * 11) / baud), "the serial port has gone: connect it again");
    return `connected: ${line.words}`;
  }
}
