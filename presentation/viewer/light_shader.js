// Light on what the rods left in the buffers: a lamp up and left of the viewer, a weak one from the right, less light where
// others are near (ambient occlusion), and paler with depth.

export const vertex = `#version 300 es
out vec2 v_place;
void main() {
  v_place = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * v_place - 1.0, 0.0, 1.0);
}`;

export const fragment = `#version 300 es
precision highp float;
precision highp sampler2D;
in vec2 v_place;
uniform sampler2D u_colour, u_normal, u_depth;
uniform vec3 u_background;
uniform vec2 u_tangents;   // half the picture at distance 1
uniform vec2 u_range;      // near and far plane
uniform vec2 u_fade;       // depths between which rods grow pale
uniform float u_radius;    // within which neighbours take light away
uniform int u_samples;
out vec4 o_colour;

const float TURN = 2.39996;  // golden angle: samples spread evenly over a disc

float depth_at(vec2 place) {
  float z = 2.0 * texture(u_depth, place).r - 1.0;
  return 2.0 * u_range.x * u_range.y / (u_range.y + u_range.x - z * (u_range.y - u_range.x));
}

vec3 point_at(vec2 place) {
  float depth = depth_at(place);
  return vec3((2.0 * place - 1.0) * u_tangents * depth, -depth);
}

float light_left(vec3 point, vec3 normal) {
  float start = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec2 reach = 0.5 * u_radius / (-point.z * u_tangents);
  float taken = 0.0;
  for (int k = 0; k < u_samples; k++) {
    float share = sqrt((float(k) + 0.5) / float(u_samples)), angle = start + TURN * float(k);
    vec3 to = point_at(v_place + share * reach * vec2(cos(angle), sin(angle))) - point;
    float size = length(to);
    taken += max(dot(to, normal) / (size + 1e-4) - 0.08, 0.0) * max(1.0 - size / (2.0 * u_radius), 0.0);
  }
  return clamp(1.0 - 2.6 * taken / float(u_samples), 0.0, 1.0);
}

void main() {
  if (texture(u_depth, v_place).r == 1.0) {
    o_colour = vec4(u_background, 1.0);
    return;
  }
  vec3 point = point_at(v_place), normal = normalize(2.0 * texture(u_normal, v_place).xyz - 1.0);
  vec3 paint = pow(texture(u_colour, v_place).rgb, vec3(2.2)), to_eye = normalize(-point);
  float left = u_samples > 0 ? light_left(point, normal) : 1.0;
  vec3 lamp = normalize(vec3(-0.45, 0.75, 0.7));
  float bright = 0.72 * max(dot(normal, lamp), 0.0) + 0.16 * max(dot(normal, normalize(vec3(0.9, 0.1, 0.5))), 0.0);
  float ambient = 0.36 + 0.14 * normal.y;
  float shine = 0.16 * pow(max(dot(normal, normalize(lamp + to_eye)), 0.0), 40.0);
  vec3 colour = paint * (ambient * left + bright * mix(0.45, 1.0, left)) + shine * left;
  colour = pow(clamp(colour, 0.0, 1.0), vec3(1.0 / 2.2));
  float pale = 0.38 * smoothstep(u_fade.x, u_fade.y, -point.z);
  o_colour = vec4(mix(colour, u_background, pale), 1.0);
}`;
