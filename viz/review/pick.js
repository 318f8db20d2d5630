'use strict';

// What lies under a point of the screen. Bodies that enclose others are translucent, so that
// measured things are preferred over what surrounds them; among equals the nearest wins.

const kLineTolerancePx = 5;
const kEnclosing = {views: 1, optics: 1, pipe: 2, frame: 2};

// Depth of the triangle a b c (screen x, y, depth) at x, y, or null outside.
function depthInTriangle(a, b, c, x, y) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  if (area === 0) return null;
  const u = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
  const v = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
  if (u < 0 || v < 0 || u + v > 1) return null;
  return a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]);
}

// Depth of the segment a b where it passes x, y within the tolerance, or null.
function depthOnSegment(a, b, x, y) {
  const along = [b[0] - a[0], b[1] - a[1]];
  const square = along[0] ** 2 + along[1] ** 2;
  const share = square === 0 ? 0 :
      Math.max(0, Math.min(1, ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / square));
  const distance = Math.hypot(a[0] + share * along[0] - x, a[1] + share * along[1] - y);
  return distance > kLineTolerancePx ? null : a[2] + share * (b[2] - a[2]);
}

// The faces of a part as a click means them: a board is hit between its dark squares too. Its first
// four lines go around it.
function forEachTarget(part, visit) {
  if (part.layer === 'boards' && part.lines.length >= 8)
    visit([0, 2, 4, 6].map((at) => part.lines[at]));
  else
    forEachFace(part, visit);
}

// The nearest hit of one part: depth and, for a face, the index of its corner nearest to x, y.
function hitOf(part, camera, x, y) {
  const screen = [];
  for (let i = 0; i < part.points.length / 3; ++i) screen.push(camera.toScreen(pointOf(part, i)));
  let best = null;
  forEachTarget(part, (face) => {
    for (let k = 2; k < face.length; ++k) {
      const depth =
          depthInTriangle(screen[face[0]], screen[face[k - 1]], screen[face[k]], x, y);
      if (depth === null || (best && best.depth >= depth)) continue;
      const distance = (i) => Math.hypot(screen[i][0] - x, screen[i][1] - y);
      best = {part, depth, point: [...face].sort((i, j) => distance(i) - distance(j))[0]};
    }
  });
  for (let at = 0; at < part.lines.length; at += 2) {
    const depth = depthOnSegment(screen[part.lines[at]], screen[part.lines[at + 1]], x, y);
    if (depth !== null && !(best && best.depth >= depth)) best = {part, depth, point: null};
  }
  return best;
}

// All hits, the one that is meant first.
function hitsAt(parts, camera, x, y) {
  const rank = (hit) => kEnclosing[hit.part.layer] ?? 0;
  return parts.filter((part) => part.facts.length > 0 || part.values.size > 0)
      .map((part) => hitOf(part, camera, x, y))
      .filter((hit) => hit !== null)
      .sort((a, b) => rank(a) - rank(b) || b.depth - a.depth);
}
