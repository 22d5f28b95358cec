// SPDX-License-Identifier: GPL-3.0-or-later
// One orthographic camera for all linked views, turned, shifted and zoomed by mouse, touch and keys.

const THREE = window.THREE;

/** Azimuth and elevation of the eye, degrees. */
export const STANDARD_VIEWS = {
  oblique: [-60, 35], top: [-90, 90], bottom: [-90, -90], front: [-90, 0], side: [0, 0],
};

export class Camera {
  constructor(changed) {
    this.changed = changed;
    this.three = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.target = new THREE.Vector3();
    this.eye = new THREE.Vector3();
    this.fitted = { target: new THREE.Vector3(), radius: 1 };
    this.set("oblique");
  }

  /** All of a box is in the picture from now on. */
  fit(box) {
    box.getCenter(this.fitted.target);
    this.fitted.radius = 0.5 * box.getSize(new THREE.Vector3()).length() || 1;
    this.home();
  }

  home() {
    this.target.copy(this.fitted.target);
    this.zoom = 1;
    this.changed();
  }

  set(name) {
    [this.azimuth, this.elevation] = STANDARD_VIEWS[name];
    this.zoom = this.zoom || 1;
    this.changed();
  }

  /** Puts the camera right for a picture of this size, pixels. */
  forSize(width, height) {
    const { three } = this;
    const [a, e] = [this.azimuth, this.elevation].map((angle) => (angle * Math.PI) / 180);
    this.eye.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    const far = 20 * this.fitted.radius;
    const half = (this.fitted.radius * Math.max(0.75, (1.02 * height) / width)) / this.zoom;
    const wide = (half * width) / height;
    Object.assign(three, { left: -wide, right: wide, top: half, bottom: -half, near: 0, far: 2 * far });
    three.position.copy(this.target).addScaledVector(this.eye, far);
    three.up.set(-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e));
    three.lookAt(this.target);
    three.updateProjectionMatrix();
    three.updateMatrixWorld();
    this.millimetres = (2 * half) / height; // of a pixel
    return three;
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = Math.max(-90, Math.min(90, this.elevation + up));
    this.changed();
  }

  shift(right, up) {
    const [x, y] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(this.three.matrix, k));
    this.target.addScaledVector(x, -right * this.millimetres).addScaledVector(y, up * this.millimetres);
    this.changed();
  }

  magnify(factor) {
    this.zoom = Math.max(0.2, Math.min(60, this.zoom * factor));
    this.changed();
  }

  /** Mouse, touch and keys on an element; `clicked(event)` when nothing was dragged. */
  listen(element, clicked) {
    const down = new Map();
    let moved = 0;
    element.addEventListener("pointerdown", (event) => {
      down.set(event.pointerId, event);
      this.held = true;
      moved = 0;
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      const before = down.get(event.pointerId);
      if (!before) return;
      const [right, below] = [event.clientX - before.clientX, event.clientY - before.clientY];
      moved += Math.abs(right) + Math.abs(below);
      this.drag(down, event, right, below);
      down.set(event.pointerId, event);
    });
    const up = (event) => {
      const held = down.delete(event.pointerId);
      this.held = down.size > 0;
      if (held && moved < 4 && event.type === "pointerup") clicked(event);
    };
    element.addEventListener("pointerup", up);
    element.addEventListener("pointercancel", up);
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.magnify(Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
    element.addEventListener("keydown", (event) => this.key(event));
  }

  drag(down, event, right, below) {
    if (down.size === 2) { // two fingers: apart and together, and along
      const other = [...down.values()].find((one) => one.pointerId !== event.pointerId);
      const apart = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
      this.magnify(apart(event) / Math.max(1, apart(down.get(event.pointerId))));
      this.shift(right / 2, below / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      this.shift(right, below);
    } else {
      this.turn(0.4 * right, 0.4 * below);
    }
  }

  key(event) {
    const step = event.shiftKey ? 40 : 6;
    const act = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
    }[event.key];
    if (act && event.shiftKey) this.shift(act[0] * step, act[1] * step);
    else if (act) this.turn(act[0] * step, act[1] * step);
    else if (event.key === "+") this.magnify(1.2);
    else if (event.key === "-") this.magnify(1 / 1.2);
    else return;
    event.preventDefault();
  }
}
