// The scenario graph: a condition lights up what it depends on, a node what depends on it.
const lit = { edges: data.graph.edges || [], conditions: data.graph.conditions || {} };

/** Returns every node from which one can get to the given ones. */
function upstream(nodes) {
  const found = new Set(nodes);
  const open = [...nodes];
  while (open.length) {
    const at = open.pop();
    for (const [source, target] of lit.edges) {
      if (target === at && !found.has(source)) {
        found.add(source);
        open.push(source);
      }
    }
  }
  return found;
}

function light(nodes, failed) {
  const sheet = $('paper');
  sheet.classList.toggle('lighting', nodes.size > 0);
  sheet.classList.toggle('failed', failed);
  for (const node of sheet.querySelectorAll('.node')) {
    node.classList.toggle('lit', nodes.has(node.dataset.node));
  }
  for (const edge of sheet.querySelectorAll('.edge, .edge-label')) {
    const { source, target } = edge.dataset;
    edge.classList.toggle('lit', nodes.has(source) && nodes.has(target));
  }
}

function pressed(button) {
  for (const other of document.querySelectorAll('.chips button')) {
    other.setAttribute('aria-pressed', String(other === button));
    other.classList.remove('touched');
  }
}

function showCondition(id) {
  const button = [...document.querySelectorAll('.chips button')]
    .find((one) => one.dataset.condition === id);
  const known = lit.conditions[id];
  if (!button || !known) return;
  if (button.getAttribute('aria-pressed') === 'true') { showNothing(); return; }
  pressed(button);
  const near = upstream(known.of);
  light(near, data.conditions[id] ? !data.conditions[id].ok : false);
  const list = el('ul');
  for (const text of known.parameters) list.append(el('li', {}, el('code', {}, text)));
  if (known.more) list.append(el('li', {}, `and ${known.more} more`));
  $('depends').replaceChildren(
    el('p', {}, el('strong', {}, button.title), ' – judged on ',
      known.of.join(', ') || 'nothing of the scene', '.'),
    known.parameters.length
      ? el('p', {}, 'Values that can affect it, the nearest first:') : '', list);
}

function showNode(name) {
  pressed(null);
  light(new Set([name]), false);
  const touched = [...document.querySelectorAll('.chips button')].filter((button) => (
    upstream(lit.conditions[button.dataset.condition]?.of ?? []).has(name)));
  for (const button of touched) button.classList.add('touched');
  $('depends').replaceChildren(
    el('p', {}, el('strong', {}, name), `: ${touched.length} conditions depend on it.`));
}

function showNothing() {
  pressed(null);
  light(new Set(), false);
  $('depends').replaceChildren();
}

function startGraph() {
  if (!$('paper')) return;
  for (const button of document.querySelectorAll('.chips button')) {
    button.addEventListener('click', () => showCondition(button.dataset.condition));
  }
  for (const node of document.querySelectorAll('.node')) {
    node.addEventListener('click', () => showNode(node.dataset.node));
    node.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      event.stopPropagation();
      showNode(node.dataset.node);
    });
  }
  for (const link of document.querySelectorAll('[data-depends]')) {
    link.addEventListener('click', () => {
      showNothing();
      showCondition(link.dataset.depends);
      $('graph').scrollIntoView({ block: 'start' });
    });
  }
  const failed = document.querySelector('.chips .fails');
  if (failed) showCondition(failed.dataset.condition);
}
