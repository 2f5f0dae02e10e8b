// Runs the scene in the page, draws it, and takes pushes from the pointer.

const element = (id) => document.getElementById(id);
const canvas = element("canvas");
const context = canvas.getContext("2d");
const COLORS = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [150, 150, 150]];
const [FORCE_COLOR, PUSH_COLOR] = ["#d55e00", "#a0487c"];
// A pixel of a drag, in N·s; a push is no larger than this.
const [PER_PIXEL, MOST] = [0.4, 120];

let wasm = null;
let still = null;
let frame = null;
let camera = null;
let drag = null;
let isSlow = false;
let shown = 0;
let owed = 0;

// --- The module: requests and answers are texts in its memory.

function answer(length) {
  const bytes = new Uint8Array(wasm.memory.buffer, wasm.surefoot_answer(), length);
  const read = JSON.parse(new TextDecoder().decode(bytes));
  if (read.error) throw new Error(read.error);
  return read;
}

function request(what) {
  const bytes = new TextEncoder().encode(JSON.stringify(what));
  const at = wasm.surefoot_room(bytes.length);
  new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
  return answer(wasm.surefoot_start());
}

// --- What is chosen.

const USUAL_FRICTION = { stand: 0.3, walk: 0.6, "experiment-1": 0.3 };

function chosen() {
  const number = (id) => Number(element(id).value);
  const scene = element("scene").value;
  const what = {
    scene,
    friction: number("friction"),
    load_kg: number("load_kg"),
    gain: number("gain"),
    rate_hz: number("rate_hz"),
  };
  return scene === "walk" ? { ...what, speed_mps: number("speed_mps") } : what;
}

function describeChoices() {
  for (const input of document.querySelectorAll("#panel input[type=range]")) {
    const output = input.closest("label").querySelector("output");
    output.textContent = [input.value, input.dataset.unit].filter(Boolean).join(" ");
  }
  document.querySelector(".walks").hidden = element("scene").value !== "walk";
}

function start() {
  describeChoices();
  try {
    still = request(chosen());
    frame = answer(wasm.surefoot_advance(0));
    camera ??= new Camera(still.view.distance);
    owed = 0;
    element("torques").replaceChildren(...still.joints.map((name) => {
      const row = document.createElement("div");
      row.className = "torque";
      row.append(document.createElement("span"), document.createElement("div"));
      row.firstChild.textContent = row.title = name;
      row.lastChild.className = "track";
      row.lastChild.append(document.createElement("i"));
      return row;
    }));
  } catch (error) {
    frame = null;
    tell("refused", error.message, true);
  }
}

function push(impulse) {
  if (frame && !frame.failure) wasm.surefoot_push(...impulse);
}

// --- What is seen.

function target(poses) {
  const { target: fixed, follows } = still.view;
  const along = poses[follows ?? 0].slice(0, 3);
  return along.map((x, i) => fixed[i] ?? x);
}

function draw() {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, width, height);
  const center = target(frame.poses);
  camera.aim(center, width, height);
  const solids = still.solids.map((s) => place(s, frame.poses[s.body], COLORS[s.group]));
  const ground = still.view.ground ?? 0;
  paintFloor(context, camera, center, still.view.square, ground);
  solids.forEach((solid) => paintShadow(context, camera, solid, ground));
  painted(solids, camera.eye).forEach((solid) => paintSolid(context, camera, solid));
  still.points.forEach((point, i) => {
    const at = placed(frame.poses[still.bodies[i]], point);
    const force = frame.forces[i];
    if (force) paintArrow(context, camera, at, scaled(force, still.force_length), FORCE_COLOR, 2.5);
    if (frame.contacts.length > 0) paintContact(context, camera, at, frame.contacts[i]);
  });
  const body = frame.poses[0].slice(0, 3);
  if (frame.push) paintArrow(context, camera, body, scaled(frame.push, 1e-3), PUSH_COLOR, 5);
  if (drag?.impulse) paintArrow(context, camera, body, scaled(drag.impulse, 1e-2), PUSH_COLOR, 5);
}

function tell(word, detail, isBad) {
  element("word").textContent = word;
  element("word").classList.toggle("stopped", isBad);
  element("detail").textContent = detail;
}

function describe() {
  element("time").textContent = `${frame.time_s.toFixed(2)} s`;
  if (frame.failure) tell("ended", frame.failure, true);
  else if (frame.stopped) tell("stopped", `by the supervisor: ${frame.stopped}`, true);
  else tell(element("scene").value === "walk" ? "walks" : "balances", "", false);
  if (drag?.impulse) {
    element("detail").textContent = `push of ${Math.hypot(...drag.impulse).toFixed(0)} N·s`;
  }
  frame.torques.forEach((torque, i) => {
    const share = Math.max(-1, Math.min(1, torque / still.torque_limits[i]));
    const bar = element("torques").children[i].lastChild.firstChild;
    bar.style.left = `${50 + 50 * Math.min(0, share)}%`;
    bar.style.width = `${50 * Math.abs(share)}%`;
    bar.classList.toggle("much", Math.abs(share) > 0.8);
  });
  const limits = frame.limits;
  const worst = limits?.worst;
  element("limits").textContent = !limits
    ? "This controller knows no limits."
    : worst
      ? `Limits bound in ${(100 * limits.active_share).toFixed(1)} % of the ticks; most of all ${worst.limit} of `
        + `the ${worst.leg} at ${worst.time_s.toFixed(2)} s.`
      : "No limit has bound so far.";
}

