// SPDX-License-Identifier: MIT
// Round numbers along an axis.

/** At most `most` values within low .. high, at 1, 2 or 5 times a power of ten. */
export function ticks(low, high, most) {
  const span = high - low;
  if (!(span > 0)) {
    return [low];
  }
  const power = 10 ** Math.floor(Math.log10(span / most));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => span / s <= most);
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high + step * 1e-9; k++) {
    found.push(Number((k * step).toPrecision(12)));
  }
  return found;
}

/** Range of several columns, a little wider, and never too narrow to read. */
export function rangeOf(columns) {
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    for (const value of column) {
      if (value !== null && Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  if (low > high) {
    return [-1, 1];
  }
  const least = Math.max(1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-6);
  const margin = Math.max(0.06 * (high - low), least);
  return [low - margin, high + margin];
}

/** Index of the last x that is not beyond; -1 before the first. */
export function lastUpTo(xs, x) {
  let low = 0;
  let high = xs.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low - 1;
}
