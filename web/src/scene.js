// The 3D view: camera, light, what is shown. It draws only when something changed.
import {
  AmbientLight, DirectionalLight, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { FIELD_OF_VIEW, fitted, frameOf, presets } from './camera.js';

/** Pixels at the sides of the view: the colour scale stands on the left, buttons above. */
const ROOM = { left: 150, right: 40, top: 56, bottom: 30 };
/** In a narrow view what stands at the sides may cover the part. */
const NARROW = 620;

/** Without a graphics card: milliseconds of rest after which a picture is drawn again with smooth edges, twice as wide and high; while it turns
 * it is half as wide and high, for every pixel costs the processor. */
const REST = 250, SHARP = 2, TURNING = 0.5;

/** Whether the processor draws, once that was asked. */
let software = null;

/** The same; smooth edges cost it as much as all else. Throws if nothing draws. */
function isSoftware() {
  if (software !== null) return software;
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) throw new Error('this browser offers no WebGL 2');
  const names = gl.getExtension('WEBGL_debug_renderer_info'), name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  return software;
}

export class Stage {
  /** `room`: pixels at the sides of the picture that something else covers. `quick`: without a graphics card edges are smooth at rest
   * alone. */
  constructor(canvas, room = ROOM, quick = false) {
    this.canvas = canvas;
    this.margins = room;
    this.listeners = [];
    this.quiet = true;
    const slow = isSoftware();
    this.soft = quick && slow;
    // The first picture is as rough as one that turns: it is wanted soon.
    this.turns = true;
    // What was drawn last stays readable: for printing and for screenshots.
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.soft, alpha: true, preserveDrawingBuffer: true });
    // Asking the driver for complaints makes it finish every program before the next is begun.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.setPixelRatio(this.soft ? 1 : Math.min(2, window.devicePixelRatio));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.1, 10000);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 2.45));
    this.key = new DirectionalLight(0xffffff, 0.7);
    this.key.position.set(-0.35, 0.6, 1);
    this.camera.add(this.key, this.key.target);
    this.hold(new Vector3());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  /** Gives the graphics back: a browser has room for some pictures only. */
  dispose() {
    clearTimeout(this.rest);
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Controls learn the upward direction only when they are made. */
  hold(target) {
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(target);
    this.controls.addEventListener('change', () => {
      this.turns = true;
      this.draw();
    });
    this.controls.update();
  }

  onDraw(listener) {
    this.listeners.push(listener);
  }

  /** Looks for the best views; `wish` as presets() takes it. */
  frame(wish) {
    this.home = frameOf(wish.targets, wish.towards);
    return this.hang(this.home, presets(this.home, wish));
  }

  /** Takes views as they are; `home`: { centre, radius } of what is looked at. */
  hang(home, views) {
    Object.assign(this, { home, presets: views });
    const distance = this.home.radius / Math.sin((0.5 * FIELD_OF_VIEW * Math.PI) / 180);
    this.camera.near = 0.02 * distance;
    this.camera.far = 40 * distance;
    this.resize();
    return views;
  }

  room() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const free = (pixels, size) => Math.max(0.4, 1 - (2 * pixels) / size);
    const { left, right, top, bottom } = this.margins;
    return { left: free(width < NARROW ? 20 : left, width), right: free(width < NARROW ? 20 : right, width),
      top: free(top, height), bottom: free(bottom, height) };
  }

  look(name) {
    const preset = this.presets[name];
    const { position, target } = fitted(preset, this.camera.aspect, this.room());
    this.quiet = true;
    this.camera.up.copy(preset.up);
    this.camera.position.copy(position);
    this.hold(target);
    this.quiet = false;
    this.draw();
  }

  /** Turns about the target by angles in radians, or comes nearer by a factor. */
  orbit(right, upwards, nearer = 1) {
    this.turns = true;
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, right);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const lifted = offset.clone().applyAxisAngle(side, -upwards);
    if (Math.abs(lifted.clone().normalize().dot(this.camera.up)) < 0.98) offset.copy(lifted);
    this.camera.position.copy(this.controls.target).addScaledVector(offset, nearer);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws before the next frame, however often it is asked to. */
  draw() {
    if (this.quiet || this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.render();
      for (const listener of this.listeners) listener(this);
    });
  }

  /** Now: roughly while it turns or changes, smoothly once it rests. */
  render() {
    if (this.soft) {
      const ratio = this.turns ? TURNING : 1;
      if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
      clearTimeout(this.rest);
      this.rest = setTimeout(() => {
        this.turns = false;
        this.renderer.setPixelRatio(SHARP);
        this.renderer.render(this.scene, this.camera);
      }, REST);
    }
    this.renderer.render(this.scene, this.camera);
  }

  /** Millimetres of a pixel at the target's depth. */
  get pixel() {
    const depth = this.camera.position.distanceTo(this.controls.target);
    return (2 * depth * Math.tan((0.5 * FIELD_OF_VIEW * Math.PI) / 180)) / this.canvas.clientHeight;
  }

  /** CSS pixels of a point of space. */
  toScreen(point) {
    const p = point.clone().project(this.camera);
    return [0.5 * (p.x + 1) * this.canvas.clientWidth, 0.5 * (1 - p.y) * this.canvas.clientHeight, p.z];
  }

  /** Whether one of the meshes stands between the camera and a point; what ends at the point itself does not. */
  hides(point, meshes) {
    const way = point.clone().sub(this.camera.position), length = way.length();
    const ray = new Raycaster(this.camera.position, way.normalize(), this.camera.near, length - 0.01 * this.home.radius);
    return ray.intersectObjects(meshes, false).length > 0;
  }

  pick(x, y, meshes) {
    const ray = new Raycaster();
    const where = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    ray.setFromCamera(where, this.camera);
    return ray.intersectObjects(meshes, false)[0] ?? null;
  }
}
