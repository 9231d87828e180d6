// What the page was given, and where everybody is at a time.
const data = JSON.parse(document.getElementById('data').textContent);
const $ = (id) => document.getElementById(id);
const SVG = 'http://www.w3.org/2000/svg';

/** Returns a new element. Texts become text nodes, never markup. */
function el(name, attributes = {}, ...children) {
  const svg = ['svg', 'g', 'path', 'line', 'rect', 'text', 'circle', 'title'].includes(name);
  const made = svg ? document.createElementNS(SVG, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** Returns running sums: the page holds differences. */
function summed(steps, unit) {
  let sum = 0;
  return Float64Array.from(steps, (step) => (sum += step) * unit);
}

function ring(flat) {
  return { x: summed(flat[0], data.unit), y: summed(flat[1], data.unit) };
}

for (const body of data.bodies) {
  body.x = summed(body.x, data.unit);
  body.y = summed(body.y, data.unit);
  body.h = summed(body.h, 1);
  body.v = summed(body.v, 0.1);
  if (body.z) body.z = summed(body.z, data.unit);
}
const bodyOf = new Map(data.bodies.map((body) => [body.id, body]));
const named = data.bodies.filter((body) => body.role !== 'background');

/** Time of a sample; the last one stands at the end of the run. */
const timeOf = (index) => Math.min(index * data.step, data.end);

/** Returns place, heading in degrees, speed and height of a body; null while it is not there. */
function stateOf(body, time) {
  const place = time / data.step;
  let low = Math.min(Math.floor(place), data.count - 1);
  const high = Math.min(low + 1, data.count - 1);
  const span = timeOf(high) - timeOf(low);
  const share = span > 0 ? Math.min((time - timeOf(low)) / span, 1) : 0;
  if (!body.there.some(([from, to]) => low >= from && low <= to)) return null;
  const next = body.there.some(([from, to]) => high >= from && high <= to) ? share : 0;
  const mix = (values) => values[low] + (values[high] - values[low]) * next;
  return {
    x: mix(body.x), y: mix(body.y), h: mix(body.h), v: mix(body.v), z: body.z ? mix(body.z) : 0,
  };
}

function phaseOf(body, time) {
  let name = '';
  for (const [from, what] of body.phases || []) if (from <= time + 1e-9) name = what;
  return name;
}

const paper = document.documentElement.dataset;
const night = matchMedia('(prefers-color-scheme: dark)');

/** Returns the colour of a body, lighter in the dark. */
function hue(body) {
  if (!night.matches || paper.printing) return body.colour;
  const parts = [1, 3, 5].map((k) => parseInt(body.colour.slice(k, k + 2), 16));
  return `rgb(${parts.map((part) => Math.round(part + 0.42 * (255 - part))).join(', ')})`;
}

/** Returns a number with few digits, for people. */
function short(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  return size >= 100 ? value.toFixed(0) : size >= 10 ? value.toFixed(1) : value.toFixed(2);
}
