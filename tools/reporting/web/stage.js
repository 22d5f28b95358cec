// SPDX-License-Identifier: GPL-3.0-or-later
// One canvas behind all pictures; drawn only when something has changed.

import { Camera } from "plyform/camera.js";

const THREE = window.THREE;

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
    this.ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.fine = false;
    this.renderer.setClearColor(0xffffff, 1);
    this.renderer.autoClear = false;
    this.views = [];
    this.flatCamera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
    this.camera = new Camera(() => this.request("formed"));
    this.frames = 0;
    this.drawn = () => {}; // after each picture
    window.addEventListener("resize", () => this.request());
  }

  /** Draws soon: all pictures, or only those of formed plies, which the camera turns. */
  request(which = "all") {
    if (which === "all") this.all = true;
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw(false, this.all ? "all" : "formed");
      this.all = false;
      this.drawAtRest();
    });
  }

  /** Once more, fine, when nothing has moved for a while: longer where pictures take long, and not
   * while the camera is held. */
  drawAtRest() {
    const now = performance.now();
    const since = now - (this.last || -Infinity);
    this.last = now;
    const rest = () => {
      if (this.camera.held) this.rest = setTimeout(rest, 250);
      else this.draw(true);
    };
    clearTimeout(this.rest);
    this.rest = setTimeout(rest, since > 4000 ? 250 : Math.max(250, 3 * since));
  }

  /** Pictures, now. Fine: twice the pixels each way, when nothing moves, for smooth edges. */
  draw(fine = false, which = "all") {
    const { renderer, canvas } = this;
    let everything = which === "all";
    const room = canvas.parentElement.getBoundingClientRect();
    const [width, height] = [Math.round(room.width), Math.round(room.height)];
    if (this.width !== width || this.height !== height || this.fine !== fine) {
      [this.width, this.height, this.fine] = [width, height, fine];
      renderer.setPixelRatio(fine ? 2 * this.ratio : this.ratio);
      renderer.setSize(width, height, false);
      everything = true;
    }
    renderer.setScissorTest(false);
    if (everything) renderer.clear();
    renderer.setScissorTest(true);
    for (const view of this.views) {
      if (!view.element.hidden && (everything || !view.flat)) this.drawView(view, room);
    }
    this.frames += 1;
    this.drawn();
  }

  drawView(view, room) {
    const place = view.element.getBoundingClientRect();
    const [left, below] = [place.left - room.left, room.bottom - place.bottom];
    if (place.width < 2 || place.height < 2) return;
    this.renderer.setViewport(left, below, place.width, place.height);
    this.renderer.setScissor(left, below, place.width, place.height);
    view.prepare(this.fine);
    const camera = view.flat ? this.cameraOfFlat(view, place) : this.cameraOfFormed(view, place);
    this.renderer.clear();
    view.mark(this.probe, (camera.top - camera.bottom) / place.height);
    this.renderer.render(view.scene, camera);
  }

  cameraOfFormed(view, place) {
    const camera = this.camera.forSize(place.width, place.height);
    view.uniforms.towards_eye.value.copy(this.camera.eye);
    view.plies.forEach((mesh, i) => { // the nearest first: what it hides need not be coloured
      mesh.surface.renderOrder = this.camera.eye.z > 0 ? -i : i;
    });
    const key = this.camera.eye.toArray().map((k) => k.toFixed(3)).join() + view.tools.map((t) => t.outline.visible);
    if (view.outlinedFor !== key) {
      view.outlinedFor = key;
      view.outlineTools(this.camera.eye);
    }
    return camera;
  }

  cameraOfFlat(view, place) {
    const box = new THREE.Box3();
    for (const mesh of view.plies) box.union(new THREE.Box3().setFromArray(mesh.ply.flat));
    const [middle, size] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3())];
    const half = 0.56 * Math.max(size.y, (size.x * place.height) / place.width);
    const wide = (half * place.width) / place.height;
    const camera = this.flatCamera;
    Object.assign(camera, { left: -wide, right: wide, top: half, bottom: -half });
    camera.position.set(middle.x, middle.y, middle.z + 10);
    camera.lookAt(middle);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    view.uniforms.towards_eye.value.set(0, 0, 1);
    return camera;
  }

  /** Ray under a point of the window, through a view. */
  ray(view, x, y) {
    const place = view.element.getBoundingClientRect();
    const camera = view.flat ? this.cameraOfFlat(view, place) : this.camera.forSize(place.width, place.height);
    const at = new THREE.Vector2((2 * (x - place.left)) / place.width - 1,
      1 - (2 * (y - place.top)) / place.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, camera);
    if (view.flat) caster.ray.origin.z = camera.position.z;
    return caster.ray;
  }

  /** Where a place of a view's scene is on the page. */
  pixelOf(view, point) {
    const place = view.element.getBoundingClientRect();
    const camera = view.flat ? this.cameraOfFlat(view, place) : this.camera.forSize(place.width, place.height);
    const at = point.clone().project(camera);
    return { x: place.left + (0.5 + 0.5 * at.x) * place.width,
      y: place.top + (0.5 - 0.5 * at.y) * place.height };
  }

  /** A still picture of one view as a data URL, `set` being done before and `after` it. */
  still(view, width, height) {
    const before = view.element.getBoundingClientRect;
    const room = this.canvas.parentElement.getBoundingClientRect.bind(this.canvas.parentElement);
    const rect = { left: 0, top: 0, right: width, bottom: height, width, height };
    view.element.getBoundingClientRect = () => rect;
    this.canvas.parentElement.getBoundingClientRect = () => rect;
    const shown = this.views;
    this.views = [view];
    const wasHidden = view.element.hidden;
    view.element.hidden = false;
    this.draw(true);
    const picture = this.canvas.toDataURL("image/png");
    this.views = shown;
    view.element.hidden = wasHidden;
    view.element.getBoundingClientRect = before;
    this.canvas.parentElement.getBoundingClientRect = room;
    return picture;
  }
}
