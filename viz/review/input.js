'use strict';

// Pointer, wheel and keys on the scene. A drag turns, with shift or another button it moves; two
// fingers move and zoom. The wheel zooms only while the scene has the focus, so that the page can
// be scrolled past it.

function listenToPointer(review) {
  const host = review.view.container;
  const {camera} = review.view;
  const pointers = new Map();
  let travelled = 0;
  const place = (event) => {
    const box = host.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  const middle = () => {
    const all = [...pointers.values()];
    const mean = (pick) => all.reduce((sum, at) => sum + pick(at), 0) / all.length;
    const [x, y] = [mean((at) => at.x), mean((at) => at.y)];
    return {x, y, spread: mean((at) => Math.hypot(at.x - x, at.y - y))};
  };
  host.onpointerdown = (event) => {
    host.setPointerCapture(event.pointerId);
    host.focus({preventScroll: true});
    if (pointers.size === 0) travelled = 0;
    pointers.set(event.pointerId, place(event));
    host.classList.add('turning');
  };
  host.onpointermove = (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = middle();
    pointers.set(event.pointerId, place(event));
    const after = middle();
    const [right, down] = [after.x - before.x, after.y - before.y];
    travelled += Math.hypot(right, down);
    if (pointers.size > 1) {
      camera.move(right, down);
      if (before.spread > 0) camera.zoom(after.spread / before.spread, after.x, after.y);
    } else if (event.shiftKey || event.buttons > 1) {
      camera.move(right, down);
    } else {
      camera.turn(right, down, kRadPerPx);
    }
    review.view.render();
  };
  host.onpointerup = host.onpointercancel = (event) => {
    const only = pointers.size === 1;
    pointers.delete(event.pointerId);
    host.classList.toggle('turning', pointers.size > 0);
    const at = place(event);
    if (event.type === 'pointerup' && only && travelled < 4 && event.button === 0)
      review.pick(at.x, at.y);
  };
  host.oncontextmenu = (event) => event.preventDefault();
  host.addEventListener('wheel', (event) => {
    if (document.activeElement !== host) return;
    event.preventDefault();
    const at = place(event);
    camera.zoom(Math.exp(-0.0015 * event.deltaY), at.x, at.y);
    review.view.render();
  }, {passive: false});
}

// The part `step` further in the list of what can be selected.
function selectNext(review, step) {
  const parts = review.selectableParts();
  if (parts.length === 0) return;
  const now = review.selection ? parts.indexOf(review.selection.part) : -1;
  const next = now < 0 ? (step > 0 ? 0 : parts.length - 1) :
                         (now + step + parts.length) % parts.length;
  review.choose({part: parts[next], point: null, others: 0});
}

function listenToKeys(review) {
  const {camera} = review.view;
  const step = 12;  // px
  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
  const actions = {
    '+': () => camera.zoom(1.2),
    '=': () => camera.zoom(1.2),
    '-': () => camera.zoom(1 / 1.2),
    PageUp: () => review.showState(review.view.state - 1),
    PageDown: () => review.showState(review.view.state + 1),
    n: () => selectNext(review, 1),
    p: () => selectNext(review, -1),
    f: () => review.view.fit(),
    Escape: () => review.choose(null)
  };
  review.view.container.onkeydown = (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) camera.move(step * arrow[0], step * arrow[1]);
    else if (arrow) camera.turn(step * arrow[0], step * arrow[1], kRadPerPx);
    else if (actions[event.key]) actions[event.key]();
    else if (/^[1-9]$/.test(event.key)) review.look(Number(event.key) - 1);
    else return;
    event.preventDefault();
    review.view.render();
  };
}
