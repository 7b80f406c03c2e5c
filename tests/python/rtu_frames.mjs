// SPDX-License-Identifier: MIT
// Answers test_page_rtu.py with the page's own modules: a JSON request in each line, a JSON answer in each.
import { createInterface } from "node:readline";
import { Master } from "../../host_tools/python/sdre_drive/page/static/direct/master.js";
import * as rtu from "../../host_tools/python/sdre_drive/page/static/direct/rtu.js";

/** A line that answers by a script: for each request the octets that come, in pieces. */
class Scripted {
  constructor(answers) {
    Object.assign(this, { answers, sent: [], words: "a line" });
  }

  async write(octets) {
    this.sent.push([...octets]);
    for (const piece of this.answers.shift() || []) {
      setTimeout(() => this.onOctets(piece), 1);
    }
  }
}

const DO = {
  crc: ({ octets }) => rtu.crc16(octets),
  read: ({ code, first, count }) => [...rtu.readRequest(1, code, first, count)],
  write: ({ first, values }) => [...rtu.writeRequest(1, first, values)],
  identify: ({ code, first }) => [...rtu.identifyRequest(1, code, first)],
  whole: ({ octets }) => rtu.isWhole(octets),
  read_answer: ({ request, octets }) => rtu.readAnswer(request, octets),
  write_answer: ({ request, octets }) => rtu.writeAnswer(request, octets) ?? "taken",
  identify_answer: ({ request, octets }) => rtu.identifyAnswer(request, octets),
  async master({ answers, calls }) {
    const line = new Scripted(answers);
    const master = new Master(line, 1, 40);
    const told = calls.map(([name, ...args]) => master[name](...args).then((x) => x ?? "taken", (e) => e.message));
    return { told: await Promise.all(told), sent: line.sent };
  },
};

for await (const text of createInterface({ input: process.stdin })) {
  const { call, ...args } = JSON.parse(text);
  try {
    console.log(JSON.stringify({ told: await DO[call](args) }));
  } catch (error) {
    console.log(JSON.stringify({ error: error.message, kind: error.constructor.name }));
  }
}
