// SPDX-License-Identifier: GPL-3.0-or-later
// The material of plies: a field by a scale, a limit, yarns, a section plane.

const THREE = window.THREE;

const VERTEX = `
attribute float value;
attribute vec4 yarn;       // mm: across the yarns of each family; 1e9: no such family
uniform vec3 towards_eye;
varying float v_value, v_facing;
varying vec4 v_yarn;
#ifdef SECTION
varying vec3 v_place;
#endif
void main() {
  v_value = value;
  v_yarn = yarn;
  vec4 place = modelMatrix * vec4(position, 1.0);
#ifdef SECTION
  v_place = place.xyz;
#endif
  v_facing = abs(dot(normal, towards_eye));
  gl_Position = projectionMatrix * viewMatrix * place;
}`;

const FRAGMENT = `
uniform sampler2D scale;
uniform float low, high, limit, limit_on, spacing, line_width, lit;
uniform vec4 plane;        // kept: dot(place, xyz) <= w
uniform float plane_on;
varying float v_value, v_facing;
varying vec4 v_yarn;
#ifdef SECTION
varying vec3 v_place;
#endif
float line_at(float along, float wide) {
  if (along > 1e8) return 0.0;
  float apart = abs(fract(along / spacing + 0.5) - 0.5) * spacing;
  float pixel = fwidth(along);
  float covered = clamp((wide - apart) / max(pixel, 1e-6) + 0.5, 0.0, 1.0);
  return covered * clamp(spacing / (4.0 * pixel) - 0.5, 0.0, 1.0);
}
void main() {
#ifdef SECTION
  if (plane_on > 0.5 && dot(v_place, plane.xyz) > plane.w) discard;
#endif
  float share = clamp((v_value - low) / max(high - low, 1e-30), 0.0, 1.0);
  vec3 colour = texture2D(scale, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (limit_on > 0.5 && v_value > limit) {
    float stripe = step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 8.0));
    colour = mix(vec3(0.86, 0.05, 0.45), vec3(1.0), 0.45 * stripe);
  }
  if (spacing > 0.0) {
    colour = mix(colour, vec3(1.0), 0.9 * line_at(v_yarn.x, line_width));
    colour = mix(colour, vec3(0.05), 0.8 * line_at(v_yarn.y, line_width));
    colour = mix(colour, vec3(1.0, 0.85, 0.2), 0.9 * line_at(v_yarn.z, line_width));
    colour = mix(colour, vec3(0.1, 0.3, 0.9), 0.8 * line_at(v_yarn.w, line_width));
  }
  gl_FragColor = vec4(colour * mix(1.0, 0.55 + 0.45 * v_facing, lit), 1.0);
}`;

export const plane = { on: { value: 0 }, at: { value: new THREE.Vector4(0, 0, 1, 1e9) } };

/** Uniforms that all plies of a picture share: scale, limits, yarns. */
export function sharedUniforms() {
  const texture = new THREE.DataTexture(new Uint8Array(1024), 256, 1, THREE.RGBAFormat);
  return {
    scale: { value: texture }, low: { value: 0 }, high: { value: 1 }, limit: { value: 0 },
    limit_on: { value: 0 }, spacing: { value: 0 }, line_width: { value: 0.5 },
    plane: plane.at, plane_on: plane.on, towards_eye: { value: new THREE.Vector3(0, 0, 1) },
    lit: { value: 1 },
  };
}

export function plyMaterial(uniforms) {
  return new THREE.ShaderMaterial({
    defines: {}, uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: THREE.DoubleSide,
    extensions: { derivatives: true }, polygonOffset: true, polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

const TOOL_VERTEX = `
varying vec3 v_place;
void main() {
  vec4 place = modelMatrix * vec4(position, 1.0);
  v_place = place.xyz;
  gl_Position = projectionMatrix * viewMatrix * place;
}`;

const TOOL_FRAGMENT = `
uniform vec3 colour, towards_eye;
uniform vec4 plane;
uniform float plane_on;
varying vec3 v_place;
void main() {
#ifdef SECTION
  if (plane_on > 0.5 && dot(v_place, plane.xyz) > plane.w) discard;
#endif
  vec3 normal = normalize(cross(dFdx(v_place), dFdy(v_place)));
  gl_FragColor = vec4(colour * (0.6 + 0.4 * abs(dot(normal, towards_eye))), 1.0);
}`;

export function toolMaterial(colour, towardsEye) {
  return new THREE.ShaderMaterial({
    uniforms: { colour: { value: new THREE.Color(colour) }, towards_eye: towardsEye,
      plane: plane.at, plane_on: plane.on },
    defines: {}, vertexShader: TOOL_VERTEX, fragmentShader: TOOL_FRAGMENT, side: THREE.DoubleSide,
    extensions: { derivatives: true },
  });
}

/** Only a section needs a shader that leaves fragments out, which is slower. */
export function cutting(material, on) {
  if (Boolean(material.defines.SECTION) === on) return;
  material.defines = on ? { SECTION: 1 } : {};
  material.needsUpdate = true;
}
