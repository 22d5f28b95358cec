// SPDX-License-Identifier: GPL-3.0-or-later
// Where a plane cuts plies, at their true thickness, and tools.

const THREE = window.THREE;

/** Ends (two points a cut triangle) and number of the triangles that the plane cuts. */
export function cutsOf(x, triangles, normal, offset) {
  const above = new Float32Array(x.length / 3);
  for (let i = 0; i < above.length; ++i) {
    above[i] = x[3 * i] * normal.x + x[3 * i + 1] * normal.y + x[3 * i + 2] * normal.z - offset;
  }
  const cuts = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const ends = [];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
      if (above[a] < 0 !== above[b] < 0) {
        const share = above[a] / (above[a] - above[b]);
        ends.push([0, 1, 2].map((c) => x[3 * a + c] + share * (x[3 * b + c] - x[3 * a + c])));
      }
    }
    if (ends.length === 2) cuts.push({ triangle: t / 3, ends });
  }
  return cuts;
}

/** Bands as thick as the ply along its cuts: positions, and the triangle of each vertex. */
export function bands(cuts, normal, thickness) {
  const positions = [];
  const of = [];
  for (const { triangle, ends } of cuts) {
    const [p, q] = ends.map((end) => new THREE.Vector3().fromArray(end));
    const half = q.clone().sub(p).cross(normal).normalize().multiplyScalar(0.5 * thickness);
    const corners = [[p, 1], [p, -1], [q, -1], [p, 1], [q, -1], [q, 1]];
    for (const [end, side] of corners) {
      positions.push(...end.clone().addScaledVector(half, side).toArray());
      of.push(triangle);
    }
  }
  return { positions: new Float32Array(positions), of };
}

/** The plane: `angle` degrees from x about z, through a point; or level. */
export function planeOf(section, box) {
  const middle = box.getCenter(new THREE.Vector3());
  const normal = section.level ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(
    -Math.sin((section.angle * Math.PI) / 180), Math.cos((section.angle * Math.PI) / 180), 0);
  if (!section.level) normal.negate();
  return { normal, offset: middle.dot(normal) + section.offset * (section.level ? 1 : -1) };
}
