'use strict';

// The scene as the page's data give it, decoded, and what the renderer needs of it. Points are in
// the array frame, mm.

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
}

// Replaces the coded arrays of every part: points (x y z …), faces (count, indexes, count, …),
// lines (pairs of indexes) and values by quantity key.
function decodeScene(text) {
  const scene = JSON.parse(text);
  scene.parts.forEach((part, index) => {
    part.index = index;
    part.points = new Float32Array(bytesOf(part.points));
    part.faces = new Uint32Array(bytesOf(part.faces));
    part.lines = new Uint32Array(bytesOf(part.lines));
    part.values = new Map(
        part.values.map((item) => [item.quantity, new Float32Array(bytesOf(item.values))]));
  });
  return scene;
}

function pointOf(part, index) {
  return Array.from(part.points.subarray(3 * index, 3 * index + 3));
}

// Calls `visit` with the indexes of every face's corners.
function forEachFace(part, visit) {
  for (let at = 0; at < part.faces.length; at += part.faces[at] + 1)
    visit(part.faces.subarray(at + 1, at + 1 + part.faces[at]));
}

function rgbOf(color) {
  return [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
}

// Parts that are drawn alike and shown together, as one mesh: a few dozen draw calls instead of
// one or two for every part.
class Batch {
  constructor(part, kind) {
    Object.assign(this, {kind, layer: part.layer, state: part.state, parts: [], points: 0});
    this.opacity = kind === 'faces' ? part.opacity : 1;
    this.lit = kind === 'faces' && part.lit;
    this.width = part.line_width_pt;
  }

  static keyOf(part, kind) {
    const look = kind === 'faces' ? [part.opacity, part.lit] : [part.line_width_pt];
    return [kind, part.layer, part.state, ...look].join(' ');
  }

  add(part) {
    this.parts.push({part, first: this.points});
    this.points += part.points.length / 3;
  }

  pointArray() {
    const all = new Float32Array(3 * this.points);
    for (const {part, first} of this.parts) all.set(part.points, 3 * first);
    return all;
  }

  // Cells as VTK wants them: count, indexes, count, …
  cellArray() {
    const cells = [];
    for (const {part, first} of this.parts) {
      if (this.kind === 'faces')
        forEachFace(part, (face) => cells.push(face.length, ...face.map((i) => i + first)));
      else
        for (let at = 0; at < part.lines.length; at += 2)
          cells.push(2, part.lines[at] + first, part.lines[at + 1] + first);
    }
    return Uint32Array.from(cells);
  }

  // Writes three bytes for every point: by value where a part has the quantity, else its colour.
  paint(bytes, coloring) {
    for (const {part, first} of this.parts) {
      const values = coloring && part.values.get(coloring.key);
      const own = rgbOf(part.color);
      for (let i = 0; i < part.points.length / 3; ++i)
        bytes.set(values ? coloring.colorOf(values[i]) : own, 3 * (first + i));
    }
  }
}

function batchesOf(parts) {
  const batches = new Map();
  for (const part of parts)
    for (const kind of ['faces', 'lines']) {
      if (part[kind].length === 0) continue;
      const key = Batch.keyOf(part, kind);
      if (!batches.has(key)) batches.set(key, new Batch(part, kind));
      batches.get(key).add(part);
    }
  return [...batches.values()];
}

// A quantity over a range in a colour table of hex colours; values outside take the end colours,
// what is not a number is grey.
class Coloring {
  constructor(quantity, scale, table) {
    Object.assign(this, {key: quantity.key, quantity, scale, table});
    this.colors = table.map(rgbOf);
  }

  colorOf(value) {
    if (!Number.isFinite(value)) return [170, 170, 170];
    const {low, high} = this.scale;
    const share = (value - low) / (high - low);
    const last = this.colors.length - 1;
    return this.colors[Math.max(0, Math.min(last, Math.floor(share * this.colors.length)))];
  }
}
