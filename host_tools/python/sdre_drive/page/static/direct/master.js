// SPDX-License-Identifier: MIT
// A master of Modbus RTU on a line: one request at a time, a time limit, and a second try. A line has
//   write(octets)   sends them
//   onOctets        the master sets it: called with each piece that comes
//   words           its name for messages
import { Refused, identifyAnswer, identifyRequest, isWhole, readAnswer, readRequest, writeAnswer, writeRequest } from "./rtu.js";

// The drive withdraws run after 500 ms without a request: two tries have to fit.
const TIMEOUT_MS = 200;
const TRIES = 2;
const PAUSE_MS = 3; // chosen: longer than the 1.75 ms of silence between frames
const QUIET_MS = 20; // after a disturbed answer: what comes late belongs to nothing

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

export class Master {
  constructor(line, unit = 1, timeout_ms = TIMEOUT_MS) {
    Object.assign(this, { line, unit, timeout_ms, queue: [], works: false });
    this.come = [];
    this.waiting = null;
    line.onOctets = (octets) => this.take(octets);
  }

  take(octets) {
    if (this.waiting) {
      this.come.push(...octets);
      if (isWhole(this.come)) {
        this.waiting(this.come);
      }
    }
  }

  /** Registers of function 4, or of function 3. */
  input(first, count) {
    return this.asked(() => readRequest(this.unit, 4, first, count), readAnswer);
  }

  holding(first, count) {
    return this.asked(() => readRequest(this.unit, 3, first, count), readAnswer);
  }

  /** @param allow called when its turn has come; throws when it must not be sent */
  write(first, values, allow = () => undefined) {
    return this.asked(() => allow() || writeRequest(this.unit, first, values), writeAnswer);
  }

  /** Before all that waits. */
  writeAtOnce(first, values) {
    return this.asked(() => writeRequest(this.unit, first, values), writeAnswer, true);
  }

  /** Objects of function 43/14 by number. */
  async identify(readCode, firstObject) {
    const found = {};
    let next = firstObject;
    do {
      const from = next;
      const told = await this.asked(() => identifyRequest(this.unit, readCode, from), identifyAnswer);
      Object.assign(found, told.objects);
      next = told.next;
    } while (next > firstObject);
    return found;
  }

  /** One after the other, in the order of the calls, but for what cannot wait. */
  asked(request, answer, atOnce = false) {
    return new Promise((resolve, reject) => {
      const one = { request, answer, resolve, reject };
      if (atOnce) {
        this.queue.unshift(one);
      } else {
        this.queue.push(one);
      }
      this.work();
    });
  }

  async work() {
    if (this.works) {
      return;
    }
    this.works = true;
    while (this.queue.length) {
      const { request, answer, resolve, reject } = this.queue.shift();
      try {
        resolve(await this.tried(request(), answer));
      } catch (error) {
        reject(error);
      }
    }
    this.works = false;
  }

  /** Once more after a lost answer: to ask or write the same twice does nothing else. */
  async tried(request, answer) {
    let why;
    for (let n = 0; n < TRIES; n++) {
      try {
        return answer(request, await this.exchanged(request));
      } catch (error) {
        if (error instanceof Refused) {
          throw error;
        }
        why = error;
        await pause(QUIET_MS);
      }
    }
    throw new Error(`no answer from ${this.line.words}: ${why.message}`);
  }

  async exchanged(request) {
    this.come = [];
    let timer;
    const came = new Promise((resolve, reject) => {
      this.waiting = resolve;
      timer = setTimeout(() => reject(new Error(`nothing within ${this.timeout_ms} ms`)), this.timeout_ms);
    });
    came.catch(() => undefined); // the write may fail first
    try {
      await this.line.write(request);
      const octets = await came;
      await pause(PAUSE_MS);
      return octets;
    } finally {
      clearTimeout(timer);
      this.waiting = null;
    }
  }
}
