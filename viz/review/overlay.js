'use strict';

// What stands over the scene and beside it as text: names, axes, the scale bar, the colour bar.

function numberText(value, decimals) {
  return value.toFixed(decimals).replace(/^-(?=0(\.0*)?$)/, '').replace('-', '\u2212');
}

function element(name, text, properties = {}) {
  return Object.assign(document.createElement(name), {textContent: text}, properties);
}

// Names of views at their places; one that would cover an earlier one moves up.
function placeTexts(view, host) {
  host.replaceChildren();
  const taken = [];
  for (const label of view.scene.labels.filter((item) => view.isShown(item))) {
    let [x, y] = view.camera.toScreen(label.at);
    while (taken.some((at) => Math.abs(at[0] - x) < 26 && Math.abs(at[1] - y) < 19)) y -= 4;
    taken.push([x, y]);
    const span = element('span', label.text);
    Object.assign(span.style, {left: `${x}px`, top: `${y}px`, color: label.color});
    host.append(span);
  }
}

const kAxes = [['x', [1, 0, 0], '#b3261e'], ['y', [0, 1, 0], '#1b6b2f'], ['z', [0, 0, 1], '#2347b5']];

function svgElement(name, attributes, text = '') {
  const node = document.createElementNS(document.querySelector('#triad').namespaceURI, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.textContent = text;
  return node;
}

// The axes of the array frame, the one that points away first.
function drawTriad(camera, svg) {
  svg.replaceChildren();
  const ends = kAxes.map(([name, axis, color]) => ({
    name, color, x: dot(axis, camera.right), y: -dot(axis, camera.up),
    depth: dot(axis, camera.towards)
  }));
  for (const end of ends.sort((a, b) => a.depth - b.depth)) {
    const [x, y] = [30 * end.x, 30 * end.y];
    svg.append(svgElement('line', {x1: 0, y1: 0, x2: x, y2: y, stroke: end.color,
                                   'stroke-width': 3, 'stroke-linecap': 'round'}));
    const reach = Math.hypot(x, y);
    if (reach > 6)
      svg.append(svgElement('text', {x: x * (1 + 12 / reach), y: y * (1 + 12 / reach) + 5,
                                     fill: end.color}, end.name));
  }
}

// A bar of a round length, at most a quarter of the width.
function drawScaleBar(camera, host) {
  const most = camera.width * camera.mmPerPx / 4;
  const decade = 10 ** Math.floor(Math.log10(most));
  const length = decade * [5, 2, 1].find((step) => step * decade <= most);
  host.style.width = `${length / camera.mmPerPx}px`;
  host.firstElementChild.textContent = length < 0.1 ? `${numberText(1000 * length, 0)} \u00b5m` :
                                                      `${+length.toPrecision(1)} mm`;
}

function placeMarker(view, selection, host) {
  host.hidden = !(selection && selection.point !== null && view.isShown(selection.part));
  if (host.hidden) return;
  const [x, y] = view.camera.toScreen(pointOf(selection.part, selection.point));
  Object.assign(host.style, {left: `${x}px`, top: `${y}px`});
}

function nameWithUnit(quantity) {
  return quantity.unit ? `${quantity.name} / ${quantity.unit}` : quantity.name;
}

// The colour bar of a scale; the ends say when values lie beyond them.
function colorBarNode(scale, table) {
  const {low, high, ticks, decimals, clipped} = scale;
  const bar = element('div', '', {className: 'color-bar'});
  if (clipped) bar.title = 'Values beyond the ends have the colours of the ends.';
  const ramp = element('div', '', {className: 'ramp'});
  const stops = table.filter((_, i) => i % 15 === 0);
  ramp.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
  const row = element('div', '', {className: 'ticks'});
  ticks.forEach((tick, i) => {
    const beyond = {0: '\u2264\u00a0', [ticks.length - 1]: '\u2265\u00a0'}[i] ?? '';
    const span = element('span', (clipped ? beyond : '') + numberText(tick, decimals));
    span.style.left = `${100 * (tick - low) / (high - low)}%`;
    row.append(span);
  });
  bar.append(ramp, row);
  return bar;
}

// What the fixed colours of a layer mean.
function legendNodes(view) {
  return view.scene.legends.filter((legend) => view.layers.has(legend.layer))
      .flatMap((legend) => [element('h3', legend.name),
                            colorBarNode(legend.scale, legend.colors)]);
}
