// Replaces what stands still on the page by what moves: the rods where there is WebGL 2, the plots where there is dygraphs.

import { Colouring } from "viewer/colouring.js";
import { Compass } from "viewer/compass.js";
import { Frames } from "viewer/frames.js";
import { Plots } from "viewer/plots.js";
import { RodsView } from "viewer/rods_view.js";
import { TimeBar, cornerButtons, lookBar } from "viewer/controls.js";
import { supported } from "viewer/packed_columns.js";

const told = JSON.parse(document.getElementById("run").textContent);
let bar = null;
const plots = new Plots(told, (time) => bar?.go(frameAt(time)));
if (told.rods) {
  try {
    await showRods(document.getElementById("view"));
  } catch (reason) {
    document.getElementById("view").insertAdjacentHTML("beforeend", '<p class="note"></p>');
    document.querySelector("#view .note").textContent = `The rods stand still: ${reason.message}.`;
  }
}
document.documentElement.dataset.ready = "yes";

async function showRods(figure) {
  if (!supported()) throw new Error("This browser is too old to unpack them");
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("aria-label", "The rods. Arrows turn them, + and - zoom, x, y and z look along the axes, space plays.");
  canvas.setAttribute("role", "img");
  const stage = figure.querySelector(".stage");
  const still = [...stage.children];
  const frames = await Frames.read(told.rods);
  const beside = {};
  for (const name of ["contacts", "walls", "fixed"]) if (told[name]) beside[name] = await Frames.read(told[name]);
  const colouring = new Colouring(told.colourings, told.map, frames);
  stage.append(canvas);
  let view;
  try {
    view = new RodsView(canvas, told, frames, colouring, beside);
  } catch (reason) {
    canvas.remove();
    throw reason;
  }
  const stands = (yes) => {
    for (const one of [...still, figure.querySelector(".still-caption")]) if (one) one.hidden = !yes;
    canvas.hidden = yes;
    figure.classList.toggle("turns", !yes);
  };
  stands(false);
  canvas.addEventListener("webglcontextlost", () => stands(true));
  stage.insertAdjacentHTML("beforeend", '<p class="hint">drag to turn · click, then scroll to zoom</p>');
  const compass = new Compass(stage, told.length_unit);
  view.onDraw = () => compass.show(view.camera, canvas.clientHeight);
  canvas.addEventListener("pointerdown", () => stage.querySelector(".hint").classList.add("done"));
  bar = new TimeBar(told.rods.times, told.time.unit, (frame) => {
    view.show(frame);
    plots.mark(told.rods.times[frame]);
  });
  stage.append(cornerButtons(view));
  figure.append(bar.element, lookBar(view, colouring));
  bar.go(told.start);
}

function frameAt(time) {
  let best = 0;
  told.rods.times.forEach((one, k) => {
    if (Math.abs(one - time) < Math.abs(told.rods.times[best] - time)) best = k;
  });
  return best;
}
