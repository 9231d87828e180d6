// Margins over time: one chart per condition, its playhead on the clock of the page.
const CHART = { height: 112, left: 46, right: 74, top: 8, bottom: 18 };

/** Returns a few round numbers between two others. */
function rounds(low, high, count) {
  const rough = (high - low) / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough);
  const found = [];
  for (let at = Math.ceil(low / step) * step; at <= high + 1e-9; at += step) {
    found.push(Number(at.toPrecision(6)));
  }
  return found;
}

/** Returns scales and paper of a chart: the whole run across, values up. */
function paperOf(box, low, high, unit) {
  const width = Math.max(box.clientWidth, 260);
  const { left, right, top, bottom, height } = CHART;
  const x = (t) => left + (t / (data.end || 1)) * (width - left - right);
  const y = (v) => {
    const shown = Math.min(Math.max(v, low), high);
    return height - bottom - ((shown - low) / (high - low)) * (height - top - bottom);
  };
  const svg = el('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img' });
  for (const v of rounds(low, high, 3)) {
    svg.append(el('line', { class: 'axis', x1: left, x2: width - right, y1: y(v), y2: y(v) }));
    svg.append(el('text', { x: left - 5, y: y(v) + 4, 'text-anchor': 'end' }, String(v)));
  }
  for (const t of rounds(0, data.end, width > 600 ? 8 : 4)) {
    svg.append(el('text', { x: x(t), y: height - 3, 'text-anchor': 'middle' }, String(t)));
  }
  svg.append(el('text', { x: width - right + 14, y: height - 3 }, 's'));
  if (unit) svg.append(el('text', { x: width - right + 4, y: top + 4 }, unit));
  svg.addEventListener('click', (event) => {
    const share = (event.clientX - svg.getBoundingClientRect().left) / svg.clientWidth;
    seek(((share * width - left) / (width - left - right)) * data.end);
  });
  return { svg, x, y, width };
}

function pathOf(times, values, x, y) {
  let path = '';
  let broken = true;
  times.forEach((t, k) => {
    if (values[k] === null) { broken = true; return; }
    path += `${broken ? 'M' : 'L'}${x(t).toFixed(1)} ${y(values[k]).toFixed(1)}`;
    broken = false;
  });
  return path;
}

/** Returns the name of a signal in words: `hover_drift(uav1)` is the hover drift of uav1. */
const inWords = (signal) => signal.replace(/^(\w+)\((.*)\)$/, (all, quantity, of) => (
  `${quantity.replaceAll('_', ' ')} of ${of.replaceAll(',', ', ')}`));
const isShare = (course) => Boolean(course.held);
const asText = (course, v) => (isShare(course)
  ? `${(100 * v).toFixed(0)} %` : `${short(v)}${course.unit ? ` ${course.unit}` : ''}`);

/** Returns the index of the last sample up to a time, -1 for none. */
function indexAt(times, time) {
  let [low, high] = [-1, times.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (times[middle] <= time + 1e-9) low = middle;
    else high = middle - 1;
  }
  return low;
}

function limitsOf(course) {
  if (course.op === '==') {
    return [course.threshold - course.tolerance, course.threshold + course.tolerance];
  }
  return [course.threshold];
}

/** Returns what a chart shows: all, but for values so far off that the rest would be a line. */
function rangeOf(values, limits) {
  const off = (v) => Math.min(...limits.map((limit) => Math.abs(v - limit)));
  const usual = values.map(off).sort((a, b) => a - b)[Math.floor(values.length / 2)];
  const reach = usual > 0 ? 10 * usual : Infinity;
  const shown = values.filter((v) => off(v) <= reach);
  return [Math.min(...shown, ...limits), Math.max(...shown, ...limits)];
}

