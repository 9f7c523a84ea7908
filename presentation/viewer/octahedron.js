// Unit vectors as two numbers: the sphere is pressed onto an octahedron, which is unfolded into a square.

export function direction(a, b) {
  let x = (a / 65535) * 2 - 1;
  let y = (b / 65535) * 2 - 1;
  const z = 1 - Math.abs(x) - Math.abs(y);
  const beyond = Math.max(-z, 0);
  x += x >= 0 ? -beyond : beyond;
  y += y >= 0 ? -beyond : beyond;
  const size = Math.hypot(x, y, z);
  return [x / size, y / size, z / size];
}

/** The two 16-bit numbers of a unit vector along an axis of the box (0, 1, 2). */
export function alongAxis(axis) {
  const middle = 32767.5;
  return [[65535, middle], [middle, 65535], [middle, middle]][axis];
}
