// SPDX-License-Identifier: MIT
// The page's way to the drive: a stream of states, actions, and what is read once. direct/link.js has the same
// methods. `lacks` names the cards that a link cannot serve, with the reason.

const AGAIN_MS = 1000;
const SILENT_MS = 2000;
const STOP_TRIES = 3;

export class HttpLink {
  /** @param onState called with each state, or null and the reason why there is none */
  constructor(onState) {
    this.onState = onState;
    this.lacks = {};
    this.viewer = crypto.randomUUID();
    this.heard = performance.now();
    this.look();
    setInterval(() => this.watch(), 500);
  }

  async look() {
    for (;;) {
      let why = "sdre-drive has ended, or does not answer";
      try {
        why = (await this.read()) || why;
      } catch {
        // told below; it is tried again
      }
      this.onState(null, why);
      await new Promise((done) => setTimeout(done, AGAIN_MS));
    }
  }

  /** Until the stream ends; what the server says about it. */
  async read() {
    const answer = await fetch(`api/stream?viewer=${this.viewer}`);
    if (!answer.ok) {
      return (await answer.json().catch(() => ({}))).error || "open the address that sdre-drive printed";
    }
    const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
    let rest = "";
    for (;;) {
      const { value, done } = await reader.read();
      if (done) {
        return "";
      }
      const lines = (rest + value).split("\n");
      rest = lines.pop();
      this.heard = performance.now();
      lines.forEach((line) => this.onState(JSON.parse(line), ""));
    }
  }

  /** Marks old values as old. */
  watch() {
    if (performance.now() > this.heard + SILENT_MS) {
      this.onState(null, "no news from sdre-drive");
    }
  }

  /** An action; what was done, in words. Throws why it was not. */
  async do(name, args = {}) {
    const answer = await fetch(`api/${name}?viewer=${this.viewer}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(args),
    });
    const told = await answer.json().catch(() => ({ error: "open the address that sdre-drive printed" }));
    if (!answer.ok) {
      throw new Error(told.error);
    }
    return told.said;
  }

  /** Again when it did not arrive. */
  async stop() {
    for (let n = 1; ; n++) {
      try {
        return await this.do("stop");
      } catch (error) {
        if (n === STOP_TRIES) {
          throw new Error(`STOP did not arrive: ${error.message}. Use the emergency stop.`);
        }
      }
    }
  }

  async get(what) {
    const answer = await fetch(`api/${what}`);
    if (!answer.ok) {
      throw new Error("sdre-drive does not answer");
    }
    return answer.json();
  }
}
