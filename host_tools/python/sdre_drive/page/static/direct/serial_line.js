// SPDX-License-Identifier: MIT
// A serial port of Web Serial as a line for a master.

// In the order of register LINE_FORMAT.
export const FORMATS = {
  "8E1": { parity: "even", stopBits: 1 },
  "8O1": { parity: "odd", stopBits: 1 },
  "8N2": { parity: "none", stopBits: 2 },
};

export class SerialLine {
  /** Asks the user for a port and opens it. */
  static async open(baudRate, format) {
    const port = await navigator.serial.requestPort();
    await port.open({ baudRate, dataBits: 8, ...FORMATS[format] });
    return new SerialLine(port, `the serial port, ${baudRate} Bd ${format}`);
  }

  constructor(port, words) {
    Object.assign(this, { port, words, onOctets: () => undefined, onEnd: () => undefined });
    this.writer = port.writable.getWriter();
    this.listen();
  }

  /** A disturbed octet ends a reader, not the port. */
  async listen() {
    while (this.port.readable) {
      const reader = this.port.readable.getReader();
      try {
        for (let told = await reader.read(); !told.done; told = await reader.read()) {
          this.onOctets(told.value);
        }
      } catch {
        // a break, a parity error, or the port has gone: then readable is null
      } finally {
        reader.releaseLock();
      }
    }
    this.onEnd();
  }

  write(octets) {
    return this.writer.write(octets);
  }
}
