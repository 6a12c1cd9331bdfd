// SPDX-License-Identifier: MIT
// Uses the page as a person would, and leaves what it saw in the element "report".
'use strict';

// Longer than a frame, in which Chart.js takes events up.
const pause = () => new Promise(done => setTimeout(done, 200));

const countOf = () => Number(byId('shown').textContent.split(' ')[0]);
const drawn = () => drawing.data.datasets.filter(set => set.isPoints).reduce((sum, set) => sum + set.data.length, 0);
const rows = () => [...byId('table').tBodies[0].rows];
const counts = () => [countOf(), drawn(), rows().length];

const boxOf = (filters, name) => [...byId(filters).querySelectorAll('input')].find(input => input.value === name);

function withClicked(box) {
  box.click();
  const seen = counts();
  box.click();
  return seen;
}

async function clickOn(point) {
  const canvas = byId('chart'), at = elementOf(drawing, point), frame = canvas.getBoundingClientRect();
  const place = {clientX: frame.left + at.x, clientY: frame.top + at.y, bubbles: true};
  canvas.dispatchEvent(new MouseEvent('mousemove', place));
  await pause();
  canvas.dispatchEvent(new MouseEvent('click', place));
  await pause();
}

async function panel() {
  const pictures = [...byId('panel').querySelectorAll('img')];
  await Promise.all(pictures.map(image => image.complete || new Promise(done => { image.onload = done; })));
  return {
    title: byId('panel').querySelector('h2')?.textContent ?? '',
    text: byId('panel').textContent,
    widths: pictures.map(image => image.naturalWidth),
    captions: pictures.map(image => image.alt),
  };
}

async function drive() {
  const report = {all: counts(), panelAtFirst: await panel()};
  report.withoutAtrium = withClicked(boxOf('view-filters', 'atrium nave'));
  report.withoutCpu = withClicked(boxOf('group-filters', 'cpu (avx2 on 2 threads)'));
  report.withoutTechnique = withClicked(boxOf('technique-filters', 'screen_indirect'));
  report.frontOnly = withClicked(byId('front-only'));
  byId('view-filters').querySelector('.only').click();
  report.onlyAtrium = counts();
  boxOf('view-filters', 'cornell front').click();
  report.allAgain = counts();

  await clickOn(points[2]);
  report.clicked = await panel();
  report.selectedRows = rows().filter(row => row.classList.contains('selected')).map(row => Number(row.dataset.point));
  byId('chart').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true}));
  report.afterArrow = await panel();
  rows()[0].querySelector('button').click();
  report.fromTable = await panel();

  byId('measure').value = '3';
  byId('measure').dispatchEvent(new Event('change'));
  report.axis = drawing.options.scales.y.title.text;
  report.heights = drawing.data.datasets.filter(set => set.isPoints).flatMap(set => set.data.map(entry => entry.y));
  byId('table').querySelectorAll('thead button')[4].click();
  report.ascending = rows().map(row => Number(row.dataset.point)).map(index => points[index].time_ms.median);
  byId('table').querySelectorAll('thead button')[4].click();
  report.descending = rows().map(row => Number(row.dataset.point)).map(index => points[index].time_ms.median);
  report.alerts = window.alerts;
  report.failures = window.failures;
  return report;
}

drive().catch(failure => ({failures: [String(failure.stack)]})).then(report => {
  const element = document.createElement('pre');
  element.id = 'report';
  element.textContent = btoa(JSON.stringify(report).replace(/[^\x20-\x7e]/g, '?'));
  document.body.append(element);
});
