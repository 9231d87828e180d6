// What happened and who is how fast, beside the map; then everything is started.
function startPanel() {
  const rows = [...document.querySelectorAll('.happened button')];
  clock.listeners.push((time) => {
    const times = data.moments.map((moment) => moment.t);
    const last = times.reduce((found, t, k) => (t !== null && t <= time + 0.05 ? k : found), -1);
    rows.forEach((row, k) => {
      const begun = times[k] === null || times[k] <= time + 0.05;
      row.classList.toggle('now', k === last);
      row.classList.toggle('over', begun);
      row.classList.toggle('ahead', !begun);
      if (k !== last || !clock.playing) return;
      const list = row.closest('ol');
      const item = row.parentElement;
      if (item.offsetTop + item.offsetHeight > list.scrollTop + list.clientHeight
        || item.offsetTop < list.scrollTop) list.scrollTop = item.offsetTop - 40;
    });
  });
  const body = $('bodies');
  const cells = named.map((one) => {
    const swatch = el('span', { class: 'swatch' });
    const paint = () => { swatch.style.background = hue(one); };
    paint();
    night.addEventListener('change', paint);
    const made = { speed: el('td', { class: 'num' }), state: el('td') };
    body.append(el('tr', {}, el('td', {}, swatch, one.id), el('td', {}, one.type),
      made.speed, made.state));
    return made;
  });
  clock.listeners.push((time) => {
    named.forEach((one, k) => {
      const state = stateOf(one, time);
      cells[k].speed.textContent = state ? `${state.v.toFixed(1)} m/s` : '';
      const flies = one.kind === 'uav' && state;
      cells[k].state.textContent = state
        ? (flies ? `${phaseOf(one, time)}, ${state.z.toFixed(1)} m` : '') : 'not there';
    });
  });
}

function startPrint() {
  let opened = [];
  window.addEventListener('beforeprint', () => {
    play(false);
    paper.printing = 'yes';
    readColours();
    draw();
    opened = [...document.querySelectorAll('details:not([open])')]
      .filter((one) => one.closest('.fails') || one.classList.contains('picture'));
    for (const one of opened) one.open = true;
  });
  window.addEventListener('afterprint', () => {
    for (const one of opened) one.open = false;
    delete paper.printing;
    readColours();
    draw();
  });
}

for (const one of document.querySelectorAll('[data-needs-script]')) one.hidden = false;
startClock();
startMap();
startPanel();
startAltitudes();
startMargins();
startGraph();
startPrint();
// A run that failed opens where it failed, any other at its beginning.
const decided = Object.values(data.conditions).filter((one) => !one.ok && one.at !== null);
seek(decided.length ? Math.min(...decided.map((one) => one.at)) : 0);
