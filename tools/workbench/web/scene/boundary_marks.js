// SPDX-License-Identifier: GPL-3.0-or-later
// Grips, frames, symmetry planes, springs and the directions in which tools go.

const THREE = window.THREE;

const COLOURS = { grip: 0x7b3294, gripper: 0x7b3294, frame: 0x444444, spring: 0x008a5a, symmetry: 0x0072b2 };

function points(places, colour) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(places), 3));
  return new THREE.Points(geometry, new THREE.PointsMaterial({ color: colour, size: 5, sizeAttenuation: false }));
}

function line(places, colour, closed) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(places), 3));
  const material = new THREE.LineBasicMaterial({ color: colour });
  return closed ? new THREE.LineLoop(geometry, material) : new THREE.LineSegments(geometry, material);
}

/** A sheet of glass through a point, upright, as large as the box. */
function symmetryPlane(at, normal, box) {
  const size = box.getSize(new THREE.Vector3());
  const wide = 1.1 * Math.hypot(size.x, size.y);
  const high = Math.max(0.3 * wide, Math.min(size.z, 0.6 * wide));
  const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(wide, high), new THREE.MeshBasicMaterial({
    color: COLOURS.symmetry, transparent: true, opacity: 0.14, side: THREE.DoubleSide, depthWrite: false }));
  mesh.up.set(0, 0, 1);
  mesh.position.copy(at);
  mesh.lookAt(at.clone().add(normal));
  mesh.renderOrder = 5;
  return mesh;
}

/** Places of the nodes that a boundary holds, of the ply that it names or of all. */
function nodesHeld(boundary, plies) {
  const held = [];
  plies.forEach((ply, i) => {
    const nodes = Array.isArray(boundary.nodes) ? boundary.nodes[i]
      : !boundary.ply || boundary.ply === ply.name ? boundary.nodes : null;
    if (!nodes || !ply.x) return;
    for (const node of nodes) if (3 * node + 2 < ply.x.length) held.push(...ply.x.subarray(3 * node, 3 * node + 3));
  });
  return held;
}

export function boundaryParts(boundary, plies, box) {
  const colour = COLOURS[boundary.kind] || 0x555555;
  const held = nodesHeld(boundary, plies);
  const { point, normal: across } = boundary.fields || {};
  const places = Array.from(boundary.places || point || []);
  if (places.length === 2) places.push(0);
  const corners = Array.from(boundary.hinges || []).slice(0, 12); // at the start
  const parts = [];
  if (held.length) parts.push(points(held, colour));
  if (boundary.kind === "symmetry" && (across || boundary.direction)) {
    const at = new THREE.Vector3().fromArray(places.length ? places : held.length ? held : [0, 0, 0]);
    const middle = box.getCenter(new THREE.Vector3());
    const normal = new THREE.Vector3(...(across || boundary.direction)).normalize();
    if (!across || across.length < 3) normal.z = 0;
    at.add(middle.clone().sub(at).projectOnPlane(normal));
    parts.push(symmetryPlane(at, normal, box));
  } else if (corners.length) {
    parts.push(line(corners, colour, true));
  } else if (boundary.kind === "spring" && places.length && held.length) {
    const ends = [];
    for (let i = 0; i < held.length; i += 3) ends.push(...held.slice(i, i + 3), ...places.slice(0, 3));
    parts.push(line(ends, colour, false), points(places, colour));
  } else if (places.length) {
    parts.push(points(places, colour));
  }
  return parts;
}

/** An arrow from the middle of a tool, the way that it goes. */
export function arrowOf(tool, box) {
  if (!tool.direction || tool.motion === "fixed" || !tool.motion) return null;
  const along = new THREE.Vector3().fromArray(tool.direction);
  if (along.length() < 1e-9) return null;
  const middle = new THREE.Box3().setFromArray(tool.x).getCenter(new THREE.Vector3());
  const long = 0.12 * box.getSize(new THREE.Vector3()).length();
  const arrow = new THREE.ArrowHelper(along.normalize(), middle.addScaledVector(along, -0.5 * long), long,
    tool.motion === "force" ? 0x8a5300 : 0x00629b, 0.3 * long, 0.14 * long);
  arrow.line.renderOrder = 8;
  return arrow;
}
