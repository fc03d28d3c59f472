/* 3-D scenes: brings the still pictures of .ledger-scene to life. three.js comes with meshcat's viewer. */
(() => {
  "use strict";
  const CONTACT = 0xd00000, RULER = 0xd55e00, AROUND = 28, ARC = 8, ALIVE = 4;
  const SPEEDS = [0.25, 0.5, 1, 2, 4];
  const alive = [];
  let loading = null;

  const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
  const el = (tag, attributes = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  };
  const viewer = () => {
    if (window.MeshCat) return Promise.resolve(window.MeshCat.THREE);
    loading ??= new Promise((resolve, reject) => {
      const root = document.documentElement.dataset.content_root ?? "./";
      const script = el("script", { src: `${root}_static/meshcat/main.min.js` });
      script.onload = () => resolve(window.MeshCat.THREE);
      script.onerror = () => reject(new Error("the viewer script was not found"));
      document.head.append(script);
    });
    return loading;
  };
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const whole = (text, reach = 1) => Float32Array.from(new Int16Array(bytes(text)), (v) => (v / 32767) * reach);

  /* ---- shapes ---------------------------------------------------------------------------- */
  function taperedProfile(lower, upper, length) {
    let bottom = -length / 2, top = length / 2, touch = 0;
    if (length <= Math.abs(lower - upper)) {
      bottom = top = (length / 2) * (upper > lower ? 1 : -1);
      lower = upper = Math.max(lower, upper);
    } else touch = Math.asin((lower - upper) / length);
    const rows = [];
    const arc = (from, to, radius, z) => {
      for (let k = 0; k < ARC; k++) {
        const a = from + ((to - from) * k) / (ARC - 1), r = Math.cos(a), h = Math.sin(a);
        rows.push([r * radius, z + h * radius, r, h]);
      }
    };
    arc(-Math.PI / 2, touch, lower, bottom);
    arc(touch, Math.PI / 2, upper, top);
    return rows;
  }
  function rodProfile(radius, height) {
    const half = height / 2, bevel = Math.min(0.12 * radius, 0.3 * height);
    const corners = [[0, -half], [radius - bevel, -half], [radius, bevel - half],
      [radius, half - bevel], [radius - bevel, half], [0, half]];
    const rows = [];
    for (let k = 0; k + 1 < corners.length; k++) {
      const [[r, z], [s, w]] = [corners[k], corners[k + 1]], l = Math.hypot(s - r, w - z);
      rows.push([r, z, (w - z) / l, (r - s) / l], [s, w, (w - z) / l, (r - s) / l]);
    }
    return rows;
  }
  function lathe(T, rows) {
    const at = [], normal = [], faces = [], row = AROUND + 1;
    for (const [r, z, n, m] of rows)
      for (let k = 0; k <= AROUND; k++) {
        const c = Math.cos((2 * Math.PI * k) / AROUND), s = Math.sin((2 * Math.PI * k) / AROUND);
        at.push(r * c, r * s, z);
        normal.push(n * c, n * s, m);
      }
    for (let j = 0; j + 1 < rows.length; j++)
      for (let k = 0; k < AROUND; k++) {
        const a = j * row + k, b = a + row;
        faces.push(a, a + 1, b + 1, a, b + 1, b);
      }
    const made = new T.BufferGeometry();
    made.setAttribute("position", new T.Float32BufferAttribute(at, 3));
    made.setAttribute("normal", new T.Float32BufferAttribute(normal, 3));
    made.setIndex(faces);
    return made;
  }
  function tube(T, points, radius) {
    const places = [];
    for (let k = 0; k < points.length; k += 3) {
      const place = new T.Vector3(points[k], points[k + 1], points[k + 2]);
      if (!places.length || place.distanceTo(places.at(-1)) > 0.3 * radius) places.push(place);
    }
    if (places.length < 2) return new T.SphereGeometry(radius, 8, 6);
    const step = Math.max(1, Math.floor(places.length / 160));
    const kept = places.filter((_, k) => k % step === 0 || k === places.length - 1);
    const curve = new T.CatmullRomCurve3(kept, false, "centripetal");
    return new T.TubeGeometry(curve, Math.min(400, 4 * kept.length), radius, 6);
  }
  function shape(T, part, mesh, extent) {
    const points = mesh && whole(mesh.v, mesh.r);
    if (part.k === "tapered") return lathe(T, taperedProfile(...part.s));
    if (part.k === "rod") return lathe(T, rodProfile(...part.s));
    if (part.k === "box") return new T.BoxGeometry(...part.s);
    if (part.k === "line") return tube(T, points, 0.0018 * extent);
    const made = new T.BufferGeometry();
    made.setAttribute("position", new T.BufferAttribute(points, 3));
    if (mesh.f) {
      made.setIndex(new T.BufferAttribute(new Uint16Array(bytes(mesh.f)), 1));
      made.computeVertexNormals();
    }
    return made;
  }

  /* ---- one scene ------------------------------------------------------------------------- */
  class Scene {
    constructor(figure, T) {
      this.T = T;
      this.figure = figure;
      this.box = figure.querySelector(".scene-box");
      this.data = JSON.parse(figure.querySelector(".scene-data").textContent);
      this.canvas = el("canvas", {
        class: "scene-canvas", tabindex: "0", role: "img",
        "aria-label": `${this.data.title} Arrow keys turn, plus and minus zoom, space plays, Home resets.`,
      });
      this.renderer = new T.WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
      this.renderer.setClearAlpha(0);
      this.camera = new T.PerspectiveCamera(this.data.field, 16 / 9, 0.01, 100);
      this.camera.up.set(0, 0, 1);
      this.time = 0;
      this.speed = 1;
      this.playing = false;
      this.build();
      this.home();
      this.box.append(this.canvas);
      this.figure.classList.add("live");
      this.marks = [...figure.querySelectorAll(".scene-marks span")];
      this.still = this.marks.map((span) => span.style.cssText);
      this.gap = el("span", { class: "scene-gap" });
      figure.querySelector(".scene-marks").append(this.gap);
      this.controls();
      this.listen();
      this.show();
      if (this.data.motion && !calm()) this.play(true);
    }

    build() {
      const { T, data } = this;
      this.extent = new T.Vector3(...data.eye).distanceTo(new T.Vector3(...data.target));
      this.world = new T.Scene();
      this.world.add(new T.HemisphereLight(0xffffff, 0xa9b4bf, 0.72));
      this.lamp = new T.DirectionalLight(0xffffff, 0.55);
      this.world.add(this.lamp, this.lamp.target);
      this.nodes = data.nodes.map((pose) => {
        const node = new T.Group();
        node.position.set(...pose.slice(0, 3));
        node.quaternion.set(...pose.slice(3));
        this.world.add(node);
        return node;
      });
      this.bodies = new Map();
      data.parts.forEach((part) => this.add(part));
      this.checked = data.checked.map((part) => this.add(part, true));
      if (data.floor) this.floor(...data.floor);
      if (data.nearest) {
        const material = new T.MeshBasicMaterial({ color: RULER });
        this.ruler = new T.Mesh(new T.CylinderGeometry(1, 1, 1, 8), material);
        this.world.add(this.ruler);
      }
      const motion = data.motion;
      if (motion) {
        motion.values = whole(motion.poses);
        this.end = motion.frames.at(-1);
      }
    }
    add(part, checked = false) {
      const { T } = this, geometry = shape(T, part, this.data.meshes[part.m], this.extent), opacity = part.o ?? 1;
      let made;
      if (part.k === "points") {
        const size = Math.max(part.s[0], 0.006 * this.extent);
        made = new T.Points(geometry, new T.PointsMaterial({ color: part.c, size, transparent: true, opacity: 0.8 }));
      } else {
        const material = new T.MeshLambertMaterial({ color: part.c, opacity, transparent: opacity < 1 });
        if (part.k === "mesh") material.side = T.DoubleSide;
        if (opacity < 1) material.depthWrite = false;
        made = new T.Mesh(geometry, material);
      }
      if (part.p) {
        made.position.set(...part.p.slice(0, 3));
        made.quaternion.set(...part.p.slice(3));
      }
      made.visible = !checked;
      this.nodes[part.n].add(made);
      if (part.b !== undefined) {
        made.userData.tone = made.material.color.clone();
        this.bodies.set(part.b, [...(this.bodies.get(part.b) ?? []), made]);
      }
      return made;
    }
    floor(height, cell, x0, y0, x1, y1) {
      const { T } = this, ends = [], m = Math.round((x1 - x0) / cell), n = Math.round((y1 - y0) / cell);
      for (let k = 0; k <= m; k++) ends.push(x0 + k * cell, y0, height, x0 + k * cell, y1, height);
      for (let k = 0; k <= n; k++) ends.push(x0, y0 + k * cell, height, x1, y0 + k * cell, height);
      const lines = new T.BufferGeometry();
      lines.setAttribute("position", new T.Float32BufferAttribute(ends, 3));
      const material = new T.LineBasicMaterial({ color: 0x8a9299, transparent: true, opacity: 0.7 });
      this.world.add(new T.LineSegments(lines, material));
    }

    /* the view */
    home() {
      const { T, data } = this, arm = new T.Vector3(...data.eye).sub(new T.Vector3(...data.target));
      this.target = new T.Vector3(...data.target);
      this.far = arm.length();
      this.turn = Math.atan2(arm.y, arm.x);
      this.rise = Math.asin(arm.z / this.far);
      this.ask();
    }
    rotate(across, up) {
      this.turn += across;
      this.rise = Math.min(1.5, Math.max(-1.5, this.rise + up));
      this.ask();
    }
    zoom(factor) {
      this.far = Math.min(8 * this.extent, Math.max(0.08 * this.extent, this.far * factor));
      this.ask();
    }
    pan(dx, dy) {
      const { T } = this, scale = (2 * this.far * Math.tan((this.data.field * Math.PI) / 360)) / this.box.clientHeight;
      const right = new T.Vector3(), up = new T.Vector3();
      this.camera.matrix.extractBasis(right, up, new T.Vector3());
      this.target.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
      this.ask();
    }
    ask() {
      if (!this.asked && this.canvas.isConnected) {
        this.asked = true;
        requestAnimationFrame((now) => this.tick(now));
      }
    }
    tick(now) {
      this.asked = false;
      if (this.playing) {
        const motion = this.data.motion, passed = Math.min(0.1, (now - (this.last ?? now)) / 1000);
        this.time += passed * motion.fps * this.speed;
        if (this.time > this.end) this.time = this.time > this.end + 0.6 * motion.fps * this.speed ? 0 : this.time;
        this.ask();
      }
      this.last = now;
      this.show();
    }

    /* one moment */
    show() {
      const { T, data } = this, at = Math.min(this.time, this.end ?? 0);
      let from = 0, share = 0;
      if (data.motion) {
        const frames = data.motion.frames;
        while (from + 2 < frames.length && frames[from + 1] <= at) from++;
        share = Math.min(1, Math.max(0, (at - frames[from]) / (frames[from + 1] - frames[from])));
        this.pose(from, share);
      }
      if (data.nearest) this.nearest(from, share);
      const c = Math.cos(this.rise), far = this.far;
      this.camera.position.set(c * Math.cos(this.turn), c * Math.sin(this.turn), Math.sin(this.rise))
        .multiplyScalar(far).add(this.target);
      this.camera.lookAt(this.target);
      this.camera.near = 0.01 * far;
      this.camera.far = 20 * far;
      const width = this.box.clientWidth, height = this.box.clientHeight;
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();
      this.lamp.position.set(-0.45, 0.7, 0.55).applyQuaternion(this.camera.quaternion).add(this.target);
      this.lamp.target.position.copy(this.target);
      this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
      this.renderer.setSize(width, height, false);
      this.renderer.render(this.world, this.camera);
      this.taken = [];
      data.marks.forEach(([, node, ...point], k) => {
        this.nodes[node].updateMatrixWorld();
        this.place(this.marks[k], new T.Vector3(...point).applyMatrix4(this.nodes[node].matrixWorld));
      });
      this.told(at);
    }
    pose(from, share) {
      const { T } = this, { nodes, values, reach, frames } = this.data.motion, count = frames.length;
      const a = new T.Quaternion(), b = new T.Quaternion();
      nodes.forEach((node, k) => {
        const i = 7 * (k * count + from), j = i + 7, object = this.nodes[node];
        const mix = (n) => reach * (values[i + n] * (1 - share) + values[j + n] * share);
        object.position.set(mix(0), mix(1), mix(2));
        a.fromArray(values, i + 3).normalize();
        b.fromArray(values, j + 3).normalize();
        object.quaternion.copy(a.slerp(b, share));
      });
    }
    nearest(from, share) {
      const { T } = this, { mm, ends, which, names, contacts } = this.data.nearest;
      const last = Math.min(from + 1, mm.length - 1), k = share < 0.5 ? from : last;
      const smooth = which[from] === which[last], w = smooth ? share : k === last ? 1 : 0;
      const mix = (n) => ends[6 * from + n] * (1 - w) + ends[6 * last + n] * w;
      const a = new T.Vector3(mix(0), mix(1), mix(2)), b = new T.Vector3(mix(3), mix(4), mix(5));
      this.value = mm[from] * (1 - w) + mm[last] * w;
      this.pair = names[which[k]];
      const along = b.clone().sub(a), length = along.length(), thick = 0.0022 * this.extent;
      this.ruler.position.copy(a).add(b).multiplyScalar(0.5);
      this.ruler.scale.set(thick, Math.max(length, 1e-4), thick);
      if (length > 1e-6) this.ruler.quaternion.setFromUnitVectors(new T.Vector3(0, 1, 0), along.divideScalar(length));
      this.middle = this.ruler.position;
      const hit = new Set(contacts[k]);
      for (const [body, parts] of this.bodies)
        for (const part of parts)
          hit.has(body) ? part.material.color.set(CONTACT) : part.material.color.copy(part.userData.tone);
    }
    place(span, point) {
      const seen = point.clone().project(this.camera);
      /* A name that would cover another one stands lower. */
      const { clientWidth: wide, clientHeight: high } = this.box, half = span.offsetWidth / 2, line = 18;
      const x = (wide * (1 + seen.x)) / 2;
      let y = (high * (1 - seen.y)) / 2;
      if (span !== this.gap) {
        while (this.taken.some(([a, b, c]) => Math.abs(x - a) < half + b && Math.abs(y - c) < line)) y += line / 2;
        this.taken.push([x, half, y]);
      }
      span.style.left = `${x}px`;
      span.style.top = `${y}px`;
      span.hidden = Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1 || seen.z > 1;
    }
    told(at) {
      if (this.data.nearest) {
        const text = `${this.value.toFixed(Math.abs(this.value) < 10 ? 1 : 0)} mm`;
        this.gap.textContent = text;
        this.gap.classList.toggle("touching", this.value <= 0);
        this.place(this.gap, this.middle);
        const [one, other] = this.pair;
        const words = this.value > 0 ? `${text} apart` : `overlap by ${text.replace("-", "")}`;
        this.readout.textContent = `closest: ${one} – ${other}, ${words}`;
        this.readout.classList.toggle("touching", this.value <= 0);
      }
      if (!this.data.motion) return;
      const step = Math.round(at);
      this.slider.value = at;
      this.slider.setAttribute("aria-valuetext", `step ${step} of ${this.end}`);
      this.step.textContent = `${step} / ${this.end}`;
    }

    /* what the reader handles */
    controls() {
      const bar = el("div", { class: "scene-bar", role: "group", "aria-label": `Controls of: ${this.data.title}` });
      const button = (text, label, act) => {
        const made = el("button", { type: "button", "aria-label": label, title: label }, text);
        made.onclick = act;
        return made;
      };
      if (this.data.motion) {
        this.button = button("▶", "Play", () => this.play(!this.playing));
        this.slider = el("input", { type: "range", min: 0, max: this.end, step: "any", value: 0, "aria-label": "Time" });
        this.slider.oninput = () => {
          this.play(false);
          this.time = Number(this.slider.value);
          this.ask();
        };
        const track = el("div", { class: "scene-track" });
        if (this.data.nearest) track.append(this.curve());
        track.append(this.slider);
        this.step = el("output", { class: "scene-step", "aria-live": "off" });
        const speed = el("select", { "aria-label": "Speed", title: "Speed" });
        for (const value of SPEEDS) speed.append(el("option", { value }, `${value} ×`));
        speed.value = "1";
        speed.onchange = () => (this.speed = Number(speed.value));
        bar.append(this.button, track, this.step, speed);
      }
      bar.append(
        button("+", "Zoom in", () => this.zoom(0.8)),
        button("−", "Zoom out", () => this.zoom(1.25)),
        button("⟲", "First view", () => this.home()),
      );
      if (this.checked.length) {
        const tick = el("input", { type: "checkbox" });
        tick.onchange = () => {
          for (const part of this.checked) part.visible = tick.checked;
          this.ask();
        };
        bar.append(el("label", { class: "scene-check", title: "The bodies with which distances are computed" }, tick, "checked bodies"));
      }
      this.readout = el("output", { class: "scene-readout", "aria-live": "off" });
      this.bar = el("div", { class: "scene-controls" }, bar, this.readout);
      this.box.after(this.bar);
    }
    curve() {
      const { mm } = this.data.nearest, { frames } = this.data.motion;
      const high = Math.max(...mm, 1), low = Math.min(...mm, 0), y = (v) => 22 - (20 * (v - low)) / (high - low);
      const points = mm.map((v, k) => `${(100 * frames[k]) / this.end},${y(v).toFixed(2)}`);
      const box = document.createElement("span");
      box.className = "scene-curve";
      box.innerHTML =
        `<svg viewBox="0 0 100 24" preserveAspectRatio="none" role="img" aria-label="Smallest distance over time, ` +
        `${Math.min(...mm).toFixed(0)} to ${Math.max(...mm).toFixed(0)} mm"><path class="zero" d="M0 ${y(0)}H100"/>` +
        `<polyline points="${points.join(" ")}"/></svg>`;
      box.title = "Smallest distance over time; the line is contact";
      return box;
    }
    play(on) {
      if (!this.data.motion) return;
      if (on && this.time >= this.end) this.time = 0;
      this.playing = on;
      this.last = undefined;
      this.button.textContent = on ? "❚❚" : "▶";
      this.button.setAttribute("aria-label", on ? "Pause" : "Play");
      this.button.title = on ? "Pause" : "Play";
      this.ask();
    }
    listen() {
      const pointers = new Map();
      const canvas = this.canvas;
      canvas.onpointerdown = (event) => {
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, [event.clientX, event.clientY]);
        canvas.focus({ preventScroll: true });
      };
      canvas.onpointerup = canvas.onpointercancel = (event) => pointers.delete(event.pointerId);
      canvas.onpointermove = (event) => {
        const before = pointers.get(event.pointerId);
        if (!before) return;
        const dx = event.clientX - before[0], dy = event.clientY - before[1];
        if (pointers.size === 2) {
          const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
          const length = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
          this.zoom(length(before) / length([event.clientX, event.clientY]));
        } else if (event.shiftKey || event.buttons === 2) this.pan(dx, dy);
        else this.rotate(-0.008 * dx, 0.008 * dy);
        pointers.set(event.pointerId, [event.clientX, event.clientY]);
      };
      canvas.oncontextmenu = (event) => event.preventDefault();
      canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey && !event.metaKey && document.activeElement !== canvas) return;
        event.preventDefault();
        this.zoom(Math.exp(0.0015 * event.deltaY));
      }, { passive: false });
      canvas.onkeydown = (event) => {
        const act = {
          ArrowLeft: () => this.rotate(-0.1, 0), ArrowRight: () => this.rotate(0.1, 0),
          ArrowUp: () => this.rotate(0, 0.1), ArrowDown: () => this.rotate(0, -0.1),
          "+": () => this.zoom(0.85), "=": () => this.zoom(0.85), "-": () => this.zoom(1.18),
          Home: () => this.home(), " ": () => this.play(!this.playing),
        }[event.key];
        if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        act();
      };
      this.watch = new ResizeObserver(() => this.ask());
      this.watch.observe(this.box);
      this.sight = new IntersectionObserver(([seen]) => {
        if (!seen.isIntersecting && this.playing) [this.paused, this.playing] = [true, false];
        else if (seen.isIntersecting && this.paused) {
          this.paused = false;
          this.play(true);
        }
      });
      this.sight.observe(this.box);
    }
    close() {
      this.playing = false;
      this.watch.disconnect();
      this.sight.disconnect();
      this.renderer.dispose();
      this.renderer.forceContextLoss();
      this.canvas.remove();
      this.marks.forEach((span, k) => (span.style.cssText = this.still[k]));
      this.bar.remove();
      this.gap.remove();
      this.figure.classList.remove("live");
      invite(this.figure);
    }
  }

  /* ---- the page -------------------------------------------------------------------------- */
  /* On paper names stand where the still picture has them. */
  addEventListener("beforeprint", () => alive.forEach((scene) => scene.marks.forEach((span, k) => (span.style.cssText = scene.still[k]))));
  addEventListener("afterprint", () => alive.forEach((scene) => scene.show()));
  async function start(figure, button) {
    const focused = document.activeElement === button;
    button.disabled = true;
    try {
      const T = await viewer();
      if (alive.length >= ALIVE) alive.shift().close();
      figure.scene = new Scene(figure, T);
      alive.push(figure.scene);
      button.remove();
      if (focused) figure.scene.canvas.focus({ preventScroll: true });
    } catch (error) {
      button.replaceWith(el("p", { class: "scene-sorry", role: "status" },
        "This browser draws no 3-D (WebGL); the picture shows the scene."));
    }
  }
  function invite(figure) {
    const text = figure.dataset.moves === "yes" ? "▶ Play in 3-D" : "Turn in 3-D";
    const title = figure.querySelector(".scene-still").alt;
    const button = el("button", { type: "button", class: "scene-start", "aria-label": `${text.replace("▶ ", "")}: ${title}` }, text);
    button.onclick = () => start(figure, button);
    figure.querySelector(".scene-box").append(button);
    return button;
  }
  const ready = () => {
    for (const figure of document.querySelectorAll(".ledger-scene")) {
      if (figure.querySelector(".scene-start") || figure.scene) continue;
      const button = invite(figure);
      if (document.body.classList.contains("scene-alone")) start(figure, button);
    }
  };
  document.readyState === "loading" ? document.addEventListener("DOMContentLoaded", ready) : ready();
})();
