// Vectors, a camera, and a painter of convex solids on a 2D canvas. Metres; z is up.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => scaled(a, 1 / Math.max(Math.hypot(...a), 1e-12));

// A unit quaternion, scalar first, turns a vector.
function turned([s, ...v], a) {
  const t = scaled(cross(v, a), 2);
  return add(add(a, scaled(t, s)), cross(v, t));
}

// From between two poses [x, y, z, s, i, j, k]; quaternions go the short way.
function between(a, b, part) {
  const sign = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
  const mixed = a.map((x, i) => x + part * ((i < 3 ? 1 : sign) * b[i] - x));
  const norm = Math.hypot(...mixed.slice(3));
  return mixed.map((x, i) => (i < 3 ? x : x / norm));
}

const placed = (pose, point) => add(pose, turned(pose.slice(3), point));

class Camera {
  constructor(distance) {
    this.usual = distance;
    this.reset();
  }

  // A robot faces -x; from its right and a little behind and above, where a thrown block is seen too.
  reset() {
    this.azimuth = 1.15;
    this.elevation = 0.2;
    this.distance = this.usual;
  }

  orbit(dx, dy) {
    this.azimuth -= dx * 0.008;
    this.elevation = Math.min(1.5, Math.max(-0.1, this.elevation + dy * 0.008));
  }

  zoom(factor) {
    const [near, far] = [0.36 * this.usual, 3.6 * this.usual];
    this.distance = Math.min(far, Math.max(near, this.distance * factor));
  }

  aim(target, width, height) {
    const [sa, ca] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const [se, ce] = [Math.sin(this.elevation), Math.cos(this.elevation)];
    this.right = [-sa, ca, 0];
    this.up = [-se * ca, -se * sa, ce];
    this.towards = [ce * ca, ce * sa, se];
    this.target = target;
    this.eye = add(target, scaled(this.towards, this.distance));
    this.middle = [width / 2, height / 2];
    this.focus = 1.75 * Math.min(height, width);
  }

  project(point) {
    const arm = sub(point, this.target);
    const scale = this.focus / Math.max(this.distance - dot(arm, this.towards), 0.015 * this.usual);
    return [
      this.middle[0] + scale * dot(arm, this.right),
      this.middle[1] - scale * dot(arm, this.up),
    ];
  }
}

// A convex solid where it is, with the planes of its faces.
function place(solid, pose, color) {
  const vertices = solid.vertices.map((vertex) => placed(pose, vertex));
  const faces = solid.faces.map((indices) => {
    const [a, b, c] = indices.map((i) => vertices[i]);
    const normal = unit(cross(sub(b, a), sub(c, b)));
    return { indices, normal, level: dot(normal, a) };
  });
  const middle = scaled(vertices.reduce(add), 1 / vertices.length);
  return { vertices, faces, middle, color };
}

// 1 if a may hide b and is painted later, -1 for the reverse. The plane that tells is the face, of either
// solid, behind which the other lies least: at joints solids overlap, and no plane separates them wholly.
// Where two tell the same, the solid nearer to the trunk decides, lest the order flicker.
function order(a, b, eye) {
  let [best, nearer] = [-Infinity, 1];
  for (const [one, other, outside] of [[a, b, -1], [b, a, 1]]) {
    for (const { normal, level } of one.faces) {
      const bias = one.rank < other.rank ? 0.01 : 0;
      const clearance = Math.min(...other.vertices.map((v) => dot(normal, v))) - level + bias;
      if (clearance <= best) continue;
      best = clearance;
      nearer = dot(normal, eye) > level ? outside : -outside;
    }
  }
  return nearer;
}

// Solids that can be told apart from each other in the time of a frame.
const MOST_ORDERED = 40;

// From the back to the front: one after the other that no other must precede. Of very many the farther are first.
function painted(solids, eye) {
  solids.forEach((solid, i) => { solid.rank = i; });
  const far = (solid) => Math.hypot(...sub(solid.middle, eye));
  const waiting = [...solids].sort((a, b) => far(b) - far(a));
  if (waiting.length > MOST_ORDERED) return waiting;
  const result = [];
  while (waiting.length > 0) {
    const free = waiting.findIndex((a) => waiting.every((b) => a === b || order(a, b, eye) < 0));
    result.push(...waiting.splice(Math.max(free, 0), 1));
  }
  return result;
}

