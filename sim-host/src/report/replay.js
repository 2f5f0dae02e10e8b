// Plays the run that is embedded in the page.

const replay = JSON.parse(document.getElementById("replay-data").textContent);
const element = (id) => document.getElementById(id);
const canvas = element("replay-canvas");
const context = canvas.getContext("2d");
const camera = new Camera(replay.view.distance);
const last = replay.times.length - 1;
const [begin, end] = [replay.times[0], replay.times[last]];
const COLORS = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [150, 150, 150]];
const [FORCE_COLOR, DESIRED_COLOR, TORQUE_COLOR, BLOCK_COLOR] =
  ["#d55e00", "#000000", "#56b4e9", "#a0487c"];
const player = { time: begin, playing: false, shown: 0 };

// What is chosen; what a page has no choice of is not shown.
const chosen = (id) => element(id)?.checked ?? false;

// A pose of frame k: integers of the run's unit of length, and of 1e-4.
function pose(list, k, i, count) {
  const numbers = list.slice(7 * (k * count + i), 7 * (k * count + i + 1));
  return numbers.map((x, j) => x * (j < 3 ? replay.unit : 1e-4));
}

// What the eye looks at: what stands, or goes along with a body or with the mean of all.
function target(poses) {
  const { target: fixed, follows } = replay.view;
  const along = follows === null
    ? scaled(poses.map((at) => at.slice(0, 3)).reduce(add), 1 / poses.length)
    : poses[follows].slice(0, 3);
  return along.map((x, i) => fixed[i] ?? x);
}

// Frames of the path that is drawn, and the seconds that it goes back.
const [PATH_FRAMES, PATH_SECONDS] = [150, 2];

function path(k, now) {
  const last = replay.bodies - 1;
  const points = [];
  const from = Math.max(0, k - PATH_FRAMES);
  for (let i = from; i <= k; i += 1) {
    if (replay.times[i] < player.time - PATH_SECONDS) continue;
    points.push(pose(replay.poses, i, last, replay.bodies).slice(0, 3));
  }
  return [...points, now[last].slice(0, 3)];
}

// The frame before a time, and how far on the way to the next.
function frameAt(time) {
  let [low, high] = [0, last];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (replay.times[middle] <= time) low = middle; else high = middle;
  }
  const span = replay.times[high] - replay.times[low];
  const part = span > 0 ? Math.min(1, Math.max(0, (time - replay.times[low]) / span)) : 0;
  return [low, Math.min(low + 1, last), part];
}

function draw() {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, width, height);

  const [k, next, part] = frameAt(player.time);
  const count = replay.bodies;
  const poses = Array.from(
    { length: count },
    (_, i) => between(pose(replay.poses, k, i, count), pose(replay.poses, next, i, count), part),
  );
  const nearest = part < 0.5 ? k : next;
  const center = target(poses);
  camera.aim(center, width, height);
  const still = [0, 0, 0, 1, 0, 0, 0];
  const solids = replay.solids.map(
    (solid) => place(solid, solid.body === null ? still : poses[solid.body], COLORS[solid.group]),
  );
  let block = null;
  if (replay.block) {
    const at = between(pose(replay.block_poses, k, 0, 1), pose(replay.block_poses, next, 0, 1), part);
    block = place(replay.block, at, COLORS[3]);
    solids.push(block);
  }
  // Where nothing is a floor, the squares go along below.
  const { square, ground: level } = replay.view;
  const ground = level ?? center[2] - 3 * square;
  paintFloor(context, camera, center, square, ground);
  solids.forEach((solid) => paintShadow(context, camera, solid, ground));
  if (chosen("show-paths")) paintPath(context, camera, path(k, poses));
  painted(solids, camera.eye).forEach((solid) => paintSolid(context, camera, solid));
  if (replay.set_point && chosen("show-ghost")) {
    paintGhost(context, camera, place(replay.set_point, still));
  }
  drawContacts(poses, nearest);
  if (replay.wrench.length > 0 && chosen("show-wrench")) drawWrench(poses[0], nearest);
  if (block && chosen("show-forces")) {
    const force = replay.block_forces.slice(3 * nearest, 3 * nearest + 3);
    paintArrow(context, camera, block.middle, scaled(force, replay.force_length), BLOCK_COLOR, 3);
  }
  describe(nearest);
}

function drawContacts(poses, k) {
  replay.corners.forEach((corner, i) => {
    const all = replay.corners.length;
    const at = placed(poses[replay.feet[i]], corner);
    if (replay.forces.length > 0 && chosen("show-forces")) {
      const force = replay.forces.slice(3 * (all * k + i), 3 * (all * k + i + 1));
      const length = replay.force_unit * replay.force_length;
      paintArrow(context, camera, at, scaled(force, length), FORCE_COLOR, 2.5);
    }
    if (replay.contacts) paintContact(context, camera, at, Number(replay.contacts[all * k + i]));
  });
}

// The wrench is given in the body's frame; arrows are drawn in the world's.
function drawWrench(body, k) {
  const wrench = replay.wrench.slice(6 * k, 6 * k + 6);
  const [force, torque] = [wrench.slice(0, 3), wrench.slice(3)].map((v) => turned(body.slice(3), v));
  paintArrow(context, camera, body, scaled(force, replay.desired_force_length), DESIRED_COLOR, 3.5);
  paintArrow(context, camera, body, scaled(torque, replay.torque_length), TORQUE_COLOR, 3.5);
}

function describe(k) {
  element("replay-time").textContent = `${player.time.toFixed(3)} s`;
  if (replay.errors.length > 0) {
    const [distance, angle] = replay.errors.slice(2 * k, 2 * k + 2);
    element("replay-error").textContent = `error ${distance.toFixed(2)} mm, ${angle.toFixed(2)}°`;
  }
  element("replay-slider").value = String(player.time);
  element("replay-slider").setAttribute("aria-valuetext", `${player.time.toFixed(3)} seconds`);
  element("replay-play").textContent = player.playing ? "Pause" : "Play";
}

function seek(time) {
  player.time = Math.min(end, Math.max(begin, time));
  draw();
}

function play(playing) {
  if (playing && player.time >= end) player.time = begin;
  player.playing = playing;
  player.shown = performance.now();
  draw();
  if (playing) requestAnimationFrame(advance);
}

function advance(now) {
  if (!player.playing) return;
  player.time += 1e-3 * Math.max(0, now - player.shown) * Number(element("replay-speed").value);
  player.shown = now;
  if (player.time >= end) {
    player.time = end;
    player.playing = false;
  }
  draw();
  if (player.playing) requestAnimationFrame(advance);
}

// The page's address may name a time: #t=0.32 goes there and waits.
function seekToAddress() {
  const match = /^#t=([0-9.]+)$/.exec(window.location.hash);
  if (!match) return;
  player.playing = false;
  seek(Number(match[1]));
}
