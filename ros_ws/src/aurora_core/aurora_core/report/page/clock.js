// The one clock of the page: whoever shows something of the run listens to it.
const clock = { time: 0, playing: false, speed: 1, listeners: [] };

function seek(time) {
  clock.time = Math.min(Math.max(time, 0), data.end);
  for (const listener of clock.listeners) listener(clock.time);
}

function play(playing) {
  if (playing && clock.time >= data.end) seek(0);
  clock.playing = playing;
  $('play').textContent = playing ? '❚❚' : '▶';
  $('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  let before = null;
  const frame = (now) => {
    if (!clock.playing) return;
    if (before !== null) seek(clock.time + ((now - before) / 1000) * clock.speed);
    before = now;
    if (clock.time >= data.end) play(false);
    else requestAnimationFrame(frame);
  };
  if (playing) requestAnimationFrame(frame);
}

function startClock() {
  const slider = $('scrub');
  slider.max = data.end;
  slider.step = 'any';
  $('play').addEventListener('click', () => play(!clock.playing));
  slider.addEventListener('input', () => seek(Number(slider.value)));
  $('speed').addEventListener('change', () => { clock.speed = Number($('speed').value); });
  clock.listeners.push((time) => {
    slider.value = time;
    const text = `${time.toFixed(1)} s of ${data.end.toFixed(1)} s`;
    slider.setAttribute('aria-valuetext', text);
    $('time').textContent = `${time.toFixed(1)} / ${data.end.toFixed(1)} s`;
  });
  for (const moment of data.moments) {
    if (moment.t === null) continue;
    const mark = el('span', { class: `tick ${moment.tone}`, title: moment.text });
    // The knob of a slider is about 16 pixels wide and stays inside it.
    const share = moment.t / (data.end || 1);
    mark.style.left = `calc(${100 * share}% + ${8 - 16 * share}px)`;
    slider.parentElement.append(mark);
  }
  document.addEventListener('keydown', onKey);
  document.addEventListener('click', (event) => {
    const button = event.target.closest('[data-seek]');
    if (!button) return;
    play(false);
    seek(Number(button.dataset.seek));
    if (button.classList.contains('seek')) $('run').scrollIntoView({ block: 'start' });
  });
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const on = event.target;
  if (['SELECT', 'TEXTAREA'].includes(on.tagName)) return;
  const step = event.shiftKey ? data.step : 1;
  const moments = data.moments.map((moment) => moment.t).filter((t) => t !== null);
  const does = {
    ' ': on.tagName === 'BUTTON' || on.tagName === 'SUMMARY'
      ? null : () => play(!clock.playing),
    ArrowLeft: () => seek(clock.time - step),
    ArrowRight: () => seek(clock.time + step),
    '[': () => seek(Math.max(0, ...moments.filter((t) => t < clock.time - 0.05))),
    ']': () => seek(Math.min(data.end, ...moments.filter((t) => t > clock.time + 0.05))),
    '-': () => faster(-1),
    '+': () => faster(1),
  }[event.key];
  if (!does) return;
  event.preventDefault();
  does();
}

function faster(by) {
  const choice = $('speed');
  const index = Math.min(Math.max(choice.selectedIndex + by, 0), choice.options.length - 1);
  choice.selectedIndex = index;
  clock.speed = Number(choice.value);
}
