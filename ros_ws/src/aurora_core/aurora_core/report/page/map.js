// The map: ground once per view, bodies on top of it at every turn of the clock.
const view = { x: 0, y: 0, scale: 1, follow: '', dirty: true };
const colours = {};
let canvas, pen, still, stillPen;

const grounds = {};
for (const kind of ['roads', 'walks', 'crossings']) {
  grounds[kind] = data.ground[kind].map((piece) => piece.map(ring));
}
grounds.buildings = data.ground.buildings.map(([height, name, piece]) => (
  { height, name, rings: piece.map(ring) }));
grounds.zones = data.ground.zones.map(([floor, ceiling, name, piece]) => (
  { floor, ceiling, name, rings: piece.map(ring) }));

function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['ground', 'road', 'road-edge', 'walk', 'zebra', 'low', 'high', 'wall',
    'zone', 'halo', 'ink', 'faint', 'good', 'bad', 'accent']) {
    colours[name] = style.getPropertyValue(`--${name}`).trim();
  }
  view.dirty = true;
}

const toX = (x) => (x - view.x) * view.scale + canvas.clientWidth / 2;
const toY = (y) => canvas.clientHeight / 2 - (y - view.y) * view.scale;

function fit() {
  const [width, height] = data.size;
  view.x = width / 2;
  view.y = height / 2;
  view.scale = Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
  view.dirty = true;
}

function zoom(factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
  const scale = Math.min(Math.max(view.scale * factor, 0.05), 60);
  const left = (x - canvas.clientWidth / 2) * (1 / view.scale - 1 / scale);
  const up = (y - canvas.clientHeight / 2) * (1 / view.scale - 1 / scale);
  view.x += left;
  view.y -= up;
  view.scale = scale;
  view.dirty = true;
  draw();
}

function sized() {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  for (const one of [canvas, still]) {
    one.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    one.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    one.getContext('2d').setTransform(ratio, 0, 0, ratio, 0, 0);
  }
  view.dirty = true;
}

function traced(to, rings, dx = 0, dy = 0) {
  for (const one of rings) {
    for (let k = 0; k < one.x.length; k += 1) {
      const x = toX(one.x[k] + dx);
      const y = toY(one.y[k] + dy);
      if (k) to.lineTo(x, y);
      else to.moveTo(x, y);
    }
    to.closePath();
  }
}

function filled(to, pieces, fill, stroke, width = 1) {
  to.beginPath();
  for (const rings of pieces) traced(to, rings);
  if (stroke) {
    to.strokeStyle = stroke;
    to.lineWidth = width;
    to.stroke();
  }
  to.fillStyle = fill;
  to.fill('evenodd');
}

function written(to, text, x, y, fill, font = '11px system-ui, sans-serif', halo = 3) {
  to.font = font;
  to.textAlign = 'center';
  to.textBaseline = 'middle';
  to.lineJoin = 'round';
  if (halo) {
    to.strokeStyle = colours.halo;
    to.lineWidth = halo;
    to.strokeText(text, x, y);
  }
  to.fillStyle = fill;
  to.fillText(text, x, y);
}

function drawGround() {
  const to = stillPen;
  to.fillStyle = colours.ground;
  to.fillRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  // Each piece has its own path: pieces that overlap must not cut holes into each other.
  for (const piece of grounds.roads) filled(to, [piece], colours.road, colours['road-edge'], 2);
  for (const piece of grounds.roads) filled(to, [piece], colours.road);
  for (const piece of grounds.walks) filled(to, [piece], colours.walk);
  for (const piece of grounds.crossings) filled(to, [piece], colours.zebra);
  to.globalAlpha = 0.16;
  for (const building of grounds.buildings) {
    to.beginPath();
    traced(to, building.rings, 0.16 * building.height, -0.16 * building.height);
    to.fillStyle = '#000000';
    to.fill('evenodd');
  }
  to.globalAlpha = 1;
  for (const building of grounds.buildings) {
    filled(to, [building.rings], colours.low, colours.wall);
    to.globalAlpha = Math.min(building.height / 60, 1);
    filled(to, [building.rings], colours.high);
    to.globalAlpha = 1;
  }
  for (const zone of grounds.zones) {
    to.setLineDash([6, 4]);
    to.globalAlpha = 0.9;
    filled(to, [zone.rings], 'rgba(208, 49, 45, 0.12)', colours.zone, 1.5);
    to.setLineDash([]);
    to.globalAlpha = 1;
  }
  drawNames(to);
  for (const [x, y] of data.ground.signals) {
    const at = [toX(x * data.unit), toY(y * data.unit)];
    to.fillStyle = '#2b2f36';
    to.fillRect(at[0] - 4, at[1] - 8, 8, 16);
    ['#ff5a4e', '#ffc53d', '#3ecf6e'].forEach((colour, k) => {
      to.fillStyle = colour;
      to.beginPath();
      to.arc(at[0], at[1] - 5 + 5 * k, 1.9, 0, 7);
      to.fill();
    });
  }
  drawScale(to);
}

