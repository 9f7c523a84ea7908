// Vectors of three numbers, as arrays.

export const add = (a, b) => a.map((value, k) => value + b[k]);
export const minus = (a, b) => a.map((value, k) => value - b[k]);
export const scaled = (a, factor) => a.map((value) => value * factor);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = (a) => scaled(a, 1 / Math.hypot(...a));

/** A vector turned about a unit axis by an angle, right-handed. */
export function turned(vector, axis, angle) {
  const along = scaled(axis, dot(axis, vector) * (1 - Math.cos(angle)));
  return add(add(scaled(vector, Math.cos(angle)), scaled(cross(axis, vector), Math.sin(angle))), along);
}