const LAMP = unit([0.3, 0.55, 0.78]);

function shade([r, g, b], normal) {
  const light = 0.78 + 0.32 * dot(normal, LAMP);
  return `rgb(${[r, g, b].map((x) => Math.min(255, Math.round(x * light))).join(",")})`;
}

function outline(context, camera, points) {
  context.beginPath();
  points.forEach((point, i) => {
    const [x, y] = camera.project(point);
    if (i === 0) context.moveTo(x, y); else context.lineTo(x, y);
  });
}

function paintSolid(context, camera, solid) {
  context.lineWidth = 0.8;
  context.strokeStyle = "#202020";
  context.lineJoin = "round";
  for (const face of solid.faces) {
    if (dot(face.normal, camera.eye) <= face.level) continue;
    outline(context, camera, face.indices.map((i) => solid.vertices[i]));
    context.closePath();
    context.fillStyle = shade(solid.color, face.normal);
    context.fill();
    context.stroke();
  }
}

function paintShadow(context, camera, solid, ground) {
  context.fillStyle = "#e2e2e2";
  for (const face of solid.faces) {
    outline(context, camera, face.indices.map((i) => [...solid.vertices[i].slice(0, 2), ground]));
    context.fill();
  }
}

function paintGhost(context, camera, solid) {
  context.setLineDash([5, 4]);
  context.lineWidth = 1.2;
  context.strokeStyle = "#5a5a5a";
  for (const face of solid.faces) {
    outline(context, camera, face.indices.map((i) => solid.vertices[i]));
    context.closePath();
    context.stroke();
  }
  context.setLineDash([]);
}

function paintArrow(context, camera, from, along, color, width) {
  const [x1, y1] = camera.project(from);
  const [x2, y2] = camera.project(add(from, along));
  const length = Math.hypot(x2 - x1, y2 - y1);
  if (length < 2) return;
  const head = Math.min(length, 4 * width);
  const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length];
  const [bx, by] = [x2 - head * ux, y2 - head * uy];
  // A rim of white keeps it apart from what is behind.
  for (const [style, extra] of [["#ffffff", 2], [color, 0]]) {
    context.strokeStyle = context.fillStyle = style;
    context.lineWidth = width + extra;
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(bx, by);
    context.stroke();
    context.beginPath();
    context.moveTo(x2 + ux * extra / 2, y2 + uy * extra / 2);
    const side = 0.45 * head + extra / 2;
    context.lineTo(bx - side * uy, by + side * ux);
    context.lineTo(bx + side * uy, by - side * ux);
    context.fill();
  }
}

function paintFloor(context, camera, center, square, ground) {
  const [x0, y0] = center.slice(0, 2).map((x) => Math.round(x / square) * square);
  const reach = 6 * square;
  context.lineWidth = 1;
  for (let k = -6; k <= 6; k += 1) {
    const at = square * k;
    context.strokeStyle = "#d4d4d4";
    outline(context, camera, [[x0 + at, y0 - reach, ground], [x0 + at, y0 + reach, ground]]);
    context.stroke();
    outline(context, camera, [[x0 - reach, y0 + at, ground], [x0 + reach, y0 + at, ground]]);
    context.stroke();
  }
}

// Where something has been, fainter the longer ago.
function paintPath(context, camera, points) {
  context.lineWidth = 1.5;
  context.strokeStyle = "#a0487c";
  points.slice(1).forEach((point, i) => {
    context.globalAlpha = 0.15 + 0.7 * ((i + 1) / points.length);
    outline(context, camera, [points[i], point]);
    context.stroke();
  });
  context.globalAlpha = 1;
}

// Contact points differ in shape as well as in colour: a ring is free, a square slides, a disc sticks.
function paintContact(context, camera, point, state) {
  const [x, y] = camera.project(point);
  const sliding = state === 2 || state === 5 || state === 6;
  context.beginPath();
  if (sliding) context.rect(x - 4, y - 4, 8, 8); else context.arc(x, y, 4, 0, 2 * Math.PI);
  context.fillStyle = state === 1 ? "#ffffff" : sliding ? "#f0e442" : "#000000";
  context.fill();
  context.lineWidth = 1.2;
  context.strokeStyle = "#202020";
  context.stroke();
}
