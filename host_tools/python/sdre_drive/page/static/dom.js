// SPDX-License-Identifier: MIT
// Small helpers for elements, numbers and files.

export const byId = (id) => document.getElementById(id);

/** An element with properties or attributes, and children. Text is never parsed. */
export function el(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element && !name.startsWith("aria")) {
      element[name] = value;
    } else {
      element.setAttribute(name, value);
    }
  }
  element.append(...children);
  return element;
}

/** Changes text only when it differs: a screen reader hears changes. */
export function say(element, text) {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

/** A label above its field, with a text below it that belongs to it. */
export function field(label, input, note = "") {
  const id = input.id || `field-${label.toLowerCase().replace(/[^a-z0-9]+/g, "-")}`;
  input.id = id;
  const parts = [el("label", { htmlFor: id }, label), input];
  if (note) {
    const words = el("small", { id: `${id}-note` }, note);
    input.setAttribute("aria-describedby", words.id);
    parts.push(words);
  }
  return el("div", { className: "field" }, ...parts);
}

/** A field for a number; Enter does what its form is for. */
export function numberInput(properties = {}) {
  return el("input", { type: "text", inputMode: "decimal", autocomplete: "off", ...properties });
}

/** A field that nobody has typed into shows this. An equal text is left alone, so a selection stays. */
export function follow(input, typed, text) {
  if (!typed && input.value !== text) {
    input.value = text;
  }
}

/** A number that a person typed. Throws what is wrong with it. */
export function numberOf(input, name, low = -Infinity, high = Infinity) {
  const text = input.value.trim();
  if (/^[-+]?\d+,\d+$/.test(text)) {
    throw new Error(`${name}: write ${text.replace(",", ".")}, with a point`);
  }
  const value = Number(text);
  if (text === "" || !Number.isFinite(value)) {
    throw new Error(`${name}: "${text}" is no number`);
  }
  if (value < low || value > high) {
    throw new Error(`${name}: ${text} is not within ${short(low)} .. ${short(high)}`);
  }
  return value;
}

/** A number with as many digits as a person reads. */
export function short(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return "-";
  }
  return String(Number(value.toPrecision(digits)));
}

/** With a fixed number of decimals, and never "-0". */
export function fixed(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return "-";
  }
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** Gives the browser a file to keep. */
export function keep(name, content, type = "text/plain") {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Lines of comma-separated values; an unknown one is empty. */
export function csv(header, rows) {
  const cell = (x) => (x === null || x === undefined ? "" : typeof x === "number" ? String(Number(x.toPrecision(9))) : x);
  return [header, ...rows].map((row) => row.map(cell).join(",")).join("\n") + "\n";
}
