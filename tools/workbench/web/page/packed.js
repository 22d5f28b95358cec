// SPDX-License-Identifier: GPL-3.0-or-later
// Answers that carry arrays: uint32 length of a header, the header as JSON, padding to a multiple of 4
// bytes, the arrays. In the header an array is {at, count, type}, `at` in bytes from the padding's end.

const KINDS = { f4: Float32Array, u4: Uint32Array };

const isArray = (value) => value.at !== undefined && value.count !== undefined && KINDS[value.type];

/** The header, with each array in its place. */
export function unpacked(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const start = 4 * Math.ceil((4 + length) / 4);
  const filled = (value) => {
    if (!value || typeof value !== "object") return value;
    if (Array.isArray(value)) return value.map(filled);
    if (isArray(value)) return new KINDS[value.type](buffer, start + value.at, value.count);
    return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, filled(one)]));
  };
  return filled(header);
}
