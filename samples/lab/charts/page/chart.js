// SPDX-License-Identifier: MIT
// The drawing: Chart.js, with bars for the spread of times and ticks for short logarithmic axes.
'use strict';

const styleOf = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function tickValues(low, high) {
  let steps = [1, 2, 5];
  if (high / low < 40)
    steps = [1, 1.5, 2, 3, 4, 5, 7];
  if (high / low < 3)
    steps = [1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2, 2.2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.ceil(Math.log10(high)); ++decade)
    for (const step of steps) {
      const value = Number((step * 10 ** decade).toPrecision(6));
      if (value >= low && value <= high)
        ticks.push({value});
    }
  return ticks;
}

function axis(title, values) {
  const margin = 1.08;
  const low = Math.min(...values) / margin, high = Math.max(...values) * margin;
  return {
    type: 'logarithmic',
    min: Number.isFinite(low) ? low : 1,
    max: Number.isFinite(low) ? high : 10,
    title: {display: true, text: title, color: styleOf('--text'), font: {size: 13}},
    grid: {color: styleOf('--rule'), borderColor: styleOf('--muted')},
    ticks: {color: styleOf('--muted'), callback: value => figure(value), autoSkip: true, maxRotation: 0},
    afterBuildTicks: scale => { scale.ticks = tickValues(scale.min, scale.max); },
  };
}

const spreadOfTimes = {
  id: 'spreadOfTimes',
  beforeDatasetsDraw(chart) {
    const {ctx, chartArea: area, scales: {x, y}} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(area.left, area.top, area.width, area.height);
    ctx.clip();
    for (const dataset of chart.data.datasets.filter(d => d.isPoints)) {
      ctx.strokeStyle = dataset.borderColor;
      ctx.globalAlpha = 0.55;
      ctx.lineWidth = 1.25;
      for (const {y: error, point} of dataset.data) {
        const row = y.getPixelForValue(error);
        const from = x.getPixelForValue(point.time_ms.p10), to = x.getPixelForValue(point.time_ms.p90);
        ctx.beginPath();
        ctx.moveTo(from, row);
        ctx.lineTo(to, row);
        for (const end of [from, to]) {
          ctx.moveTo(end, row - 3);
          ctx.lineTo(end, row + 3);
        }
        ctx.stroke();
      }
    }
    ctx.restore();
  },
};

const ring = {
  id: 'ring',
  afterDatasetsDraw(chart) {
    const found = elementOf(chart, state.selected);
    if (!found)
      return;
    const {ctx} = chart;
    ctx.save();
    ctx.strokeStyle = styleOf('--text');
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.arc(found.x, found.y, 10, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.restore();
  },
};

// Where a point is drawn, if it is.
function elementOf(chart, point) {
  for (const [d, dataset] of chart.data.datasets.entries()) {
    const i = dataset.isPoints ? dataset.data.findIndex(entry => entry.point === point) : -1;
    if (i >= 0)
      return chart.getDatasetMeta(d).data[i];
  }
  return null;
}

function datasetsOf({visible, fronts}) {
  const place = point => ({x: point.time_ms.median, y: errorOf(point), point});
  const lines = fronts.map(front => ({
    type: 'line', data: front.points.map(place), stepped: 'before', borderColor: colourOf(front.group),
    borderWidth: 1.5, pointRadius: 0, pointHitRadius: 0, order: 2,
  }));
  const sets = views.flatMap(view => groups.map(group => ({
    isPoints: true, data: visible.filter(p => p.view === view && p.group === group).map(place),
    pointStyle: shapeOf(view).style, pointRotation: shapeOf(view).rotation,
    backgroundColor: colourOf(group), borderColor: colourOf(group), pointBorderWidth: 1.5, pointRadius: 5, pointHoverRadius: 7, order: 1,
  })));
  return [...sets.filter(set => set.data.length > 0), ...lines];
}

function tooltipOf(point) {
  const {median, p10, p90} = point.time_ms;
  return [`${point.view}, ${point.group}`, `${figure(median)} ms (${figure(p10)} to ${figure(p90)})`,
    `${state.measure.name} ${figure(errorOf(point))}`];
}

let drawing = null;

// onPoint(point, isClick): called with null where there is no point below the pointer.
function drawChart(canvas, content, onPoint) {
  const pointAt = elements => {
    const hit = elements.find(e => drawing.data.datasets[e.datasetIndex].isPoints);
    return hit ? drawing.data.datasets[hit.datasetIndex].data[hit.index].point : null;
  };
  drawing?.destroy();
  drawing = new Chart(canvas, {
    type: 'scatter',
    data: {datasets: datasetsOf(content)},
    plugins: [spreadOfTimes, ring],
    options: {
      animation: false,
      maintainAspectRatio: false,
      interaction: {mode: 'nearest', intersect: true},
      onHover: (event, elements) => onPoint(pointAt(elements), false),
      onClick: (event, elements) => onPoint(pointAt(elements), true),
      scales: {
        x: axis('median time of a frame [ms]; bars: 10th to 90th percentile',
          content.visible.flatMap(p => [p.time_ms.p10, p.time_ms.p90])),
        y: axis(state.measure.name, content.visible.map(errorOf)),
      },
      plugins: {
        legend: {display: false},
        tooltip: {
          filter: item => item.dataset.isPoints === true,
          displayColors: false,
          callbacks: {title: items => items.map(i => i.raw.point.name)[0] ?? '', label: i => tooltipOf(i.raw.point)},
        },
      },
    },
  });
}
