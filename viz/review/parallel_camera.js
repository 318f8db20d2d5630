'use strict';

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const combined = (a, factor, b) => a.map((value, i) => value + factor * b[i]);
const unit = (a) => a.map((value) => value / Math.sqrt(dot(a, a)));

// `vector` turned about the unit vector `axis` (Rodrigues).
function turned(vector, axis, angleRad) {
  const along = dot(axis, vector) * (1 - Math.cos(angleRad));
  const side = cross(axis, vector);
  return vector.map((value, i) =>
      value * Math.cos(angleRad) + side[i] * Math.sin(angleRad) + axis[i] * along);
}

// A parallel projection on a screen of width x height px, its origin in the top left corner:
// lengths across the direction of view keep one scale.
class ParallelCamera {
  constructor() {
    this.focal = [0, 0, 0];
    this.towards = [0, 0, 1];  // to the viewer
    this.up = [0, 1, 0];
    this.mmPerPx = 0.1;
    this.width = 1;
    this.height = 1;
  }

  get right() { return cross(this.up, this.towards); }

  // x, y in px and the distance in front of the focal plane in mm (larger is nearer).
  toScreen(point) {
    const from = combined(point, -1, this.focal);
    return [this.width / 2 + dot(from, this.right) / this.mmPerPx,
            this.height / 2 - dot(from, this.up) / this.mmPerPx, dot(from, this.towards)];
  }

  look(towards, up) {
    this.towards = unit(towards);
    this.up = unit(combined(up, -dot(up, this.towards), this.towards));
  }

  turn(rightPx, downPx, radPerPx) {
    this.towards = turned(this.towards, this.up, -rightPx * radPerPx);
    const axis = this.right;
    this.look(turned(this.towards, axis, -downPx * radPerPx),
              turned(this.up, axis, -downPx * radPerPx));
  }

  move(rightPx, downPx) {
    this.focal = combined(this.focal, -rightPx * this.mmPerPx, this.right);
    this.focal = combined(this.focal, downPx * this.mmPerPx, this.up);
  }

  // The point at x, y px stays where it is.
  zoom(factor, x = this.width / 2, y = this.height / 2) {
    const mmPerPx = Math.max(1e-5, Math.min(10, this.mmPerPx / factor));
    const shift = this.mmPerPx - mmPerPx;
    this.focal = combined(this.focal, (x - this.width / 2) * shift, this.right);
    this.focal = combined(this.focal, -(y - this.height / 2) * shift, this.up);
    this.mmPerPx = mmPerPx;
  }

  // Shows all points (flat arrays x y z …) with a margin for texts.
  fit(pointArrays) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const axes = [this.right, this.up, this.towards];
    for (const points of pointArrays)
      for (let i = 0; i < points.length; i += 3)
        axes.forEach((axis, k) => {
          const at = axis[0] * points[i] + axis[1] * points[i + 1] + axis[2] * points[i + 2];
          low[k] = Math.min(low[k], at);
          high[k] = Math.max(high[k], at);
        });
    if (!(low[0] <= high[0])) return;
    this.focal = [0, 0, 0];
    axes.forEach((axis, k) => {
      this.focal = combined(this.focal, (low[k] + high[k]) / 2, axis);
    });
    const free = (size) => Math.max(40, size - 2 * Math.min(60, 0.09 * size));
    this.mmPerPx = Math.max((high[0] - low[0]) / free(this.width),
                            (high[1] - low[1]) / free(this.height), 1e-4);
  }
}
