// node page_check.mjs CHECK CHROMIUM PAGE.html: ends with 0 when the page does what CHECK says, else
// with the reason on stderr. Screenshots are written beside the page.
import assert from 'node:assert/strict';
import {writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

import {Browser} from './browser.mjs';

const [check, program, file] = process.argv.slice(2);
const url = pathToFileURL(file).href;
const text = (id) => `document.getElementById('${id}').textContent`;
const isShown = (id) => `document.getElementById('${id}').checkVisibility()`;

// Helpers in the page: the scene's pixels, how many differ from remembered ones, one pixel's colour.
const kPageHelpers = `
  function scenePixels() {
    review.view.render();
    const canvas = document.querySelector('#canvas canvas');
    const copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
    [copy.canvas.width, copy.canvas.height] = [canvas.width, canvas.height];
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height);
  }
  function changedPixels() {
    const {data, width} = scenePixels();
    const before = window.remembered;
    window.remembered = data;
    let [count, x, y] = [0, 0, 0];
    for (let i = 0; before && i < data.length; i += 4)
      if (Math.abs(data[i] - before[i]) + Math.abs(data[i + 1] - before[i + 1]) +
          Math.abs(data[i + 2] - before[i + 2]) > 30) {
        ++count;
        x += i / 4 % width;
        y += Math.floor(i / 4 / width);
      }
    return {count, x: x / count, y: y / count};
  }
  function colorAt(point) {
    const [x, y] = review.view.camera.toScreen(point).map(Math.round);
    const {data, width} = scenePixels();
    return Array.from(data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3));
  }
  function onPage(point) {
    const box = document.getElementById('canvas').getBoundingClientRect();
    const [x, y] = review.view.camera.toScreen(point);
    return [box.left + x, box.top + y];
  }
  function tableColor(end) {
    const {colors} = review.coloring;
    return colors[end === 'low' ? 0 : colors.length - 1];
  }`;

async function save(browser, name, whole = false) {
  writeFileSync(file.replace(/\.html$/, `_${name}.png`), await browser.screenshot(whole));
}

// Eight-bit colours that differ by rounding only.
function assertSameColor(found, wanted) {
  found.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) <= 1, `${found} ${wanted}`));
}

async function checkTurning(browser) {
  await browser.evaluate('changedPixels().count');
  assert.equal(await browser.evaluate('changedPixels().count'), 0, 'an idle scene changes');
  const [x, y] = await browser.evaluate('onPage(review.view.camera.focal)');
  await browser.drag([x, y], [x + 90, y + 40]);
  assert.ok(await browser.evaluate('changedPixels().count') > 2000, 'a drag does not turn');
  await browser.evaluate('document.querySelector("#canvas").focus()');
  await browser.key('ArrowLeft');
  assert.ok(await browser.evaluate('changedPixels().count') > 2000, 'a key does not turn');
  await browser.send('Input.dispatchMouseEvent',
                     {type: 'mouseWheel', x, y, deltaX: 0, deltaY: -240});
  await browser.evaluate('new Promise(requestAnimationFrame)');
  assert.ok(await browser.evaluate('changedPixels().count') > 2000, 'the wheel does not zoom');
}

// Colours are asserted where a known point is seen: the middle of the surface from above, without
// what is translucent before it. Light does not act on them.
async function checkColors(browser) {
  const middle = [8, 0, 4];
  await browser.evaluate(`for (const layer of ['views', 'displacements', 'rulers'])
    if (review.view.layers.has(layer)) review.showLayer(layer, false); review.look(2)`);
  const color = () => browser.evaluate(`colorAt(${JSON.stringify(middle)})`);
  assert.match(await browser.evaluate(text('state-text')), /pipe_001\.png.*200\.00/);
  assertSameColor(await color(), await browser.evaluate('tableColor("high")'));
  await browser.evaluate('document.getElementById("state-before").click()');
  assert.match(await browser.evaluate(text('state-text')), /pipe_000\.png.*100\.00/);
  assertSameColor(await color(), await browser.evaluate('tableColor("low")'));
  const ticks = await browser.evaluate(
      '[...document.querySelectorAll("#color-bar .ticks span")].map((span) => span.textContent)');
  assert.deepEqual([ticks[0], ticks.at(-1)], ['100', '200']);
  // Hoop strain falls where the axial rises: in the first state it is at the upper end.
  await browser.evaluate('document.getElementById("quantity").value = 1;' +
                         'document.getElementById("quantity").onchange()');
  assertSameColor(await color(), await browser.evaluate('tableColor("high")'));
  await browser.evaluate('document.getElementById("one-range").click()');
  const own = await browser.evaluate('review.coloring.scale');
  assert.ok(own.low < -30 && -30 < own.high, 'the range of one state does not hold its value');
}

