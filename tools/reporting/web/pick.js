// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the cursor.

/** Distance along a ray to a triangle and its weights; null if it passes by (Möller, Trumbore). */
function meets(origin, along, x, a, b, c) {
  const edge1 = [0, 1, 2].map((k) => x[3 * b + k] - x[3 * a + k]);
  const edge2 = [0, 1, 2].map((k) => x[3 * c + k] - x[3 * a + k]);
  const p = [along.y * edge2[2] - along.z * edge2[1], along.z * edge2[0] - along.x * edge2[2],
    along.x * edge2[1] - along.y * edge2[0]];
  const size = edge1[0] * p[0] + edge1[1] * p[1] + edge1[2] * p[2];
  if (Math.abs(size) < 1e-12) return null;
  const s = [origin.x - x[3 * a], origin.y - x[3 * a + 1], origin.z - x[3 * a + 2]];
  const u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / size;
  if (u < 0 || u > 1) return null;
  const q = [s[1] * edge1[2] - s[2] * edge1[1], s[2] * edge1[0] - s[0] * edge1[2],
    s[0] * edge1[1] - s[1] * edge1[0]];
  const v = (along.x * q[0] + along.y * q[1] + along.z * q[2]) / size;
  if (v < 0 || u + v > 1) return null;
  return { distance: (edge2[0] * q[0] + edge2[1] * q[1] + edge2[2] * q[2]) / size, weights: [1 - u - v, u, v] };
}

/** The first triangle that a ray meets, of surfaces { x, triangles, lift, keeps(point) }. */
export function firstMet(ray, surfaces) {
  let best = null;
  for (const surface of surfaces) {
    const { x, triangles } = surface;
    const origin = ray.origin.clone();
    origin.z -= surface.lift;
    for (let t = 0; t < triangles.length; t += 3) {
      const met = meets(origin, ray.direction, x, triangles[t], triangles[t + 1], triangles[t + 2]);
      if (!met || (best && met.distance >= best.distance)) continue;
      const point = ray.origin.clone().addScaledVector(ray.direction, met.distance);
      if (surface.keeps(point)) best = { ...met, surface, triangle: t / 3 };
    }
  }
  return best;
}
