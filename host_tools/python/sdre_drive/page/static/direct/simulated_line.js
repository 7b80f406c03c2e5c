// SPDX-License-Identifier: MIT
// A line to the virtual drive in a worker of this page, and its bench.

export class SimulatedLine {
  /** Starts the firmware for a shipped drive. Throws when there is none, or when ./dev web has not compiled it. */
  static async open(name) {
    const worker = new Worker(new URL("simulated_worker.js", import.meta.url), { type: "module" });
    await new Promise((resolve, reject) => {
      worker.onerror = () => reject(new Error("there is no virtual drive beside this page: ./dev web puts it there"));
      worker.onmessage = ({ data }) => (data.error ? reject(new Error(data.error)) : resolve(data));
      worker.postMessage({ drive: `/firmware/config/drives/${name}.toml` });
    });
    return new SimulatedLine(worker, "the virtual drive in this page");
  }

  constructor(worker, words) {
    Object.assign(this, { worker, words, onOctets: () => undefined, onEnd: () => undefined });
    this.asked = new Map();
    this.number = 0;
    worker.onmessage = ({ data }) => this.take(data);
    worker.onerror = () => this.onEnd();
  }

  take(data) {
    if (data.octets) {
      this.onOctets(data.octets);
      return;
    }
    const { resolve, reject } = this.asked.get(data.number);
    this.asked.delete(data.number);
    if (data.told.error) {
      reject(new Error(data.told.error));
    } else {
      resolve(data.told);
    }
  }

  write(octets) {
    this.worker.postMessage({ frame: octets });
  }

  /** One command of the bench; its answer. Throws its refusal. */
  control(command) {
    this.number++;
    return new Promise((resolve, reject) => {
      this.asked.set(this.number, { resolve, reject });
      this.worker.postMessage({ control: command, number: this.number });
    });
  }
}
