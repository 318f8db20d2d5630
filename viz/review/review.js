'use strict';

// The page's controls. `review` is also what a test drives.

const byId = (id) => document.getElementById(id);
const kRadPerPx = 0.008;

class Review {
  constructor(scene) {
    this.scene = scene;
    this.selection = null;  // {part, point, others}: point is an index or null
    byId('viewer').hidden = false;
    this.view = new SceneView(byId('canvas'), scene);
    this.view.afterRender = () => this.drawOverlay();
    this.makeDirections();
    this.makeLayers();
    this.makeStates();
    this.makeQuantities();
    this.makePartList();
    listenToPointer(this);
    listenToKeys(this);
    this.choose(null);
    this.recolor();
    this.view.look(scene.directions[0]);
    this.view.render();
    addEventListener('beforeprint', () => this.view.render());
  }

  drawOverlay() {
    placeTexts(this.view, byId('texts'));
    drawTriad(this.view.camera, byId('triad'));
    drawScaleBar(this.view.camera, byId('scale-bar'));
    placeMarker(this.view, this.selection, byId('marker'));
  }

  makeDirections() {
    this.scene.directions.forEach((direction, index) => {
      const button = element('button', direction.name, {type: 'button', title: `Key ${index + 1}`});
      button.onclick = () => this.look(index);
      byId('directions').append(button);
    });
    const fit = element('button', 'Fit', {type: 'button', title: 'Key F'});
    fit.onclick = () => {
      this.view.fit();
      this.view.render();
    };
    byId('directions').append(fit);
  }

  look(index) {
    if (index >= this.scene.directions.length) return;
    this.view.look(this.scene.directions[index]);
    this.view.render();
  }

  makeLayers() {
    for (const layer of this.scene.layers) {
      const button = element('button', layer.name, {type: 'button'});
      button.dataset.layer = layer.key;
      button.setAttribute('aria-pressed', layer.shown);
      button.onclick = () => this.showLayer(layer.key, !this.view.layers.has(layer.key));
      byId('layers').append(button);
    }
  }

  showLayer(key, on) {
    if (on) this.view.layers.add(key);
    else this.view.layers.delete(key);
    document.querySelector(`[data-layer="${key}"]`).setAttribute('aria-pressed', on);
    this.refresh();
  }

  makeStates() {
    const {states} = this.scene;
    byId('state-control').hidden = states.length === 0;
    if (states.length === 0) return;
    byId('state').max = states.length - 1;
    byId('state').oninput = () => this.showState(Number(byId('state').value));
    byId('state-before').onclick = () => this.showState(this.view.state - 1);
    byId('state-after').onclick = () => this.showState(this.view.state + 1);
    this.showState(this.view.state);
  }

  // A selected point of the surface is followed into the other state.
  showState(index) {
    const {states, parts} = this.scene;
    if (index < 0 || index >= states.length) return;
    this.view.state = index;
    byId('state').value = index;
    byId('state-text').textContent = states[index].text;
    if (!this.coloring) return;
    const before = this.selection;
    this.recolor();
    if (!before || this.view.isShown(before.part)) return this.refresh();
    const alike = (state) => parts.filter((part) => part.state === state &&
        part.layer === before.part.layer && kindOf(part) === kindOf(before.part));
    const same = alike(index)[alike(before.part.state).indexOf(before.part)] ?? null;
    this.choose(same && {part: same, point: same.points.length === before.part.points.length ?
        before.point : null, others: 0});
  }

  makeQuantities() {
    byId('quantity-control').hidden = this.scene.quantities.length === 0;
    this.scene.quantities.forEach((quantity, index) =>
        byId('quantity').append(element('option', nameWithUnit(quantity), {value: index})));
    byId('quantity').onchange = byId('one-range').onchange = () => {
      this.recolor();
      this.refresh();
    };
  }

  recolor() {
    const quantity = this.scene.quantities[byId('quantity').value];
    if (!quantity) return this.view.colorBy(null);
    byId('one-range').parentElement.hidden = quantity.state_scales.length === 0;
    const own = byId('one-range').checked ? null : quantity.state_scales[this.view.state];
    this.coloring = new Coloring(quantity, own ?? quantity.scale,
                                 this.scene.color_maps[quantity.color_map]);
    this.view.colorBy(this.coloring);
    byId('color-bar').replaceChildren(colorBarNode(this.coloring.scale, this.coloring.table));
  }