async function checkClicks(browser) {
  await browser.evaluate('if (!review.view.layers.has("views")) review.showLayer("views", true)');
  await browser.evaluate('review.look(2); changedPixels()');
  // A corner square of the upper board, away from the arrow in the view's middle.
  const place = await browser.evaluate('onPage([-9.7, 1.2, 5])');
  await browser.click(...place);
  assert.match(await browser.evaluate(text('facts')), /calibration\/high\.png/);
  const changed = await browser.evaluate('changedPixels()');
  const [x, y] = await browser.evaluate('review.view.camera.toScreen([-8, 0, 5])');
  assert.ok(changed.count > 100, 'the selection does not show');
  // The highlighted frame and squares are alike about the board's middle to within a square.
  const square = await browser.evaluate('0.5 / review.view.camera.mmPerPx');
  assert.ok(Math.hypot(changed.x - x, changed.y - y) < square, 'the highlight is elsewhere');
  assertSameColor(await browser.evaluate('colorAt([-9.5, -1.5, 5])'), [214, 0, 107]);
  await save(browser, 'selected');
  await browser.click(...place);
  assert.match(await browser.evaluate(text('facts')), /calibration\/low\.png/, 'what lies behind');
  await browser.click(...await browser.evaluate('onPage([7.05, 0.53, 4])'));
  const facts = await browser.evaluate(text('facts'));
  assert.match(facts, /x in array7\.0000 mmy in array0\.5000 mmz in array4\.0000 mm/);
  assert.match(facts, /axial strain100\.0 \u00b5\u03b5hoop strain\u221230\.0 \u00b5\u03b5/);
  assert.ok(await browser.evaluate(isShown('marker')));
  await browser.evaluate('document.getElementById("state-after").click()');
  // Of the second group, whose parts stand behind the edge of the first in the list.
  const followed = await browser.evaluate(text('facts'));
  assert.match(followed, /axial strain200\.0/, 'the point is lost');
  assert.match(followed, /groupB.*x in array7\.0000 mm/, 'another point is followed');
  await browser.evaluate('review.showLayer("rulers", true)');
  await browser.click(...await browser.evaluate('onPage([0, 0.3, 4.2])'));
  assert.match(await browser.evaluate(text('facts')), /ruler\/ruler_001\.png/);
}

async function checkScene(browser) {
  assert.ok(await browser.evaluate(isShown('viewer')));
  assert.ok(!await browser.evaluate(isShown('scene-notice')));
  await browser.evaluate(kPageHelpers);
  await browser.evaluate('document.getElementById("scene").scrollIntoView()');
  await save(browser, 'wide');
  await checkTurning(browser);
  await checkColors(browser);
  await checkClicks(browser);
  await browser.evaluate('document.querySelector("figure button").click()');
  assert.ok(await browser.evaluate('document.getElementById("enlarged").open'));
  await browser.evaluate('document.getElementById("enlarged").click()');
  await browser.resize(420, 900);
  await browser.evaluate('new Promise((done) => setTimeout(done, 300))');
  assert.ok(await browser.evaluate('document.documentElement.scrollWidth <= innerWidth'),
            'the page is wider than a phone');
  await save(browser, 'phone', true);
}

async function checkNoScene(browser, reason) {
  assert.ok(!await browser.evaluate(isShown('viewer')));
  assert.match(await browser.evaluate(text('scene-notice')), reason);
  assert.ok(await browser.evaluate('document.querySelector("figure img").naturalWidth > 0'));
  await save(browser, 'wide');
}

async function checkHostile(browser) {
  await browser.evaluate('new Promise((done) => setTimeout(done, 300))');
  assert.match(await browser.evaluate('document.title'), /^<\/title><\/script>/);
  assert.equal(await browser.evaluate('document.images.length'), 2);  // picture, enlarged one
}

const kChecks = {
  scene: checkScene,
  no_webgl: (browser) => checkNoScene(browser, /needs JavaScript and WebGL 2/),
  no_vtk_js: (browser) => checkNoScene(browser, /built without vtk\.js/),
  hostile: checkHostile
};

const browser = new Browser(program, check === 'no_webgl' ? ['--disable-3d-apis'] : []);
try {
  await browser.open(url, 1400, 900);
  await kChecks[check](browser);
  assert.deepEqual(browser.complaints(url), []);
} catch (error) {
  console.error(error.stack, browser.complaints(url));
  process.exitCode = 1;
} finally {
  await browser.close();
}
