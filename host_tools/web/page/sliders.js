// SPDX-License-Identifier: MIT
"use strict";

const RPM = 30 / Math.PI;
const LAST = (list) => list.length - 1;
const SCALE = { lo: 0.5, hi: 2, log: true, start: 1, unit: "x" };
const WEIGHT = { lo: 0.1, hi: 10, log: true, start: 1, unit: "x" };

/** A factor on one entry of an array of weights. */
function weight(name, table, key, index, drive) {
  if (!drive[table] || !drive[table][key]) {
    return [];
  }
  return [{ group: "Weights of the design", name, ...WEIGHT, weight: { path: `${table}.${key}`, index } }];
}

/** Sliders of this scenario with this drive: {group, name, lo, hi, start, unit, log, paths | weight, from}. */
function slidersOf(scenario, drive) {
  const { pole_pairs, rated_speed_e_radps, rated_torque_Nm } = drive.motor;
  const sliders = [];
  const speeds = scenario.speed_reference || [];
  const loads = scenario.load_torque || [];
  if (speeds.length) {
    const most = Math.round((1.5 * rated_speed_e_radps * RPM) / pole_pairs);
    sliders.push({
      group: "What happens", name: "Last speed", lo: -most, hi: most, unit: "r/min",
      start: (speeds[LAST(speeds)].value_e_radps * RPM) / pole_pairs, from: (v) => (v * pole_pairs) / RPM,
      paths: [`speed_reference.${LAST(speeds)}.value_e_radps`],
    });
  }
  if (loads.length) {
    sliders.push({
      group: "What happens", name: "Last load", lo: -1.2 * rated_torque_Nm, hi: 1.2 * rated_torque_Nm, unit: "N m",
      start: loads[LAST(loads)].value_Nm, paths: [`load_torque.${LAST(loads)}.value_Nm`],
    });
  }
  const scale = (name, ...keys) => {
    const known = (scenario.plant_scale || {})[keys[0]];
    sliders.push({
      group: "The motor, which the drive does not know", name, ...SCALE, start: known === undefined ? 1 : known,
      paths: keys.map((key) => `plant_scale.${key}`),
    });
  };
  scale("Resistance", "stator_resistance_Ohm");
  scale("Inductances", "d_axis_inductance_H", "q_axis_inductance_H");
  scale("Magnet", "pm_flux_Wb");
  scale("Inertia", "inertia_kgm2");
  return sliders.concat(
    weight("Speed error", "nosc", "Q", 0, drive),
    weight("q current", "nosc", "Q", 1, drive),
    weight("d current", "nosc", "Q", 2, drive),
    weight("Disturbance's drift", "nodo", "Q", 0, drive),
  );
}

/** An input for a slider; changed() is called when it moves. */
class Slider {
  constructor(parent, what, changed) {
    Object.assign(this, what);
    const label = document.createElement("label");
    this.value = document.createElement("span");
    this.value.className = "value";
    this.input = document.createElement("input");
    Object.assign(this.input, { type: "range", min: 0, max: 1000, step: 1, title: this.name });
    label.append(this.name, this.value, this.input);
    parent.append(label);
    this.input.addEventListener("input", () => {
      this.tell();
      changed();
    });
    this.reset();
  }

  reset() {
    const share = this.log ? Math.log(this.start / this.lo) / Math.log(this.hi / this.lo) : (this.start - this.lo) / (this.hi - this.lo);
    this.input.value = Math.round(1000 * share);
    this.tell(this.start);
    this.moved = false;
  }

  /** The value of the slider, with three digits. */
  read() {
    const share = Number(this.input.value) / 1000;
    const exact = this.log ? this.lo * (this.hi / this.lo) ** share : this.lo + share * (this.hi - this.lo);
    return Number(exact.toPrecision(3));
  }

  tell(value = this.read()) {
    this.moved = true;
    this.value.textContent = `${Number(value.toPrecision(4))} ${this.unit}`;
  }

  /** Adds its change to those of the files, if it was moved. */
  put(scenario, drive, file) {
    if (!this.moved) {
      return;
    }
    const value = this.read();
    if (this.weight) {
      const { path, index } = this.weight;
      const [table, key] = path.split(".");
      drive[path] = drive[path] || file[table][key].slice();
      drive[path][index] *= value;
    } else {
      this.paths.forEach((path) => (scenario[path] = this.from ? this.from(value) : value));
    }
  }
}