function drawNames(to) {
  const middle = (one) => {
    const sum = (values) => values.reduce((a, b) => a + b, 0) / values.length;
    return [toX(sum(one.x)), toY(sum(one.y))];
  };
  for (const building of grounds.buildings) {
    const width = Math.max(...building.rings[0].x) - Math.min(...building.rings[0].x);
    if (width * view.scale < (building.name ? 70 : 46)) continue;
    const [x, y] = middle(building.rings[0]);
    if (building.name) written(to, building.name, x, y - 7, colours.ink);
    written(to, `${building.height.toFixed(0)} m`, x, y + (building.name ? 7 : 0), colours.faint);
  }
  for (const zone of grounds.zones) {
    const [x, y] = middle(zone.rings[0]);
    written(to, `NO FLY ${zone.floor}–${zone.ceiling} m`, x, y, colours.zone);
  }
  for (const [name, x, y, angle, length] of data.ground.streets) {
    to.font = 'italic 11px system-ui, sans-serif';
    if (length * data.unit * view.scale < 1.3 * to.measureText(name).width) continue;
    to.save();
    to.translate(toX(x * data.unit), toY(y * data.unit));
    const turn = angle > 90 || angle <= -90 ? angle + 180 : angle;
    to.rotate((-turn * Math.PI) / 180);
    written(to, name, 0, 13, colours.faint, 'italic 11px system-ui, sans-serif');
    to.restore();
  }
}

function drawScale(to) {
  const lengths = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000];
  const length = lengths.find((one) => one * view.scale > 60) || 2000;
  const [x, y] = [14, canvas.clientHeight - 16];
  to.strokeStyle = colours.halo;
  to.lineWidth = 6;
  to.beginPath();
  to.moveTo(x, y);
  to.lineTo(x + length * view.scale, y);
  to.stroke();
  to.strokeStyle = colours.ink;
  to.lineWidth = 2.5;
  to.stroke();
  written(to, `${length} m`, x + (length * view.scale) / 2, y - 10, colours.ink);
  written(to, 'N ↑', 18, 16, colours.ink, 'bold 12px system-ui, sans-serif');
}

function draw() {
  const followed = view.follow && stateOf(bodyOf.get(view.follow), clock.time);
  if (followed) {
    view.dirty = view.dirty || followed.x !== view.x || followed.y !== view.y;
    view.x = followed.x;
    view.y = followed.y;
  }
  if (view.dirty) drawGround();
  view.dirty = false;
  pen.save();
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.drawImage(still, 0, 0);
  pen.restore();
  drawScene(pen, clock.time);
}

function startMap() {
  canvas = $('map');
  pen = canvas.getContext('2d');
  still = document.createElement('canvas');
  stillPen = still.getContext('2d');
  readColours();
  sized();
  fit();
  for (const body of named) $('follow').append(el('option', { value: body.id }, body.id));
  $('follow').addEventListener('change', () => {
    view.follow = $('follow').value;
    if (view.follow) view.scale = Math.max(view.scale, 4);
    else fit();
    view.dirty = true;
    draw();
  });
  $('closer').addEventListener('click', () => zoom(1.4));
  $('wider').addEventListener('click', () => zoom(1 / 1.4));
  $('fit').addEventListener('click', () => {
    $('follow').value = view.follow = '';
    fit();
    draw();
  });
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== canvas) return;
    event.preventDefault();
    zoom(event.deltaY < 0 ? 1.15 : 1 / 1.15, event.offsetX, event.offsetY);
  }, { passive: false });
  dragged();
  new ResizeObserver(() => { sized(); if (!view.moved) fit(); draw(); }).observe(canvas);
  night.addEventListener('change', () => {
    readColours();
    draw();
  });
  clock.listeners.push(draw);
}

function dragged() {
  let from = null;
  canvas.addEventListener('pointerdown', (event) => {
    from = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add('held');
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!from) return;
    $('follow').value = view.follow = '';
    view.x -= (event.clientX - from[0]) / view.scale;
    view.y += (event.clientY - from[1]) / view.scale;
    view.moved = view.dirty = true;
    from = [event.clientX, event.clientY];
    draw();
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, () => { from = null; canvas.classList.remove('held'); });
  }
}
