// SPDX-License-Identifier: BSD-3-Clause
import { Color, ShaderMaterial, Vector2, Vector3 } from "three";
import { SCALE } from "./colours.js";

const vertexShader = `
attribute vec4 cell; // x, y, z, direction + 8 class + 64 corner
uniform float pixel; // metres of a pixel at a distance of one metre
uniform vec3 light;
varying vec3 vCell;
varying vec3 vInPlane;
varying float vShade;
varying float vClass;
varying float vHeight;
void main() {
  float direction = mod(cell.w, 8.0);
  vec3 axis = vec3(direction < 2.0, direction >= 2.0 && direction < 4.0, direction >= 4.0);
  vInPlane = 1.0 - axis;
  vClass = mod(floor(cell.w / 8.0), 8.0) / 7.0;
  float edge = length(modelMatrix[0].xyz);
  vec3 normal = mat3(modelMatrix) * axis * ((2.0 * mod(direction, 2.0) - 1.0) / edge);
  vShade = 0.68 + 0.26 * max(dot(normal, light), 0.0) + 0.1 * normal.z;
  // A third of a pixel larger, so that nothing shines through where rectangles of several sizes meet.
  vec3 corner = (2.0 * (axis.zxy * mod(floor(cell.w / 64.0), 2.0) + axis.yzx * floor(cell.w / 128.0)) - 1.0) * vInPlane;
  float depth = -dot(vec4(modelViewMatrix[0].z, modelViewMatrix[1].z, modelViewMatrix[2].z, modelViewMatrix[3].z), vec4(cell.xyz, 1.0));
  vCell = cell.xyz + corner * (0.34 * pixel * depth / edge);
  vHeight = dot(vec4(modelMatrix[0].z, modelMatrix[1].z, modelMatrix[2].z, modelMatrix[3].z), vec4(vCell, 1.0));
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(vCell, 1.0));
}`;

const fragmentShader = `
uniform vec3 colour;
uniform int mode; // 0 colour, 1 probability, 2 height, 3 picking
uniform vec2 heights;
uniform vec3 scale[5];
uniform bool edges;
uniform float glow;
uniform float opacity;
varying vec3 vCell;
varying vec3 vInPlane;
varying float vShade;
varying float vClass;
varying float vHeight;
vec3 onScale(float t) {
  float s = clamp(t, 0.0, 1.0) * 4.0;
  if (s < 1.0) return mix(scale[0], scale[1], s);
  if (s < 2.0) return mix(scale[1], scale[2], s - 1.0);
  if (s < 3.0) return mix(scale[2], scale[3], s - 2.0);
  return mix(scale[3], scale[4], s - 3.0);
}
void main() {
  if (mode == 3) {
    gl_FragColor = vec4(colour, 1.0);
    return;
  }
  vec3 base = colour;
  if (mode == 1) base = onScale(vClass);
  if (mode == 2) base = onScale((vHeight - heights.x) / (heights.y - heights.x));
  float shade = vShade;
  if (edges) { // of the voxels, where they are large enough to be seen
    vec3 width = fwidth(vCell);
    vec3 near = abs(fract(vCell - 0.5) - 0.5) / max(width, 1e-6) + (1.0 - vInPlane) * 1e3;
    float edge = 1.0 - smoothstep(0.2, 1.1, min(near.x, min(near.y, near.z)));
    float large = 1.0 - smoothstep(0.06, 0.2, max(max(width.x, width.y), width.z));
    shade *= 1.0 - 0.22 * edge * large;
  }
  vec3 lit = mix(base * shade, vec3(1.0), 0.28 * glow);
  gl_FragColor = vec4(lit, opacity);
}`;

export const EDGES_FROM = 5; // pixels of a cell, above which its edges are seen

// Plain colours in, plain colours out: what the page's style says is what is seen.
const plain = (text) => {
  const c = new Color(text).convertLinearToSRGB();
  return new Vector3(c.r, c.g, c.b);
};

/** The material of one node's voxels. */
export function voxelMaterial({ transparent = false } = {}) {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent,
    depthWrite: !transparent,
    toneMapped: false,
    uniforms: {
      colour: { value: new Vector3() },
      mode: { value: 0 },
      heights: { value: new Vector2(0, 1) },
      scale: { value: SCALE.map(plain) },
      edges: { value: false },
      light: { value: new Vector3(0.36, -0.48, 0.8) },
      glow: { value: 0 },
      pixel: { value: 0 },
      opacity: { value: transparent ? 0.3 : 1 },
    },
  });
}

export function setColour(material, text) {
  material.uniforms.colour.value.copy(plain(text));
}
