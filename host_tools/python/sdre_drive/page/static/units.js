// SPDX-License-Identifier: MIT
// Units of speed, chosen once for the whole page: fields, figures, traces, ramps, files.

const KEY = "sdre-drive-unit";
const RPM = 30 / Math.PI;
const CHOICES = {
  rpm: { factor: RPM, names: ["r/min", "r/min/s", "r/min/s²"] },
  radps: { factor: 1, names: ["rad/s", "rad/s²", "rad/s³"] },
};
const ORDERS = ["rad/s electrical", "rad/s2 electrical", "rad/s3 electrical"];

let chosen = localStorage.getItem(KEY) === "radps" ? "radps" : "rpm";
let polePairs = 1;
const listeners = [];

export const unit = () => chosen;

/** Called after another unit was chosen. */
export function onUnit(listener) {
  listeners.push(listener);
}

export function chooseUnit(name) {
  const before = chosen;
  chosen = name in CHOICES ? name : "rpm";
  localStorage.setItem(KEY, chosen);
  if (chosen !== before) {
    listeners.forEach((listener) => listener());
  }
}

/** Pole pairs of the motor; the page shows mechanical speeds only. */
export function usePolePairs(count) {
  const changed = count && count !== polePairs;
  polePairs = count || polePairs;
  if (changed) {
    listeners.forEach((listener) => listener());
  }
}

/** Name and factor of a register's unit on the page. */
export function shownAs(registerUnit) {
  const order = ORDERS.indexOf(registerUnit);
  if (order < 0) {
    return { name: registerUnit, factor: 1 };
  }
  const { factor, names } = CHOICES[chosen];
  return { name: names[order], factor: factor / polePairs };
}

export const speedName = () => CHOICES[chosen].names[0];
export const speedOf = (eRadps) => eRadps * shownAs(ORDERS[0]).factor;
export const eRadpsOf = (speed) => speed / shownAs(ORDERS[0]).factor;
export const mRadpsOf = (speed) => speed / CHOICES[chosen].factor;
export const speedOfRpm = (rpm) => (rpm / RPM) * CHOICES[chosen].factor;
/** For a column of a file. */
export const speedColumn = () => (chosen === "rpm" ? "rpm" : "m_radps");
