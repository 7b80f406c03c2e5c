// SPDX-License-Identifier: MIT
// Plots one above the other, with one time axis, a cursor with values, and a closer look.
import { el, fixed, short } from "./dom.js";
import { lastUpTo, rangeOf, ticks } from "./axis.js";

const LEFT = 58;
const RIGHT = 10;
const TITLE = 18;
const GAP = 8;
const BOTTOM = 22;
const NEAREST = 6; // pixels: a shorter drag is a click

/** Colours of the style sheet, which knows light and dark. */
export function palette() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  return { ink: of("ink"), soft: of("soft"), grid: of("grid"), ground: of("card"), lines: [1, 2, 3, 4].map((n) => of(`line-${n}`)) };
}

export class Stack {
  /** @param plotHeight pixels of one plot */
  constructor(parent, name, plotHeight) {
    this.name = name;
    this.plotHeight = plotHeight;
    this.plots = [];
    this.range = [0, 1];
    this.look = null; // a part of the range
    this.cursor = null;
    this.canvas = el("canvas", { tabIndex: 0, role: "img", "aria-label": name });
    this.values = el("p", { className: "values" }, "");
    parent.append(this.canvas, this.values);
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  /** Plots of {title, unit, series: [{name, colour, dash, step, x, y}]}, within a range of seconds. */
  show(plots, range, xUnit = { name: "s", factor: 1 }) {
    this.plots = plots;
    this.range = range;
    this.xUnit = xUnit;
    this.canvas.style.height = `${plots.length * (TITLE + this.plotHeight + GAP) + BOTTOM}px`;
    this.draw();
  }

  get seen() {
    return this.look || this.range;
  }

  listen() {
    const at = (e) => this.xAt(e.clientX - this.canvas.getBoundingClientRect().left);
    this.canvas.addEventListener("pointerdown", (e) => {
      this.from = e.pointerType === "mouse" && e.button === 0 ? e.clientX : null;
      this.put(at(e));
    });
    this.canvas.addEventListener("pointermove", (e) => this.put(at(e), e.buttons === 1 ? this.from : null));
    this.canvas.addEventListener("pointerup", (e) => this.drop(e));
    this.canvas.addEventListener("pointerleave", () => this.put(null));
    this.canvas.addEventListener("dblclick", () => this.closer(null));
    this.canvas.addEventListener("keydown", (e) => this.key(e));
  }

  drop(e) {
    const from = this.from;
    this.from = null;
    if (from !== null && from !== undefined && Math.abs(e.clientX - from) > NEAREST) {
      const left = this.canvas.getBoundingClientRect().left;
      this.closer([this.xAt(Math.min(from, e.clientX) - left), this.xAt(Math.max(from, e.clientX) - left)]);
    }
  }

  /** Arrows move the cursor, + and - change the look, 0 or Escape shows all. */
  key(e) {
    const [low, high] = this.seen;
    const step = ((high - low) * (e.shiftKey ? 10 : 1)) / 200;
    const now = this.cursor === null ? high : this.cursor;
    const zoom = (share) => [Math.max(now - share * (high - low), this.range[0]), Math.min(now + share * (high - low), this.range[1])];
    const acts = {
      ArrowLeft: () => this.put(Math.max(now - step, low)),
      ArrowRight: () => this.put(Math.min(now + step, high)),
      Home: () => this.put(low),
      End: () => this.put(high),
      "+": () => this.closer(zoom(0.25)),
      "-": () => this.closer(zoom(1)),
      0: () => this.closer(null),
      Escape: () => this.closer(null),
    };
    if (acts[e.key]) {
      e.preventDefault();
      acts[e.key]();
    }
  }

  closer(look) {
    this.look = look && look[1] > look[0] ? look : null;
    this.draw();
  }

  put(x, from = null) {
    this.cursor = x;
    this.dragged = from;
    this.draw();
  }

  xAt(pixel) {
    const [low, high] = this.seen;
    const share = (pixel - LEFT) / (this.canvas.clientWidth - LEFT - RIGHT);
    return low + Math.min(Math.max(share, 0), 1) * (high - low);
  }

  pixelOf(x) {
    const [low, high] = this.seen;
    return LEFT + ((x - low) / (high - low)) * (this.canvas.clientWidth - LEFT - RIGHT);
  }

  draw() {
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (!width || !this.plots.length) {
      return;
    }
    const scale = devicePixelRatio || 1;
    if (this.canvas.width !== Math.round(width * scale) || this.canvas.height !== Math.round(height * scale)) {
      this.canvas.width = Math.round(width * scale);
      this.canvas.height = Math.round(height * scale);
    }
    const c = this.canvas.getContext("2d");
    const colours = palette();
    c.setTransform(scale, 0, 0, scale, 0, 0);
    c.fillStyle = colours.ground;
    c.fillRect(0, 0, width, height);
    c.font = "12px system-ui, sans-serif";
    this.plots.forEach((plot, k) => this.drawPlot(c, colours, plot, k, width));
    this.drawTime(c, colours, height);
    this.drawCursor(c, colours, height);
    this.tell();
  }

  drawPlot(c, colours, plot, k, width) {
    const top = k * (TITLE + this.plotHeight + GAP) + TITLE;
    const bottom = top + this.plotHeight;
    const [from, to] = this.seen;
    const parts = plot.series.map((s) => this.part(s, from, to));
    const [low, high] = rangeOf(parts.map((p) => p.y));
    const y = (value) => bottom - ((value - low) / (high - low)) * this.plotHeight;
    this.drawTitle(c, colours, plot, top, width);
    c.strokeStyle = colours.grid;
    c.lineWidth = 1;
    c.strokeRect(LEFT, top, width - LEFT - RIGHT, this.plotHeight);
    c.textAlign = "right";
    c.textBaseline = "middle";
    for (const value of ticks(low, high, 3)) {
      c.beginPath();
      c.moveTo(LEFT, y(value));
      c.lineTo(width - RIGHT, y(value));
      c.stroke();
      c.fillStyle = colours.soft;
      c.fillText(short(value, 6), LEFT - 6, y(value));
    }
    c.save();
    c.beginPath();
    c.rect(LEFT, top, width - LEFT - RIGHT, this.plotHeight);
    c.clip();
    plot.series.forEach((s, n) => this.drawLine(c, colours, s, parts[n], y));
    c.restore();
  }

  /** The samples that are seen, and one at each side. */
  part(series, from, to) {
    const first = Math.max(lastUpTo(series.x, from), 0);
    const last = Math.min(lastUpTo(series.x, to) + 2, series.x.length);
    return { x: series.x.slice(first, last), y: series.y.slice(first, last) };
  }

  drawTitle(c, colours, plot, top, width) {
    c.textBaseline = "alphabetic";
    c.textAlign = "left";
    c.fillStyle = colours.ink;
    c.fillText(plot.unit ? `${plot.title} [${plot.unit}]` : plot.title, LEFT, top - 5);
    c.textAlign = "right";
    let right = width - RIGHT;
    for (const s of [...plot.series].reverse()) {
      if (plot.series.length > 1) {
        c.fillStyle = this.colourOf(colours, s);
        c.fillText(s.name, right, top - 5);
        right -= c.measureText(s.name).width + 12;
      }
    }
  }

  colourOf(colours, series) {
    return series.colour ? colours.lines[series.colour - 1] : colours.ink;
  }

  drawLine(c, colours, series, part, y) {
    c.strokeStyle = this.colourOf(colours, series);
    c.lineWidth = 1.5;
    c.setLineDash(series.dash ? [5, 3] : []);
    c.beginPath();
    let pen = false;
    for (let n = 0; n < part.x.length; n++) {
      const value = part.y[n];
      if (value === null || value === undefined) {
        pen = false;
        continue;
      }
      const x = this.pixelOf(part.x[n]);
      if (pen && series.step) {
        c.lineTo(x, y(part.y[n - 1]));
      }
      c[pen ? "lineTo" : "moveTo"](x, y(value));
      pen = true;
    }
    c.stroke();
    c.setLineDash([]);
  }

  drawTime(c, colours, height) {
    const [low, high] = this.seen.map((x) => x * this.xUnit.factor);
    c.fillStyle = colours.soft;
    c.textBaseline = "alphabetic";
    const places = ticks(low, high, Math.max(Math.floor(this.canvas.clientWidth / 110), 2));
    places.forEach((value, k) => {
      const x = this.pixelOf(value / this.xUnit.factor);
      c.textAlign = k === 0 && x < LEFT + 10 ? "left" : k === places.length - 1 && x > this.canvas.clientWidth - 40 ? "right" : "center";
      c.fillText(`${short(value, 6)} ${this.xUnit.name}`, x, height - 6);
    });
  }

  drawCursor(c, colours, height) {
    const line = (x) => {
      c.beginPath();
      c.moveTo(x, TITLE);
      c.lineTo(x, height - BOTTOM);
      c.stroke();
    };
    c.strokeStyle = colours.ink;
    c.lineWidth = 1;
    if (this.cursor !== null) {
      line(Math.round(this.pixelOf(this.cursor)) + 0.5);
    }
    if (this.dragged !== null && this.dragged !== undefined) {
      line(this.dragged - this.canvas.getBoundingClientRect().left);
    }
  }

  /** Values at the cursor in words, for everybody. */
  tell() {
    if (this.cursor === null) {
      this.values.textContent = this.look ? "A part is shown: Escape or a double click shows all." : "";
      return;
    }
    const found = this.plots.map((plot) => {
      const each = plot.series.map((s) => {
        const at = lastUpTo(s.x, this.cursor);
        const value = at >= 0 ? s.y[at] : null;
        return plot.series.length > 1 ? `${s.name} ${short(value, 5)}` : short(value, 5);
      });
      return `${plot.title} ${each.join(", ")} ${plot.unit}`.trim();
    });
    this.values.textContent = `${fixed(this.cursor * this.xUnit.factor, 3)} ${this.xUnit.name}: ${found.join("; ")}`;
  }

  /** A picture of it as it is. */
  picture(done) {
    this.canvas.toBlob(done, "image/png");
  }
}
