// Who is where now: ways so far, vehicles, persons, UAVs, sight lines, messages on their way.
// A message takes a tenth of a second; it is shown for so long, in seconds of the run.
const SHOWN_S = 1.6;
// A body is drawn at least so long, in pixels: a car on a whole city is a dot.
const LEAST_PX = 15;

function drawScene(to, time) {
  for (const body of data.bodies) drawWay(to, body, time);
  for (const sight of data.sights) drawSight(to, sight, time);
  const grounded = data.bodies.filter((body) => body.kind !== 'uav');
  const flying = data.bodies.filter((body) => body.kind === 'uav');
  for (const body of [...grounded, ...flying]) drawBody(to, body, time);
  const taken = [];
  for (const body of [...flying, ...grounded]) drawName(to, body, time, taken);
  for (const message of data.messages) drawMessage(to, message, time);
  for (const moment of data.moments) drawMoment(to, moment, time);
}

function drawWay(to, body, time) {
  const last = Math.min(Math.floor(time / data.step), data.count - 1);
  const every = Math.max(1, Math.floor(data.count / 600));
  to.lineJoin = 'round';
  to.strokeStyle = hue(body);
  to.lineWidth = body.role === 'background' ? 1 : 2.5;
  const line = (from, end) => {
    to.beginPath();
    for (const [first, until] of body.there) {
      let begun = false;
      for (let k = Math.max(first, from); k <= Math.min(until, end); k += every) {
        if (begun) to.lineTo(toX(body.x[k]), toY(body.y[k]));
        else to.moveTo(toX(body.x[k]), toY(body.y[k]));
        begun = true;
      }
    }
    to.stroke();
  };
  if (body.kind === 'uav') to.setLineDash([6, 3]);
  to.globalAlpha = 0.22;
  if (body.role !== 'background') line(0, data.count - 1);
  to.globalAlpha = body.role === 'background' ? 0.35 : 0.85;
  line(0, last);
  to.globalAlpha = 1;
  to.setLineDash([]);
}

function drawBody(to, body, time) {
  const state = stateOf(body, time);
  if (!state) return;
  const [x, y] = [toX(state.x), toY(state.y)];
  const size = Math.max(body.size[0] * view.scale, LEAST_PX);
  to.fillStyle = hue(body);
  to.strokeStyle = colours.halo;
  to.lineWidth = 1.5;
  to.save();
  if (body.kind === 'uav') {
    // Its shadow lies as far off as it is high, as those of buildings do.
    to.globalAlpha = 0.25;
    to.beginPath();
    to.arc(x + 0.16 * state.z * view.scale, y + 0.16 * state.z * view.scale, size / 2.4, 0, 7);
    to.fillStyle = '#000000';
    to.fill();
    to.globalAlpha = 1;
    to.fillStyle = hue(body);
  }
  to.translate(x, y);
  to.rotate((-state.h * Math.PI) / 180);
  to.beginPath();
  if (body.kind === 'person') {
    to.arc(0, 0, Math.max(size / 2.6, 4.5), 0, 7);
  } else if (body.kind === 'uav') {
    const arm = Math.max(size * 0.42, 7);
    for (const [sx, sy] of [[1, 1], [1, -1], [-1, -1], [-1, 1]]) {
      to.moveTo(sx * arm * 0.8 + arm * 0.42, sy * arm * 0.8);
      to.arc(sx * arm * 0.8, sy * arm * 0.8, arm * 0.42, 0, 7);
    }
    to.moveTo(arm * 1.25, 0);
    to.lineTo(-arm * 0.5, arm * 0.5);
    to.lineTo(-arm * 0.5, -arm * 0.5);
    to.closePath();
  } else {
    const width = Math.max(body.size[1] * view.scale, size * 0.42);
    to.moveTo(size / 2, 0);
    to.lineTo(size * 0.28, width / 2);
    to.lineTo(-size / 2, width / 2);
    to.lineTo(-size / 2, -width / 2);
    to.lineTo(size * 0.28, -width / 2);
    to.closePath();
  }
  to.stroke();
  to.fill();
  to.restore();
}

function drawName(to, body, time, taken) {
  const state = body.role === 'background' ? null : stateOf(body, time);
  if (!state) return;
  const text = body.kind === 'uav' ? `${body.id} ${state.z.toFixed(0)} m` : body.id;
  to.font = 'bold 12px system-ui, sans-serif';
  const half = to.measureText(text).width / 2;
  const x = toX(state.x);
  const up = Math.max((body.size[0] * view.scale) / 2, 8) + 10;
  const rows = [-up, up, -up - 15, up + 15, -up - 30, up + 30];
  const free = (y) => !taken.some((other) => (
    Math.abs(other.y - y) < 14 && Math.abs(other.x - x) < other.half + half + 4));
  const y = rows.map((row) => toY(state.y) + row).find(free) ?? toY(state.y) - up;
  taken.push({ x, y, half });
  const old = [to.fillStyle];
  written(to, text, x, y, colours.ink, 'bold 12px system-ui, sans-serif', 4);
  to.fillStyle = hue(body);
  to.fillRect(x - half - 7, y - 4, 5, 8);
  [to.fillStyle] = old;
}