  makePartList() {
    byId('part').onchange = () => {
      const part = this.scene.parts[byId('part').value];
      this.choose(part ? {part, point: null, others: 0} : null);
    };
  }

  // The list of what can be selected now, by layer.
  fillPartList() {
    const list = byId('part');
    list.replaceChildren(element('option', '\u2013', {value: ''}));
    for (const layer of this.scene.layers) {
      const parts = this.selectableParts().filter((part) => part.layer === layer.key);
      if (parts.length === 0) continue;
      const group = element('optgroup', '', {label: layer.name});
      for (const part of parts) group.append(element('option', part.name, {value: part.index}));
      list.append(group);
    }
    list.value = this.selection ? this.selection.part.index : '';
  }

  selectableParts() { return this.view.shownParts().filter((part) => part.facts.length > 0); }

  // Selects {part, point, others} or, with null, nothing.
  choose(selection) {
    this.selection = selection;
    this.refresh();
    byId('facts').replaceChildren(...factNodes(this.scene, selection));
  }

  refresh() {
    if (this.selection && !this.view.isShown(this.selection.part)) return this.choose(null);
    this.view.select(this.selection && this.selection.point === null ? this.selection.part : null);
    this.fillPartList();
    byId('legends').replaceChildren(...legendNodes(this.view));
    this.view.render();
  }

  // A second click at the same place selects what lies behind.
  pick(x, y) {
    const hits = hitsAt(this.view.shownParts(), this.view.camera, x, y);
    const again = this.lastPick && Math.hypot(this.lastPick.x - x, this.lastPick.y - y) < 4;
    const turn = again ? this.lastPick.turn + 1 : 0;
    this.lastPick = {x, y, turn};
    if (hits.length === 0) return this.choose(null);
    const {part, point} = hits[turn % hits.length];
    this.choose({part, point: part.values.size > 0 ? point : null, others: hits.length - 1});
  }
}

// Alike for the parts of two states that show the same: what is told of them, and of which group.
function kindOf(part) {
  return part.facts.map(([name, value]) => name === 'group' ? `${name} ${value}` : name).join();
}

// What the panel says of the selection.
function factNodes(scene, selection) {
  if (!selection)
    return [element('p', 'Click a view, a board of the target, a ruler, a gauge or a point of the ' +
                         'surface, or choose it in the list.')];
  const {part, point, others} = selection;
  const rows = part.facts.map(([name, value]) => [name, value]);
  if (point !== null) rows.push(...pointRows(scene, part, point));
  const table = element('table', '');
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.append(element('th', name, {scope: 'row'}), element('td', value));
  }
  const nodes = [element('h3', part.name), table];
  if (others > 0)
    nodes.push(element('p', `${others} more here: click again for what lies behind.`));
  return nodes;
}

// Position and every quantity of a point, one digit more than the colour bar has.
function pointRows(scene, part, point) {
  const rows = pointOf(part, point).map(
      (value, k) => [`${'xyz'[k]} in array`, `${numberText(value, 4)} mm`]);
  for (const quantity of scene.quantities) {
    const values = part.values.get(quantity.key);
    if (!values) continue;
    const known = Number.isFinite(values[point]);
    rows.push([quantity.name, known ?
        `${numberText(values[point], quantity.scale.decimals + 1)} ${quantity.unit}` : '\u2013']);
  }
  return rows;
}

function listenToPictures() {
  const dialog = byId('enlarged');
  for (const button of document.querySelectorAll('figure button'))
    button.onclick = () => {
      const picture = button.querySelector('img');
      dialog.querySelector('img').src = picture.src;
      dialog.querySelector('img').alt = picture.alt;
      dialog.querySelector('p').textContent = picture.alt;
      dialog.showModal();
    };
  dialog.onclick = () => dialog.close();
}

function listenToTables() {
  const setAll = (open) => document.querySelectorAll('details').forEach((item) => {
    item.open = open;
  });
  byId('open-all').onclick = () => setAll(true);
  byId('close-all').onclick = () => setAll(false);
  addEventListener('beforeprint', () => setAll(true));
}

listenToPictures();
listenToTables();
if (typeof vtk !== 'undefined') {
  try {
    window.review = new Review(decodeScene(byId('scene-data').textContent));
    byId('scene-notice').hidden = true;
  } catch (error) {
    byId('viewer').hidden = true;
    byId('scene-notice').append(` (${error.message})`);
  }
}
