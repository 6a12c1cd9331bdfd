// SPDX-License-Identifier: MIT
// Filters, the panel of the selected point, and the table.
'use strict';

const byId = id => document.getElementById(id);

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== false)
      made.setAttribute(key, value === true ? '' : value);
  made.append(...children);
  return made;
}

// A view's shape or a backend's colour, as the chart has it.
function mark({style, rotation}, colour) {
  const canvas = element('canvas', {class: 'mark', width: 32, height: 32, 'aria-hidden': 'true'});
  const ctx = canvas.getContext('2d');
  ctx.strokeStyle = ctx.fillStyle = colour;
  ctx.lineWidth = 3;
  Chart.helpers.drawPoint(ctx, {pointStyle: style, radius: 10, borderWidth: 3, rotation}, 16, 16);
  return canvas;
}

// Anew where colours change.
function showFilters() {
  addFilters(byId('view-filters'), views, state.views, view => mark(shapeOf(view), styleOf('--muted')));
  addFilters(byId('group-filters'), groups, state.groups, group => mark(shapes[0], colourOf(group)));
  addFilters(byId('technique-filters'), techniques, state.techniques, null);
}

function addFilters(box, names, chosen, markOf) {
  box.replaceChildren();
  for (const name of names) {
    const input = element('input', {type: 'checkbox', value: name, checked: chosen.has(name)});
    input.addEventListener('change', () => {
      input.checked ? chosen.add(name) : chosen.delete(name);
      update();
    });
    const only = element('button', {type: 'button', class: 'only', 'aria-label': `only ${name}`}, 'only');
    only.addEventListener('click', () => {
      chosen.clear();
      chosen.add(name);
      for (const other of box.querySelectorAll('input'))
        other.checked = other === input;
      update();
    });
    const label = element('label', {class: 'choice'}, input, ...(markOf ? [markOf(name)] : []),
      element('span', {}, name));
    box.append(element('div', {class: 'choice-row'}, label, ...(names.length > 1 ? [only] : [])));
  }
}

function picture(index, caption, kind) {
  const source = `data:image/png;base64,${results.pictures[index]}`;
  return element('figure', {}, element('img', {src: source, alt: caption, class: kind}),
    element('figcaption', {}, caption));
}

function definitions(pairs) {
  return element('dl', {}, ...pairs.flatMap(([term, value]) =>
    [element('dt', {}, term), element('dd', {}, String(value))]));
}

function figuresOf(point) {
  const m = point.metrics, t = point.time_ms;
  return [
    ['median', `${figure(t.median)} ms`],
    ['10th to 90th percentile', `${figure(t.p10)} to ${figure(t.p90)} ms`],
    ['minimum', `${figure(t.minimum)} ms${t.frames ? `, of ${t.frames} frames` : ''}`],
    ...measures.map(measure => [measure.name, figure(measure.of(m))]),
    ['SSIM', figure(m.ssim)],
    ['mean, truth’s mean', `${figure(m.mean)}, ${figure(m.truth_mean)}`],
    ['pixels compared', m.pixels],
    ...(m.not_finite > 0 ? [['pixels left out, not finite', m.not_finite]] : []),
  ];
}

function showPanel(point) {
  const panel = byId('panel');
  if (!point) {
    panel.replaceChildren(element('p', {class: 'note'},
      'Choose a point: with the pointer, with the arrow keys while the chart has the focus, or in the table.'));
    return;
  }
  const view = viewOf(point);
  const settings = Object.entries(point.settings).filter(([, value]) => value !== null)
    .map(([key, value]) => [key.replaceAll('_', ' '), typeof value === 'object' ? JSON.stringify(value) : figureOrText(value)]);
  panel.replaceChildren(
    element('h2', {}, point.name),
    element('p', {class: 'note'}, `${point.view}, ${point.technique} on ${point.group}`),
    element('div', {class: 'pictures'},
      picture(point.picture_index, 'this setting', 'result'),
      picture(view.picture_index, 'truth', 'truth'),
      picture(point.error_index, `error, to ${figure(view.error_scale)} W m⁻² sr⁻¹`, 'error')),
    definitions(figuresOf(point)),
    element('h3', {}, 'Settings'),
    definitions(settings));
}

const figureOrText = value => typeof value === 'number' ? figure(value) : value;

