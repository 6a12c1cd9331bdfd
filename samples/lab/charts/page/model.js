// SPDX-License-Identifier: MIT
// The results, what of them is shown, and which points are on a Pareto front.
'use strict';

const results = JSON.parse(document.getElementById('results').textContent);

// All are better where they are smaller.
const measures = [
  {name: 'relative RMSE', of: m => m.relative_rmse,
    note: 'root of the mean squared error, over the mean of the truth'},
  {name: 'relMSE', of: m => m.rel_mse, note: 'mean of squared error over squared truth'},
  {name: 'SMAPE', of: m => m.smape, note: 'mean of 2 |t − r| / (|t| + |r|), 0 to 2'},
  {name: 'FLIP', of: m => m.flip, note: 'how different the tone-mapped pictures look, 0 to 1'},
  {name: '1 − SSIM', of: m => 1 - m.ssim, note: 'loss of structural similarity of the tone-mapped luminance'},
  {name: '|bias|', of: m => Math.abs(m.bias) / m.truth_mean,
    note: 'how far the mean is off, over the mean of the truth'},
  {name: '95th percentile', of: m => m.percentile_95 / m.truth_mean,
    note: 'the error that 5 % of the pixels exceed, over the mean of the truth'},
];

// Okabe and Ito, Color Universal Design, and the same hues for a dark page.
const palettes = {
  light: ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b87f00', '#56b4e9', '#6f6f6f'],
  dark: ['#4ea8e6', '#f08a45', '#2fc79a', '#e39ac6', '#f0b53a', '#a5d8f5', '#b4b4b4'],
};
const isDark = matchMedia('(prefers-color-scheme: dark)');
const shapes = [
  {style: 'circle', rotation: 0}, {style: 'rect', rotation: 0}, {style: 'triangle', rotation: 0},
  {style: 'rectRot', rotation: 0}, {style: 'triangle', rotation: 180}, {style: 'star', rotation: 0},
  {style: 'crossRot', rotation: 0}, {style: 'triangle', rotation: 90},
];

const distinct = values => [...new Set(values)];

const points = results.points.map((point, index) => ({
  ...point,
  index,
  group: `${point.backend} (${point.peer ? point.machine : point.device})`,
}));
const views = results.views.map(view => view.view);
const groups = distinct(points.map(point => point.group));
const techniques = distinct(points.map(point => point.technique));

const state = {
  views: new Set(views),
  groups: new Set(groups),
  techniques: new Set(techniques),
  measure: measures[0],
  frontOnly: false,
  selected: null, // a point
  sort: {column: 0, ascending: true},
};

function colourOf(group) {
  const palette = isDark.matches ? palettes.dark : palettes.light;
  return palette[groups.indexOf(group) % palette.length];
}
const shapeOf = view => shapes[views.indexOf(view) % shapes.length];
const viewOf = point => results.views.find(view => view.view === point.view);
const errorOf = point => state.measure.of(point.metrics);
const isDrawable = point => Number.isFinite(errorOf(point)) && errorOf(point) > 0;

function passes(point) {
  return state.views.has(point.view) && state.groups.has(point.group) && state.techniques.has(point.technique);
}

// The points of one view and group that no other beats, from the fastest.
function frontOf(candidates) {
  const front = [];
  const sorted = candidates.filter(isDrawable)
    .sort((a, b) => a.time_ms.median - b.time_ms.median || errorOf(a) - errorOf(b));
  for (const point of sorted) {
    const last = front.at(-1);
    const isEqual = last && errorOf(point) === errorOf(last) && point.time_ms.median === last.time_ms.median;
    if (!last || errorOf(point) < errorOf(last) || isEqual)
      front.push(point);
  }
  return front;
}

function frontsShown() {
  const filtered = points.filter(passes);
  return views.flatMap(view => groups.map(group => ({
    view, group, points: frontOf(filtered.filter(p => p.view === view && p.group === group)),
  }))).filter(front => front.points.length > 0);
}

// Points that pass the filters; those that a logarithmic axis has no place for are counted.
function shown() {
  const fronts = frontsShown();
  const onFront = new Set(fronts.flatMap(front => front.points));
  const passing = points.filter(passes);
  const visible = passing.filter(point => isDrawable(point) && (!state.frontOnly || onFront.has(point)));
  return {visible, fronts, onFront, undrawable: passing.filter(point => !isDrawable(point)).length};
}

// As people read them: three significant digits.
function figure(value) {
  if (!Number.isFinite(value))
    return '–';
  return Math.abs(value) >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(3)));
}
