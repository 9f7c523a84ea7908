// Mouse, fingers and keys that move the camera.

const TURN = 0.008;       // radians a pixel
const KEY_TURN = 0.12;    // radians a key
const KEYS = {
  ArrowLeft: (camera) => camera.turn(KEY_TURN, 0),
  ArrowRight: (camera) => camera.turn(-KEY_TURN, 0),
  ArrowUp: (camera) => camera.turn(0, KEY_TURN),
  ArrowDown: (camera) => camera.turn(0, -KEY_TURN),
  "+": (camera) => camera.zoom(0.85),
  "=": (camera) => camera.zoom(0.85),
  "-": (camera) => camera.zoom(1 / 0.85),
  x: (camera) => camera.lookFrom([1, 0, 0]),
  y: (camera) => camera.lookFrom([0, -1, 0]),
  z: (camera) => camera.lookFrom([0, 0, 1]),
  Home: (camera) => camera.lookHome(),
  0: (camera) => camera.lookHome(),
};

/** changed() is called after each movement. */
export function moveByHand(element, camera, changed) {
  const down = new Map(); // fingers, or the mouse: where each was last
  const place = (event) => [event.clientX, event.clientY];

  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
  });
  for (const end of ["pointerup", "pointercancel"])
    element.addEventListener(end, (event) => down.delete(event.pointerId));

  element.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    const [x, y] = [now[0] - before[0], now[1] - before[1]];
    if (down.size === 1) {
      if (event.shiftKey || event.buttons === 2) camera.shift(x / element.clientHeight, y / element.clientHeight);
      else camera.turn(-TURN * x, -TURN * y);
    } else {
      const other = [...down].find(([id]) => id !== event.pointerId)[1];
      const apart = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]);
      camera.zoom(apart(before) / Math.max(apart(now), 1));
      camera.shift(x / 2 / element.clientHeight, y / 2 / element.clientHeight);
    }
    down.set(event.pointerId, now);
    changed();
  });
  element.addEventListener("contextmenu", (event) => event.preventDefault());

  // The wheel scrolls the page until one has clicked into the picture.
  element.addEventListener("wheel", (event) => {
    if (document.activeElement !== element && !event.ctrlKey) return;
    event.preventDefault();
    camera.zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode === 1 ? 20 : 1)));
    changed();
  }, { passive: false });

  element.addEventListener("keydown", (event) => {
    const move = KEYS[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(camera);
    changed();
  });
}