const columns = [
  {title: 'view', of: p => p.view},
  {title: 'setting', of: p => p.name},
  {title: 'backend', of: p => p.backend},
  {title: 'technique', of: p => p.technique},
  {title: 'median [ms]', of: p => p.time_ms.median},
  {title: '10 % [ms]', of: p => p.time_ms.p10},
  {title: '90 % [ms]', of: p => p.time_ms.p90},
  ...measures.map(measure => ({title: measure.name, of: p => measure.of(p.metrics)})),
  {title: 'on front', of: (p, onFront) => onFront.has(p) ? 'yes' : ''},
];

function sorted(visible, onFront) {
  const {of} = columns[state.sort.column];
  const direction = state.sort.ascending ? 1 : -1;
  return [...visible].sort((a, b) => {
    const p = of(a, onFront), q = of(b, onFront);
    const order = typeof p === 'number' ? p - q : p.localeCompare(q, 'en', {numeric: true});
    return direction * order || a.index - b.index;
  });
}

function showHead() {
  const cells = columns.map((column, index) => {
    const isSorted = state.sort.column === index;
    const button = element('button', {type: 'button'}, column.title);
    button.addEventListener('click', () => {
      state.sort = {column: index, ascending: isSorted ? !state.sort.ascending : true};
      update();
      byId('table').querySelectorAll('thead button')[index].focus();
    });
    return element('th', {scope: 'col', 'aria-sort': isSorted ? (state.sort.ascending ? 'ascending' : 'descending') : 'none'},
      button);
  });
  byId('table').tHead.replaceChildren(element('tr', {}, ...cells));
}

function rowOf(point, onFront) {
  const cells = columns.map((column, index) => {
    const value = column.of(point, onFront);
    if (typeof value === 'number')
      return element('td', {class: 'number'}, figure(value));
    if (index !== 1)
      return element('td', {}, value);
    const button = element('button', {type: 'button'}, value);
    button.addEventListener('click', () => select(point));
    return element('td', {}, button);
  });
  const row = element('tr', {'data-point': point.index}, ...cells);
  row.addEventListener('click', () => select(point));
  return row;
}

function showTable({visible, onFront}) {
  showHead();
  byId('table').tBodies[0].replaceChildren(...sorted(visible, onFront).map(point => rowOf(point, onFront)));
  markRow();
}

function markRow() {
  for (const row of byId('table').tBodies[0].rows)
    row.classList.toggle('selected', state.selected !== null && Number(row.dataset.point) === state.selected.index);
}

function select(point) {
  state.selected = point;
  showPanel(point);
  markRow();
  drawing.draw();
}

let content = shown();

function update() {
  content = shown();
  if (state.selected && !content.visible.includes(state.selected))
    state.selected = null;
  byId('measure-note').textContent = `${state.measure.note}; smaller is better`;
  drawChart(byId('chart'), content, (point, isClick) => {
    byId('chart').style.cursor = point ? 'pointer' : 'default';
    if (point && isClick)
      select(point);
    else
      showPanel(point ?? state.selected);
  });
  const left = content.undrawable ? `; ${content.undrawable} without a place on a logarithmic axis` : '';
  byId('shown').textContent = `${content.visible.length} of ${points.length} points${left}`;
  byId('chart').setAttribute('aria-label', `${content.visible.length} points, ${state.measure.name} against time; arrow keys go from one to the next`);
  showPanel(state.selected);
  showTable(content);
}

function step(event) {
  const by = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
  if (!by || content.visible.length === 0)
    return;
  event.preventDefault();
  const order = [...content.visible].sort((a, b) => a.time_ms.median - b.time_ms.median || a.index - b.index);
  const at = state.selected ? order.indexOf(state.selected) + by : by > 0 ? 0 : order.length - 1;
  select(order[Math.min(Math.max(at, 0), order.length - 1)]);
}

function start() {
  const bounces = results.bounces === 1 ? 'light that met one other surface' :
    `light that met 1 to ${results.bounces} other surfaces`;
  byId('about').textContent = `Rebound ${results.version} on ${results.machine}; ${results.size.join(' × ')} pixels. ` +
    `The truth is ${bounces}, path traced.`;
  for (const [index, measure] of measures.entries())
    byId('measure').append(element('option', {value: index}, measure.name));
  byId('measure').addEventListener('change', event => {
    state.measure = measures[event.target.value];
    update();
  });
  byId('front-only').addEventListener('change', event => {
    state.frontOnly = event.target.checked;
    update();
  });
  showFilters();
  byId('chart').addEventListener('keydown', step);
  isDark.addEventListener('change', () => {
    showFilters();
    update();
  });
  update();
}

start();
