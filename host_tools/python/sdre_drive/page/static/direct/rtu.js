// SPDX-License-Identifier: MIT
// Frames of Modbus RTU: requests as octets, and what an answer says. Nothing here waits or knows a line.

export const EXCEPTION_WORDS = {
  1: "does not know this function",
  2: "does not have this register",
  3: "refuses this value: it is out of the drive's range",
  4: "does not take or tell this now",
  11: "did not answer behind its gateway",
};
const LONGEST = 256; // octets of a frame
const MOST_READ = 125; // registers of functions 3 and 4
const MOST_WRITTEN = 123; // registers of function 16

/** The drive has answered, with an exception. */
export class Refused extends Error {}
/** The octets are no answer to the request. */
export class NoAnswer extends Error {}

/** CRC of Modbus over octets: polynomial A001h, from FFFFh. */
export function crc16(octets) {
  let crc = 0xffff;
  for (const octet of octets) {
    crc ^= octet;
    for (let bit = 0; bit < 8; bit++) {
      crc = crc & 1 ? (crc >> 1) ^ 0xa001 : crc >> 1;
    }
  }
  return crc;
}

const words = (...values) => values.flatMap((value) => [(value >> 8) & 0xff, value & 0xff]);

function framed(unit, pdu) {
  const octets = [unit, ...pdu];
  const crc = crc16(octets);
  return Uint8Array.from([...octets, crc & 0xff, crc >> 8]);
}

function require(value, low, high, name) {
  if (!Number.isInteger(value) || value < low || value > high) {
    throw new RangeError(`${name}: ${value} is not within ${low} .. ${high}`);
  }
}

/** Function 3 or 4. */
export function readRequest(unit, code, first, count) {
  require(count, 1, MOST_READ, "registers");
  require(first, 0, 0x10000 - count, "first register");
  return framed(unit, [code, ...words(first, count)]);
}

/** Function 6 for one register, function 16 for more. */
export function writeRequest(unit, first, values) {
  require(values.length, 1, MOST_WRITTEN, "registers");
  require(first, 0, 0x10000 - values.length, "first register");
  values.forEach((value) => require(value, 0, 0xffff, "word"));
  if (values.length === 1) {
    return framed(unit, [6, ...words(first, values[0])]);
  }
  return framed(unit, [16, ...words(first, values.length), 2 * values.length, ...words(...values)]);
}

/** Function 43/14: objects of the identification from one on. */
export function identifyRequest(unit, readCode, firstObject) {
  return framed(unit, [0x2b, 0x0e, readCode, firstObject]);
}

/** Octets of the answer that begins so; undefined: they do not tell yet. */
function lengthOf(octets) {
  if (octets.length < 3) {
    return undefined;
  }
  const code = octets[1];
  if (code & 0x80) {
    return 5;
  }
  if (code === 3 || code === 4) {
    return 5 + octets[2];
  }
  return code === 6 || code === 16 ? 8 : code === 0x2b ? identifiedLength(octets) : octets.length;
}

function identifiedLength(octets) {
  let at = 8;
  for (let n = octets[7]; n > 0; n--) {
    if (octets.length < at + 2) {
      return undefined;
    }
    at += 2 + octets[at + 1];
  }
  return octets.length < 8 ? undefined : at + 2;
}

/** Whether an answer is whole, or can become none. */
export function isWhole(octets) {
  const length = lengthOf(octets);
  return octets.length >= LONGEST || (length !== undefined && octets.length >= length);
}

function requireAnswer(request, octets) {
  const crc = octets.length < 5 ? -1 : crc16(octets.slice(0, -2));
  const [low, high] = octets.slice(-2);
  if (octets.length !== lengthOf(octets) || crc !== (low | (high << 8))) {
    throw new NoAnswer("a disturbed answer");
  }
  if (octets[0] !== request[0] || (octets[1] & 0x7f) !== request[1]) {
    throw new NoAnswer("an answer to something else");
  }
  if (octets[1] & 0x80) {
    throw new Refused(`the drive ${EXCEPTION_WORDS[octets[2]] || `answers with exception ${octets[2]}`}`);
  }
}

/** Registers of an answer to readRequest(). Throws Refused or NoAnswer, as all of these. */
export function readAnswer(request, octets) {
  requireAnswer(request, octets);
  const count = (request[4] << 8) | request[5];
  if (octets[2] !== 2 * count) {
    throw new NoAnswer("another number of registers");
  }
  return Array.from({ length: count }, (_, k) => (octets[3 + 2 * k] << 8) | octets[4 + 2 * k]);
}

/** Function 6 is answered by its echo, function 16 by its first four words. */
export function writeAnswer(request, octets) {
  requireAnswer(request, octets);
  for (let k = 2; k < 6; k++) {
    if (octets[k] !== request[k]) {
      throw new NoAnswer("another register or value");
    }
  }
}

/** Objects by number, and the object to go on with; 0: that was all. */
export function identifyAnswer(request, octets) {
  requireAnswer(request, octets);
  const found = {};
  let at = 8;
  for (let n = octets[7]; n > 0; n--) {
    const from = at + 2;
    found[octets[at]] = String.fromCharCode(...octets.slice(from, from + octets[at + 1]));
    at = from + octets[at + 1];
  }
  return { objects: found, next: octets[5] === 0xff ? octets[6] : 0 };
}
