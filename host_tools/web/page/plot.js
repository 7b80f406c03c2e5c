// SPDX-License-Identifier: MIT
"use strict";

/** Curves over time on a canvas; all plots of a page show the same time. */
class Plot {
  static LEFT = 62;
  static RIGHT = 130;
  static TOP = 8;
  static BOTTOM = 22;

  /** look(from, to): the reader wants to see this time; look() all of it. */
  constructor(parent, title, look) {
    this.title = title;
    this.curves = []; // {name, colour, dash, x, y}
    this.canvas = document.createElement("canvas");
    parent.append(this.canvas);
    this.canvas.addEventListener("dblclick", () => look());
    this.canvas.addEventListener("pointerdown", (e) => {
      this.dragged = [e.offsetX, e.offsetX];
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener("pointermove", (e) => {
      if (this.dragged) {
        this.dragged[1] = e.offsetX;
        this.draw();
      }
    });
    this.canvas.addEventListener("pointerup", () => {
      const [a, b] = this.dragged.sort((p, q) => p - q);
      this.dragged = null;
      if (b - a > 5) {
        look(this.time(a), this.time(b));
      } else {
        this.draw();
      }
    });
  }

  show(curves, from, to) {
    Object.assign(this, { curves, from, to });
    this.draw();
  }

  width() {
    return this.canvas.clientWidth - Plot.LEFT - Plot.RIGHT;
  }

  time(x) {
    const share = Math.min(1, Math.max(0, (x - Plot.LEFT) / this.width()));
    return this.from + share * (this.to - this.from);
  }

  /** Least and largest value in sight, with some room. */
  range() {
    let lo = Infinity;
    let hi = -Infinity;
    for (const { x, y } of this.curves) {
      for (let n = 0; n < x.length; n++) {
        if (x[n] >= this.from && x[n] <= this.to) {
          lo = Math.min(lo, y[n]);
          hi = Math.max(hi, y[n]);
        }
      }
    }
    if (!(lo <= hi)) {
      return [-1, 1];
    }
    const room = 0.06 * (hi - lo) || 0.06 * Math.abs(hi) || 1;
    return [lo - room, hi + room];
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const [w, h] = [this.canvas.clientWidth, this.canvas.clientHeight];
    this.canvas.width = w * ratio;
    this.canvas.height = h * ratio;
    const c = this.canvas.getContext("2d");
    c.scale(ratio, ratio);
    c.font = "11px system-ui, sans-serif";
    const [lo, hi] = this.range();
    const [right, bottom] = [Plot.LEFT + this.width(), h - Plot.BOTTOM];
    const px = (t) => Plot.LEFT + ((t - this.from) / (this.to - this.from)) * this.width();
    const py = (v) => bottom - ((v - lo) / (hi - lo)) * (bottom - Plot.TOP);
    this.grid(c, px, py, lo, hi, right, bottom);
    c.save();
    c.beginPath();
    c.rect(Plot.LEFT, Plot.TOP, this.width(), bottom - Plot.TOP);
    c.clip();
    for (const curve of this.curves) {
      this.line(c, curve, px, py);
    }
    if (this.dragged) {
      c.fillStyle = "rgba(0, 0, 0, 0.08)";
      c.fillRect(this.dragged[0], Plot.TOP, this.dragged[1] - this.dragged[0], bottom - Plot.TOP);
    }
    c.restore();
    this.legend(c, right);
  }

  grid(c, px, py, lo, hi, right, bottom) {
    c.lineWidth = 1;
    c.strokeStyle = "#e4e4e4";
    c.fillStyle = "#333";
    c.textBaseline = "middle";
    c.textAlign = "right";
    for (const v of Plot.ticks(lo, hi, 5)) {
      Plot.stroke(c, Plot.LEFT, py(v), right, py(v));
      c.fillText(Plot.text(v), Plot.LEFT - 5, py(v));
    }
    c.textBaseline = "top";
    c.textAlign = "center";
    for (const t of Plot.ticks(this.from, this.to, 9)) {
      Plot.stroke(c, px(t), Plot.TOP, px(t), bottom);
      c.fillText(`${Plot.text(t)} s`, px(t), bottom + 5);
    }
    c.save();
    c.translate(11, (Plot.TOP + bottom) / 2);
    c.rotate(-Math.PI / 2);
    c.textBaseline = "middle";
    c.fillText(this.title, 0, 0);
    c.restore();
  }

  line(c, { x, y, colour, dash, width }, px, py) {
    c.strokeStyle = colour;
    c.setLineDash(dash || []);
    c.lineWidth = width || 1.3;
    c.beginPath();
    for (let n = 0; n < x.length; n++) {
      c.lineTo(px(x[n]), py(y[n]));
    }
    c.stroke();
    c.setLineDash([]);
  }

  legend(c, right) {
    c.textAlign = "left";
    c.textBaseline = "middle";
    this.curves.forEach(({ name, colour, dash }, k) => {
      const y = Plot.TOP + 8 + 15 * k;
      c.strokeStyle = colour;
      c.lineWidth = 2;
      c.setLineDash(dash || []);
      Plot.stroke(c, right + 8, y, right + 30, y);
      c.setLineDash([]);
      c.fillStyle = "#333";
      c.fillText(name, right + 35, y);
    });
  }

  static stroke(c, x0, y0, x1, y1) {
    c.beginPath();
    c.moveTo(x0, y0);
    c.lineTo(x1, y1);
    c.stroke();
  }

  /** Round numbers: at most `most` of them. */
  static ticks(lo, hi, most) {
    const raw = (hi - lo) / most;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((k) => k * power >= raw);
    const found = [];
    for (let k = Math.ceil(lo / step); k * step <= hi; k++) {
      found.push(k * step);
    }
    return found;
  }

  static text(v) {
    return String(Number(v.toPrecision(6)));
  }
}
