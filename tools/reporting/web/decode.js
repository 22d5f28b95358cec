// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of tools/reporting/encode.py: base64, deflated, bytes in planes, differences.

async function inflated(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromPlanes(planes, bits) {
  const size = bits / 8;
  const count = planes.length / size;
  const numbers = bits === 16 ? new Uint16Array(count) : new Uint32Array(count);
  for (let plane = 0; plane < size; ++plane) {
    const shift = 8 * plane;
    const start = plane * count;
    for (let i = 0; i < count; ++i) numbers[i] |= planes[start + i] << shift;
  }
  return numbers;
}

/** Undoes the differences, first along the second axis, then from state to state. */
function sumUp(numbers, block) {
  const [states, second] = block.shape;
  const perState = numbers.length / Math.max(states, 1);
  if (block.differences === "place" && block.shape.length > 1) {
    const stride = perState / Math.max(second, 1);
    for (let state = 0; state < states; ++state) {
      const end = (state + 1) * perState;
      for (let i = state * perState + stride; i < end; ++i) numbers[i] += numbers[i - stride];
    }
  }
  for (let i = perState; i < numbers.length; ++i) numbers[i] += numbers[i - perState];
}

/** A block with `state(k)`, the values of a state. */
export async function loadBlock(block) {
  const place = document.getElementById(`block-${block.block}`);
  const numbers = fromPlanes(await inflated(place.textContent.trim()), block.bits);
  sumUp(numbers, block);
  const perState = numbers.length / Math.max(block.shape[0], 1);
  return {
    shape: block.shape,
    state(k) {
      const values = new Float32Array(perState);
      for (let i = 0; i < perState; ++i) values[i] = block.low + block.step * numbers[k * perState + i];
      return values;
    },
    integers: () => Uint32Array.from(numbers),
  };
}
