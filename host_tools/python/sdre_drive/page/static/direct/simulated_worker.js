// SPDX-License-Identifier: MIT
// The virtual drive beside the page: the firmware with its motor, compiled for a browser by ./dev web. Simulated time goes with the clock.
//     {drive: FILE}          begins; answered by {name} or {error}
//     {frame: octets}        a request of Modbus RTU; answered by {octets}, or by nothing
//     {control, number}      a line for the bench; answered by {number, told}
import sdre_web_drive from "./sdre_web_drive.js";

const ROUND_MS = 5; // chosen: a request waits as long as at a drive that polls its line

let answer;
let before_ms;
let frames = [];

const hexOf = (octets) => Array.from(octets, (octet) => octet.toString(16).padStart(2, "0")).join("");
const octetsOf = (hex) => Uint8Array.from(hex.match(/../g), (two) => parseInt(two, 16));

/** Runs the drive for the time since the last round, and passes on its answers. */
function round() {
  const now_ms = performance.now();
  const told = answer({ run_s: (now_ms - before_ms) / 1000, wall_s: now_ms / 1000, frames });
  before_ms = now_ms;
  frames = [];
  told.frames.forEach((frame) => postMessage({ octets: octetsOf(frame) }));
  setTimeout(round, ROUND_MS);
}

async function begin(drive) {
  const compiled = await sdre_web_drive();
  answer = (request) => JSON.parse(compiled.ccall("sdre_drive_answer", "string", ["string"], [JSON.stringify(request)]));
  const told = answer({ drive });
  postMessage(told);
  if (!told.error) {
    before_ms = performance.now();
    round();
  }
}

onmessage = ({ data }) => {
  if (data.drive) {
    begin(data.drive).catch((error) => postMessage({ error: error.message }));
  } else if (data.frame) {
    frames.push(hexOf(data.frame));
  } else {
    postMessage({ number: data.number, told: answer({ control: data.control }) });
  }
};