function drawChart(box, id) {
  const course = data.courses[id];
  const values = course.v.filter((v) => v !== null);
  const limits = limitsOf(course);
  let [low, high] = rangeOf(values, limits);
  const room = 0.08 * (high - low) || Math.abs(high) * 0.1 || 1;
  [low, high] = [low - room, high + room];
  if (isShare(course)) [low, high] = [-0.12, 1.06];
  const { svg, x, y, width } = paperOf(box, low, high, isShare(course) ? '' : course.unit);
  svg.setAttribute('aria-label', `${inWords(course.signal)} over time with its limit`);
  const right = width - CHART.right;
  if (course.op === '==' && course.tolerance > 0) {
    svg.append(el('rect', { class: 'band', x: CHART.left, width: right - CHART.left,
      y: y(limits[1]), height: y(limits[0]) - y(limits[1]) }));
  }
  shaded(svg, course, x);
  if (isShare(course)) {
    const bar = (from, to, name) => svg.append(el('rect', { class: name, x: x(from),
      width: Math.max(x(to) - x(from), 1), y: y(-0.02), height: 5 }));
    bar(course.t[0], course.t[course.t.length - 1], 'unheld');
    for (const [from, to] of course.held) bar(from, to, 'held');
  }
  svg.append(el('path', { class: 'signal', d: pathOf(course.t, course.v, x, y) }));
  limits.forEach((limit, k) => {
    svg.append(el('line', { class: 'limit', x1: CHART.left, x2: right,
      y1: y(limit), y2: y(limit) }));
    if (k && Math.abs(y(limits[0]) - y(limit)) < 12) return;
    const sign = course.op === '==' ? '' : `${{ '<=': '≤', '>=': '≥' }[course.op] ?? course.op} `;
    svg.append(el('text', { class: 'limit-text', x: right + 4, y: y(limit) + 4 },
      sign + asText(course, limit)));
  });
  const worst = data.conditions[id]?.at;
  if (worst !== null && worst !== undefined) {
    svg.append(el('line', { class: 'worst', x1: x(worst), x2: x(worst), y1: CHART.top,
      y2: CHART.height - CHART.bottom }, el('title', {}, 'the sample that decides')));
  }
  return withHead(svg, x, y, (time) => {
    const at = indexAt(course.t, time);
    if (at < 0 || (at === course.t.length - 1 && time > course.t[at] + 1)) return null;
    return { v: course.v[at], m: course.m[at] };
  });
}

/** Shades where the margin is below zero. */
function shaded(svg, course, x) {
  if (isShare(course)) return;
  let from = null;
  course.t.forEach((t, k) => {
    const below = course.m[k] !== null && course.m[k] < 0;
    if (below && from === null) from = t;
    if (from !== null && (!below || k === course.t.length - 1)) {
      svg.append(el('rect', { class: 'violated', x: x(from), y: CHART.top,
        width: Math.max(x(t) - x(from), 1.5), height: CHART.height - CHART.top - CHART.bottom }));
      from = null;
    }
  });
}

function withHead(svg, x, y, valueAt) {
  const head = el('line', { class: 'head', y1: CHART.top, y2: CHART.height - CHART.bottom });
  const dot = el('circle', { class: 'dot', r: 3.5 });
  svg.append(head, dot);
  const move = (time) => {
    head.setAttribute('x1', x(time));
    head.setAttribute('x2', x(time));
    const now = valueAt(time);
    dot.toggleAttribute('hidden', !now || now.v === null);
    if (now && now.v !== null) {
      dot.setAttribute('cx', x(time));
      dot.setAttribute('cy', y(now.v));
    }
    return now;
  };
  return { svg, move };
}

function startMargins() {
  for (const box of document.querySelectorAll('[data-chart]')) {
    const id = box.dataset.chart;
    const course = data.courses[id];
    if (!course) continue;
    const says = el('p');
    let chart = null;
    let width = 0;
    const update = (time) => {
      if (!chart || !box.offsetParent) return;
      const now = chart.move(time);
      says.textContent = now && now.v !== null
        ? `${isShare(course) ? 'share so far' : inWords(course.signal)} at ${time.toFixed(1)} s: `
          + `${asText(course, now.v)}, margin ${now.m >= 0 ? '+' : '−'}`
          + `${asText(course, Math.abs(now.m))}`
        : `not judged at ${time.toFixed(1)} s`;
      says.classList.toggle('lost', Boolean(now) && now.m < 0 && !isShare(course));
    };
    const redraw = () => {
      if (!box.clientWidth || box.clientWidth === width) return;
      width = box.clientWidth;
      chart = drawChart(box, id);
      box.replaceChildren(chart.svg, says);
      update(clock.time);
    };
    new ResizeObserver(redraw).observe(box);
    clock.listeners.push(update);
    redraw();
  }
}

/** Draws how high every UAV flies, under the map. */
function startAltitudes() {
  const box = $('altitudes');
  const flying = data.bodies.filter((body) => body.z);
  if (!flying.length) { box.hidden = true; return; }
  let chart = null;
  let width = 0;
  const times = Array.from({ length: data.count }, (_, k) => timeOf(k));
  const redraw = () => {
    if (!box.clientWidth || box.clientWidth === width) return;
    width = box.clientWidth;
    const top = Math.max(5, ...flying.map((body) => Math.max(...body.z)));
    const sheet = paperOf(box, 0, top * 1.12, 'm up');
    for (const body of flying) {
      const line = el('path', { class: 'signal', d: pathOf(times, [...body.z], sheet.x, sheet.y) });
      line.style.stroke = hue(body);
      sheet.svg.append(line);
    }
    sheet.svg.setAttribute('aria-label', 'Height of each UAV over time');
    chart = withHead(sheet.svg, sheet.x, sheet.y, (time) => {
      const state = stateOf(flying[0], time);
      return state && { v: state.z };
    });
    box.replaceChildren(chart.svg);
    chart.move(clock.time);
  };
  new ResizeObserver(redraw).observe(box);
  night.addEventListener('change', () => { width = 0; redraw(); });
  clock.listeners.push((time) => chart && chart.move(time));
  redraw();
}
