// A rod is a rectangle that faces the viewer and covers it; every pixel of it asks where its ray meets the spherocylinder.
// All in the camera's coordinates: the eye is the origin.

export const vertex = `#version 300 es
precision highp usampler2D;
uniform usampler2D u_rods;              // two texels a rod: x, y, z, axis; axis, length, diameter, nothing; 0 to 65535
uniform sampler2D u_colours;            // one texel a rod
uniform mat4 u_view, u_projection;
uniform vec3 u_low, u_span;
uniform vec2 u_length, u_diameter;      // least, and greatest less least
uniform float u_near;
flat out vec3 v_centre, v_axis, v_colour;
flat out vec2 v_size;                   // half length, radius
out vec3 v_point;

const vec2 CORNERS[6] = vec2[6](vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0, 1), vec2(1, 0), vec2(1, 1));

vec3 direction(vec2 folded) {
  vec2 p = 2.0 * folded - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float beyond = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -beyond : beyond;
  n.y += n.y >= 0.0 ? -beyond : beyond;
  return normalize(n);
}

void main() {
  // Six corners a rod, of two triangles. Instances of four would be drawn one by one where there is no graphics processor.
  int rod = gl_VertexID / 6, columns = textureSize(u_colours, 0).x;
  ivec2 texel = ivec2(rod % columns, rod / columns);
  vec4 first = vec4(texelFetch(u_rods, ivec2(2 * texel.x, texel.y), 0)) / 65535.0;
  vec4 second = vec4(texelFetch(u_rods, ivec2(2 * texel.x + 1, texel.y), 0)) / 65535.0;
  vec3 centre = (u_view * vec4(u_low + u_span * first.xyz, 1.0)).xyz;
  vec3 axis = mat3(u_view) * direction(vec2(first.w, second.x));
  float half_length = 0.5 * (u_length.x + u_length.y * second.y);
  float radius = 0.5 * (u_diameter.x + u_diameter.y * second.z);
  float far = length(centre);
  vec3 ray = centre / far;
  vec3 along = axis - dot(axis, ray) * ray;
  float share = length(along);  // of the axis that is seen
  along = share > 1e-4 ? along / share : normalize(cross(ray, abs(ray.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
  vec3 across = cross(ray, along);
  // Depths of the two ends; what is nearer looks larger in the plane of the rectangle.
  vec2 depth = far + vec2(-1, 1) * half_length * dot(axis, ray);
  if (min(depth.x, depth.y) - radius < u_near) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // cut by the eye: not drawn
    return;
  }
  vec2 round_reach = 1.05 * radius * far / (depth - radius);
  vec2 reach = half_length * share * far / depth + round_reach;
  vec2 corner = CORNERS[gl_VertexID % 6];
  v_point = centre + along * mix(-reach.x, reach.y, corner.x) +
            across * (2.0 * corner.y - 1.0) * max(round_reach.x, round_reach.y);
  gl_Position = u_projection * vec4(v_point, 1.0);
  v_centre = centre;
  v_axis = axis;
  v_size = vec2(half_length, radius);
  v_colour = texelFetch(u_colours, texel, 0).rgb;
}`;

export const fragment = `#version 300 es
precision highp float;
flat in vec3 v_centre, v_axis, v_colour;
flat in vec2 v_size;
in vec3 v_point;
uniform mat4 u_projection;
uniform vec4 u_slab;          // unit normal, and offset of the plane through the middle
uniform float u_slab_half;    // half its thickness; negative: there is none
uniform vec4 u_head;          // colour of the end that swims ahead; the last number: whether it is marked
layout(location = 0) out vec4 o_colour;
layout(location = 1) out vec4 o_normal;

const float NEVER = 1e30;

/// Where the ray o + t d enters the ball of that radius about the origin.
float ball(vec3 o, vec3 d, float radius) {
  float b = dot(o, d);
  float h = b * b - dot(o, o) + radius * radius;
  return h < 0.0 ? NEVER : -b - sqrt(h);
}

/// Where it enters the spherocylinder about the origin.
float spherocylinder(vec3 o, vec3 d, vec3 axis, float half_length, float radius) {
  float dn = dot(d, axis), on = dot(o, axis);
  vec3 dp = d - dn * axis, op = o - on * axis;
  float a = dot(dp, dp), b = dot(dp, op), h = b * b - a * (dot(op, op) - radius * radius);
  if (h < 0.0) return NEVER;
  float place = a > 1e-9 ? on - dn * (b + sqrt(h)) / a : -sign(dn) * NEVER;
  if (abs(place) <= half_length) return (-b - sqrt(h)) / a;
  return ball(o - clamp(place, -half_length, half_length) * axis, d, radius);
}

void main() {
  float half_length = v_size.x, radius = v_size.y;
  vec3 ray = normalize(v_point), from = v_point - v_centre;
  float t = spherocylinder(from, ray, v_axis, half_length, radius);
  if (t == NEVER) discard;
  vec3 hit = from + t * ray;
  float place = dot(hit, v_axis);
  vec3 normal = (hit - clamp(place, -half_length, half_length) * v_axis) / radius;
  if (u_slab_half >= 0.0) {
    float speed = dot(u_slab.xyz, ray), height = dot(u_slab.xyz, v_point) + u_slab.w;
    float enter = (-sign(speed) * u_slab_half - height) / speed, leave = (sign(speed) * u_slab_half - height) / speed;
    if (t < enter) {  // cut open: seen is the face, if the ray is inside there
      hit = from + enter * ray;
      place = dot(hit, v_axis);
      if (distance(hit, clamp(place, -half_length, half_length) * v_axis) > radius) discard;
      t = enter;
      normal = -sign(speed) * u_slab.xyz;
    }
    if (t > leave) discard;
  }
  bool head = half_length > 0.0 ? place > half_length : place > 0.7 * radius;
  o_colour = vec4(head && u_head.a > 0.0 ? u_head.rgb : v_colour, 1.0);
  o_normal = vec4(0.5 * normal + 0.5, 1.0);
  vec4 at = u_projection * vec4(v_point + t * ray, 1.0);
  gl_FragDepth = 0.5 * at.z / at.w + 0.5;
}`;
