// SPDX-License-Identifier: MIT
// A drive behind a master: registers by name in SI units, and a STOP after which no earlier start enables it.
import { DIGEST, GROUPS, VERSION } from "./tables.js";

const WORDS = { u16: 1, i16: 1, u32: 2, i32: 2, dec: 2 };
const MAP_OBJECT = 0x82; // of function 43/14, as VERSION_OBJECT
const VERSION_OBJECT = 2;
const ENABLES = 1 << 3; // of the control word: enable operation
export const CONTROL = { disable: 0, quickStop: 2, shutDown: 6, enable: 15, faultReset: 128 };

const registers = Object.fromEntries(
  Object.entries(GROUPS).map(([group, { space, registers: rows }]) => [
    group,
    rows.map(([name, address, type, step, unit]) => ({ name, address, type, step, unit, space })),
  ]),
);
const byName = Object.fromEntries(Object.values(registers).flatMap((all) => all.map((r) => [r.name, r])));
export const register = (name) => byName[name];

/** In SI units; of two registers the high one comes first. */
export function valueOf(r, words) {
  if (r.type === "dec") {
    return ((words[0] << 16) >> 16) * 10 ** ((words[1] << 16) >> 16);
  }
  let count = words.length === 1 ? words[0] : words[0] * 0x10000 + words[1];
  const size = 2 ** (16 * words.length);
  if (r.type.startsWith("i") && count >= size / 2) {
    count -= size;
  }
  return r.step ? count * r.step : count;
}

/** Words of a value. Throws beyond the register. */
export function wordsOf(r, value) {
  const count = Math.round(r.step ? value / r.step : value);
  const size = 2 ** (16 * WORDS[r.type]);
  const [low, high] = r.type.startsWith("i") ? [-size / 2, size / 2 - 1] : [0, size - 1];
  if (!(count >= low && count <= high)) {
    throw new Error(`${value} ${r.unit} does not fit register ${r.name}`);
  }
  const whole = count < 0 ? count + size : count;
  return size === 0x10000 ? [whole] : [Math.floor(whole / 0x10000), whole % 0x10000];
}

export class Drive {
  constructor(master) {
    this.master = master;
    this.stops = 0;
  }

  /** All of a group, by name. */
  async values(group) {
    const all = registers[group];
    const last = all[all.length - 1];
    const first = all[0].address;
    const ask = all[0].space === "holding" ? "holding" : "input";
    const words = await this.master[ask](first, last.address + WORDS[last.type] - first);
    return Object.fromEntries(
      all.map((r) => [r.name, valueOf(r, words.slice(r.address - first, r.address - first + WORDS[r.type]))]),
    );
  }

  /** Throws when the firmware has other registers than this page. */
  async require() {
    const told = await this.master.identify(3, 0x80);
    if (told[MAP_OBJECT] !== DIGEST) {
      const firmware = (await this.master.identify(1, 0))[VERSION_OBJECT] || "of no version";
      throw new Error(`the drive's firmware ${firmware} has other registers than this page ${VERSION}: take both from one build`);
    }
    return told;
  }

  /** `since`: the stops at the beginning of what enables the drive. */
  async write(name, value, since = this.stops) {
    const r = byName[name];
    await this.master.write(r.address, wordsOf(r, value), () => {
      if (name === "CONTROLWORD" && value & ENABLES && since !== this.stops) {
        throw new Error("STOP was pressed");
      }
    });
  }

  /** Brakes and then opens the bridge, or opens it at once: before all that waits. */
  async stopNow(brake) {
    this.stops++;
    await this.master.writeAtOnce(byName.CONTROLWORD.address, [brake ? CONTROL.quickStop : CONTROL.disable]);
  }

  off() {
    return this.write("CONTROLWORD", CONTROL.disable);
  }
}