function advance(now) {
  const elapsed = Math.min(0.1, 1e-3 * Math.max(0, now - shown)) * (isSlow ? 0.2 : 1);
  shown = now;
  if (frame) {
    try {
      // Ticks are whole: what is left of one is kept for the next picture.
      owed += elapsed;
      const ticks = Math.floor(owed / still.tick_s);
      owed -= ticks * still.tick_s;
      frame = answer(wasm.surefoot_advance(ticks * still.tick_s));
      draw();
      describe();
    } catch (error) {
      frame = null;
      tell("ended", error.message, true);
    }
  }
  requestAnimationFrame(advance);
}

// --- What a person does. A drag from the robot pushes it along the floor; a drag beside it turns the view.

const within = ([x, y]) => {
  const [u, v] = camera.project(frame.poses[0].slice(0, 3));
  return Math.hypot(x - u, y - v) < 0.22 * Math.min(canvas.clientWidth, canvas.clientHeight);
};

function place2d(event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

// Along the screen to the side, and up the screen away from the eye.
function impulseOf([dx, dy]) {
  const flat = unit([camera.towards[0], camera.towards[1], 0]);
  const along = add(scaled(camera.right, dx), scaled(flat, dy));
  const size = Math.min(MOST, PER_PIXEL * Math.hypot(dx, dy));
  return scaled(unit(along), size);
}

canvas.addEventListener("pointerdown", (event) => {
  if (!frame) return;
  canvas.setPointerCapture(event.pointerId);
  const at = place2d(event);
  drag = { from: at, last: at, pushes: within(at), impulse: null };
});
canvas.addEventListener("pointermove", (event) => {
  if (!drag || !frame) return;
  const at = place2d(event);
  if (drag.pushes) drag.impulse = impulseOf([at[0] - drag.from[0], at[1] - drag.from[1]]);
  else camera.orbit(at[0] - drag.last[0], at[1] - drag.last[1]);
  drag.last = at;
});
canvas.addEventListener("pointerup", () => {
  if (drag?.impulse) push(drag.impulse);
  drag = null;
});
canvas.addEventListener("pointercancel", () => { drag = null; });
canvas.addEventListener("wheel", (event) => {
  if (document.activeElement !== canvas) return;
  event.preventDefault();
  camera.zoom(Math.exp(1e-3 * event.deltaY));
}, { passive: false });

for (const button of document.querySelectorAll("[data-push]")) {
  const direction = button.dataset.push.split(",").map(Number);
  button.addEventListener("click", () => push(scaled(direction, Number(element("push").value))));
}
element("again").addEventListener("click", start);
element("slow").addEventListener("click", (event) => {
  isSlow = !isSlow;
  event.currentTarget.setAttribute("aria-pressed", String(isSlow));
});
element("scene").addEventListener("change", (event) => {
  element("friction").value = USUAL_FRICTION[event.target.value];
  start();
});
for (const id of ["friction", "load_kg", "gain", "rate_hz", "speed_mps"]) {
  element(id).addEventListener("input", describeChoices);
  element(id).addEventListener("change", start);
}
element("push").addEventListener("input", describeChoices);
element("panel").addEventListener("submit", (event) => event.preventDefault());

// The page's address may name a scene, a push along y (N·s) and how many tenths of a second to go on before it is shown:
// for a test, and to send somebody a moment. #scene=stand&push=20&tenths=15
async function begin() {
  const packed = element("module").textContent.trim();
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  wasm = (await WebAssembly.instantiate(bytes, {})).instance.exports;
  const address = new URLSearchParams(window.location.hash.slice(1));
  if (address.has("scene")) {
    element("scene").value = address.get("scene");
    element("friction").value = USUAL_FRICTION[address.get("scene")] ?? 0.3;
  }
  start();
  if (frame && address.has("push")) push([0, Number(address.get("push")), 0]);
  for (let left = Number(address.get("tenths") ?? 0); frame && left > 0; left -= 1) {
    frame = answer(wasm.surefoot_advance(0.1));
  }
  // Where it is then, to the last bit, for whoever compares.
  if (frame) document.body.dataset.pose = frame.poses[0].join(" ");
  shown = performance.now();
  requestAnimationFrame(advance);
}

begin().catch((error) => tell("failed", error.message, true));
