// SPDX-License-Identifier: MIT
"use strict";

const $ = (id) => document.getElementById(id);
const BLUE = "#1f77b4";
const ORANGE = "#e07000";
const GREY = "#9a9a9a";
const DASH = [4, 3];

/** The plots: title, and the name, column, colour and dashes of every curve. Speeds are in r/min. */
const PLOTS = [
  ["speed [r/min]", [["wanted", "omega_ref_e_radps", "#000", DASH], ["motor", "omega_e_radps", BLUE]]],
  ["current [A]", [["q wanted", "iq_ref_A", BLUE, DASH], ["d wanted", "id_ref_A", ORANGE, DASH], ["q", "iq_A", BLUE], ["d", "id_A", ORANGE]]],
  ["torque [N m]", [["motor", "torque_Nm", BLUE], ["load", "load_torque_Nm", "#000", DASH]]],
  ["voltage [V]", [["q", "vq_V", BLUE], ["d", "vd_V", ORANGE]]],
];

class Page {
  constructor(module) {
    this.module = module;
    this.files = this.ask({ files: true });
    this.sliders = [];
    this.plots = PLOTS.map(([title]) => new Plot($("plots"), title, (from, to) => this.look(from, to)));
    Page.fill($("scenario"), Object.keys(this.files.scenarios), "board_load_step");
    $("scenario").addEventListener("change", () => this.choose());
    $("drive").addEventListener("change", () => this.start());
    for (const id of ["real", "seed"]) {
      $(id).addEventListener("change", () => this.soon());
    }
    $("controls").addEventListener("submit", (e) => e.preventDefault());
    $("keep").addEventListener("click", () => this.keep());
    $("reset").addEventListener("click", () => this.start());
    window.addEventListener("resize", () => this.draw());
    this.choose();
  }

  /** An answer of web.cpp. */
  ask(request) {
    return JSON.parse(this.module.ccall("sdre_web_answer", "string", ["string"], [JSON.stringify(request)]));
  }

  static fill(select, names, chosen) {
    select.replaceChildren(...names.map((name) => new Option(name, name, false, name === chosen)));
  }

  /** A scenario: offers the drives of its motor. */
  choose() {
    const own = this.files.scenarios[$("scenario").value].drive.split("/").pop().replace(".toml", "");
    const motor = own.split("_")[0];
    Page.fill($("drive"), Object.keys(this.files.drives).filter((name) => name.startsWith(motor)), own);
    this.start();
  }

  /** A scenario with a drive as they are in their files. */
  start() {
    const scenario = this.files.scenarios[$("scenario").value];
    this.drive = this.files.drives[$("drive").value];
    this.ideal = (scenario.sensors || {}).ideal !== false;
    $("real").checked = !this.ideal;
    $("seed").value = scenario.seed || 1;
    const groups = new Map();
    this.sliders = slidersOf(scenario, this.drive).map((what) => {
      if (!groups.has(what.group)) {
        const group = document.createElement("fieldset");
        const legend = document.createElement("legend");
        legend.textContent = what.group;
        group.append(legend);
        groups.set(what.group, group);
      }
      return new Slider(groups.get(what.group), what, () => this.soon());
    });
    $("sliders").replaceChildren(...groups.values());
    this.kept = null;
    this.from = undefined;
    this.soon();
  }

  request() {
    const request = { scenario: $("scenario").value, drive: $("drive").value, scenario_changes: {}, drive_changes: {} };
    this.sliders.forEach((slider) => slider.put(request.scenario_changes, request.drive_changes, this.drive));
    if ($("real").checked === this.ideal) {
      request.scenario_changes["sensors.ideal"] = !$("real").checked;
    }
    request.scenario_changes.seed = Number($("seed").value);
    return request;
  }

  /** Runs when nothing has moved for a moment. */
  soon() {
    clearTimeout(this.timer);
    this.done = false;
    this.timer = setTimeout(() => {
      Page.say("computing ..");
      setTimeout(() => this.run(), 20); // so that this is seen
    }, 120);
  }

  run() {
    const began = performance.now();
    const answer = this.ask(this.request());
    const took = ((performance.now() - began) / 1000).toFixed(1);
    if (answer.error) {
      Page.say(answer.error, true);
    } else {
      this.answer = answer;
      this.columns = Page.columns(answer.csv);
      const rows = this.columns.time_s.length;
      const warning = answer.fault ? `the drive has switched off: ${answer.fault}` : answer.uncertified && `not certified: ${answer.uncertified}`;
      const tail = `${rows} control periods computed in ${took} s`;
      Page.say(warning ? `${warning}; ${tail}` : tail, Boolean(warning));
      $("text").textContent = answer.text;
      $("files").replaceChildren(
        Page.link("scenario.toml", answer.scenario_toml),
        Page.link("drive.toml", answer.drive_toml),
        Page.link("trace.csv", answer.csv),
      );
      this.draw();
    }
    this.done = true;
  }

  static say(text, wrong = false) {
    $("state").textContent = text;
    $("state").className = wrong ? "wrong" : "";
  }

  static link(name, text) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    link.download = link.textContent = name;
    return link;
  }

  static columns(csv) {
    const [head, ...rows] = csv.trimEnd().split("\n").map((line) => line.split(","));
    return Object.fromEntries(head.map((name, k) => [name, Float64Array.from(rows, (row) => Number(row[k]))]));
  }

  keep() {
    this.kept = this.columns;
    this.draw();
  }

  look(from, to) {
    Object.assign(this, { from, to });
    this.draw();
  }

  draw() {
    if (!this.columns) {
      return;
    }
    const time = this.columns.time_s;
    const [from, to] = this.from === undefined ? [time[0], time[time.length - 1]] : [this.from, this.to];
    PLOTS.forEach(([title, curves], k) => this.plots[k].show([...this.keptCurves(curves), ...this.curves(curves, this.columns)], from, to));
  }

  curves(curves, columns) {
    return curves.map(([name, column, colour, dash]) => ({ name, colour, dash, x: columns.time_s, y: this.shown(column, columns) }));
  }

  /** The kept run: its solid curves, in grey. */
  keptCurves(curves) {
    const solid = this.kept ? curves.filter((curve) => !curve[3]) : [];
    return this.curves(solid, this.kept).map((curve) => ({ ...curve, name: `${curve.name}, kept`, colour: GREY, width: 2 }));
  }

  shown(column, columns) {
    const factor = RPM / this.drive.motor.pole_pairs;
    return column.endsWith("_e_radps") ? columns[column].map((v) => v * factor) : columns[column];
  }
}

sdre_web().then((module) => {
  window.page = new Page(module);
});
