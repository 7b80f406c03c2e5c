// SPDX-License-Identifier: MIT
// Judges the look of a page for test_page_look.py: contrast, overflow, targets. An expression.
(() => {
  const LEAST_TARGET = 24; // pixels, WCAG 2.2, 2.5.8
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  /** Red, green, blue and opacity of any colour that CSS knows. */
  const rgba = (colour) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const luminance = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const contrast = (one, other) => {
    const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const ground = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = rgba(getComputedStyle(e).backgroundColor);
      if (colour[3] > 0.99) {
        return colour;
      }
    }
    return rgba(matchMedia("(prefers-color-scheme: dark)").matches ? "#121212" : "#fff");
  };
  const seen = (e) => e.checkVisibility && e.checkVisibility() && e.getBoundingClientRect().width > 1;
  const named = (e) => `${e.tagName.toLowerCase()}#${e.id}.${e.className}: ${(e.innerText || e.value || "").slice(0, 40)}`;

  const faint = [];
  const beyond = [];
  const small = [];
  for (const e of document.body.querySelectorAll("*")) {
    if (!seen(e)) {
      continue;
    }
    const own = [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent.trim());
    if (own || e.matches("input, select")) {
      const ratio = contrast(rgba(getComputedStyle(e).color), ground(e));
      if (ratio < 4.5) {
        faint.push(`${named(e)}: ${ratio.toFixed(2)}`);
      }
    }
    const r = e.getBoundingClientRect();
    if (e.matches(".wide") && e.scrollWidth > e.clientWidth + 1) {
      beyond.push(`${named(e)} is cut`);
    }
    if ((r.right > innerWidth + 1 || r.left < -1) && !e.closest(".wide, .aside")) {
      beyond.push(named(e));
    }
    if (e.matches("button, select, input, summary") && (r.height < LEAST_TARGET || r.width < LEAST_TARGET) && e.type !== "checkbox") {
      small.push(`${named(e)}: ${r.width} x ${r.height}`);
    }
  }
  const style = getComputedStyle(document.documentElement);
  const card = rgba(style.getPropertyValue("--card"));
  const drawn = {};
  for (const name of ["ink", "soft", "line-1", "line-2", "line-3", "line-4"]) {
    drawn[name] = contrast(rgba(style.getPropertyValue(`--${name}`)), card);
  }
  return { faint, beyond, small, drawn, width: document.documentElement.scrollWidth, inner: innerWidth };
})()