function drawSight(to, sight, time) {
  const ends = [bodyOf.get(sight.by), bodyOf.get(sight.of)].map((b) => b && stateOf(b, time));
  if (!ends[0] || !ends[1]) return;
  let seen = null;
  for (const [from, visible] of sight.seen) if (from <= time + 1e-9) seen = visible;
  if (seen === null) return;
  to.strokeStyle = seen ? colours.good : colours.bad;
  to.lineWidth = seen ? 1.6 : 1.2;
  to.setLineDash(seen ? [] : [3, 4]);
  to.beginPath();
  to.moveTo(toX(ends[0].x), toY(ends[0].y));
  to.lineTo(toX(ends[1].x), toY(ends[1].y));
  to.stroke();
  to.setLineDash([]);
  if (!seen) return;
  to.beginPath();
  const reach = Math.max((bodyOf.get(sight.of).size[0] * view.scale) / 1.5, 13);
  to.arc(toX(ends[1].x), toY(ends[1].y), reach, 0, 7);
  to.stroke();
}

function drawMessage(to, message, time) {
  const over = time - message.sent;
  const lasts = Math.max(SHOWN_S, (message.end ?? data.end) - message.sent);
  if (over < -1e-9 || over > lasts) return;
  const ends = [message.from, message.to].map((id) => bodyOf.get(id));
  const [a, b] = ends.map((body) => body && stateOf(body, time));
  if (!a || !b) return;
  const colour = message.ok ? '#9a5cc0' : colours.bad;
  const [ax, ay, bx, by] = [toX(a.x), toY(a.y), toX(b.x), toY(b.y)];
  const length = Math.hypot(bx - ax, by - ay) || 1;
  const bow = Math.max(0.18 * length, 26);
  const [cx, cy] = [(ax + bx) / 2 + ((by - ay) / length) * bow,
    (ay + by) / 2 - ((bx - ax) / length) * bow];
  to.strokeStyle = colour;
  to.lineWidth = 2;
  to.setLineDash(message.ok ? [] : [5, 4]);
  to.beginPath();
  to.moveTo(ax, ay);
  to.quadraticCurveTo(cx, cy, bx, by);
  to.stroke();
  to.setLineDash([]);
  const share = Math.min(over / (0.6 * lasts), 1);
  const at = (p, c, q, u) => (1 - u) ** 2 * p + 2 * u * (1 - u) * c + u ** 2 * q;
  const [x, y] = [at(ax, cx, bx, share), at(ay, cy, by, share)];
  drawLostAttempts(to, message, time, [at(ax, cx, bx, 0.5), at(ay, cy, by, 0.5)]);
  to.fillStyle = colour;
  to.fillRect(x - 8, y - 5.5, 16, 11);
  to.strokeStyle = '#ffffff';
  to.lineWidth = 1.3;
  to.strokeRect(x - 8, y - 5.5, 16, 11);
  to.beginPath();
  to.moveTo(x - 8, y - 5.5);
  to.lineTo(x, y + 1);
  to.lineTo(x + 8, y - 5.5);
  to.stroke();
}

/** Draws how often a message has been lost so far: a cross amid its way, and the number. */
function drawLostAttempts(to, message, time, [x, y]) {
  const lost = message.lost.filter((t) => t <= time + 1e-9).length;
  if (!lost) return;
  written(to, `${lost} lost`, x, y - 16, colours.bad, 'bold 11px system-ui, sans-serif');
  cross(to, x, y, 5, 2.2);
}

function cross(to, x, y, arm, width) {
  to.strokeStyle = colours.bad;
  to.lineWidth = width;
  to.beginPath();
  to.moveTo(x - arm, y - arm);
  to.lineTo(x + arm, y + arm);
  to.moveTo(x + arm, y - arm);
  to.lineTo(x - arm, y + arm);
  to.stroke();
}

function drawMoment(to, moment, time) {
  if (moment.t === null || !moment.at || !['failure', 'fault'].includes(moment.tone)) return;
  if (time < moment.t) return;
  const [x, y] = [toX(moment.at[0]), toY(moment.at[1])];
  cross(to, x, y, 6, 3);
}
