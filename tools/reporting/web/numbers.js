// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as the reader's browser writes them: 1,234.5 or 1.234,5.

const formats = new Map();

/** A number with so many decimals; "–" if it is none. */
export function written(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (!formats.has(digits)) {
    formats.set(digits, new Intl.NumberFormat(navigator.language,
      { minimumFractionDigits: digits, maximumFractionDigits: digits }));
  }
  const text = formats.get(digits).format(value);
  return /[1-9]/.test(text) ? text : formats.get(digits).format(0); // no "-0.0"
}

/** Decimals that leave three figures or four. */
export function fittingDigits(largest) {
  const size = Math.abs(largest);
  if (!(size > 0)) return 1;
  return Math.min(5, Math.max(0, 2 - Math.floor(Math.log10(size))));
}

/** Writes every <data class="number"> of the page anew. */
export function localise(root) {
  for (const place of root.querySelectorAll("data.number")) {
    place.textContent = written(Number(place.value), Number(place.dataset.digits));
  }
}
