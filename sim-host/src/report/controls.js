// What a person does to the replay: buttons, keys, drags, pinches, events on the time line.

const pointers = new Map();

function spread() {
  const [a, b] = [...pointers.values()];
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
});
canvas.addEventListener("pointermove", (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const apart = pointers.size === 2 ? spread() : 0;
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  if (pointers.size === 2) camera.zoom(apart / Math.max(spread(), 1));
  else camera.orbit(event.clientX - before[0], event.clientY - before[1]);
  draw();
});
for (const kind of ["pointerup", "pointercancel"]) {
  canvas.addEventListener(kind, (event) => pointers.delete(event.pointerId));
}

// The wheel scrolls the page until the picture has been chosen.
canvas.addEventListener("wheel", (event) => {
  if (document.activeElement !== canvas) return;
  event.preventDefault();
  camera.zoom(Math.exp(1e-3 * event.deltaY));
  draw();
}, { passive: false });

const zoomed = (factor) => () => { camera.zoom(factor); draw(); };
element("replay-play").addEventListener("click", () => play(!player.playing));
element("replay-nearer").addEventListener("click", zoomed(0.85));
element("replay-farther").addEventListener("click", zoomed(1 / 0.85));
element("replay-reset").addEventListener("click", () => { camera.reset(); draw(); });
element("replay-slider").addEventListener("input", (event) => {
  player.playing = false;
  seek(Number(event.target.value));
});
for (const id of ["show-forces", "show-wrench", "show-ghost", "show-paths"]) {
  element(id)?.addEventListener("change", draw);
}

element("replay").addEventListener("keydown", (event) => {
  if (["BUTTON", "SELECT"].includes(event.target.tagName)) return;
  const step = event.shiftKey ? 0.1 : Math.max(replay.times[1] - begin, 1e-3) || 0.01;
  const actions = {
    " ": () => play(!player.playing),
    ArrowLeft: () => { player.playing = false; seek(player.time - step); },
    ArrowRight: () => { player.playing = false; seek(player.time + step); },
    Home: () => seek(begin),
    End: () => seek(end),
    "+": zoomed(0.85),
    "-": zoomed(1 / 0.85),
  };
  const action = actions[event.key];
  if (!action || (event.key === " " && event.target.type === "checkbox")) return;
  event.preventDefault();
  action();
});

// Ticks on the time line; labels go to the first row that has room, or are left to the list of events.
const ROWS = 6;

function layOutEvents() {
  const line = element("replay-events");
  line.replaceChildren();
  const full = Array(ROWS).fill(-Infinity);
  let used = 0;
  for (const mark of replay.marks) {
    const x = ((mark.time_s - begin) / Math.max(end - begin, 1e-9)) * line.clientWidth;
    const tick = document.createElement("button");
    tick.type = "button";
    tick.className = "tick";
    tick.style.left = `${x}px`;
    tick.title = `${mark.time_s.toFixed(3)} s: ${mark.label}`;
    tick.setAttribute("aria-label", tick.title);
    tick.addEventListener("click", () => { player.playing = false; seek(mark.time_s); });
    const label = document.createElement("span");
    label.textContent = mark.label;
    tick.append(label);
    line.append(tick);
    const width = label.offsetWidth;
    // A label that would leave the line on the right ends at its tick.
    const from = x + width + 6 > line.clientWidth ? x - width - 4 : x;
    const row = full.findIndex((limit) => from > limit);
    if (row < 0) {
      label.remove();
      continue;
    }
    full[row] = from + width + 8;
    used = Math.max(used, row + 1);
    label.style.top = `${14 * row}px`;
    label.style.left = from < x ? `${-width - 2}px` : "4px";
    tick.style.height = `${14 * (row + 1)}px`;
  }
  line.style.height = `${14 * Math.max(used, 1)}px`;
}

new ResizeObserver(() => { layOutEvents(); draw(); }).observe(canvas);
window.addEventListener("hashchange", seekToAddress);
layOutEvents();
draw();
seekToAddress();
