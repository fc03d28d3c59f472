/* Slices: a pointer that reads values out, sliders for gains, layers of a map. The drawing is in the page. */
(() => {
  "use strict";
  const SVG = "http://www.w3.org/2000/svg";
  const el = (tag, attributes = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  };
  const drawn = (tag, attributes) => {
    const made = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    return made;
  };
  const short = (value) => String(Number(value.toPrecision(4))).replace("-", "−");
  const pixel = ([low, high, start, end], value) => start + ((value - low) / (high - low)) * (end - start);
  const value = ([low, high, start, end], place) => low + ((place - start) / (end - start)) * (high - low);
  const bare = (label) => label.replace(/\s*\[.*\]/, "");
  const unit = (label) => (label.match(/\[(.*)\]/) ?? ["", ""])[1];
  const within = (svg, event) => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [point.x, point.y];
  };
  /* A drawing that can be pointed at with the mouse, a finger or the arrow keys. */
  function pointed(svg, label, move, step) {
    svg.setAttribute("tabindex", "0");
    svg.setAttribute("aria-label", `${svg.getAttribute("aria-label")} ${label}`);
    svg.addEventListener("pointermove", (event) => move(...within(svg, event)));
    svg.addEventListener("pointerdown", (event) => move(...within(svg, event)));
    svg.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way) return;
      event.preventDefault();
      step(...way, event.shiftKey ? 10 : 1);
    });
  }

  function curves(figure, data, svg, box) {
    const [across, up] = data.axes, gains = { ...data.gains };
    const lines = [...figure.querySelectorAll(".slice-curve")], circles = [...figure.querySelectorAll(".slice-minima")];
    const pointer = figure.querySelector(".slice-pointer"), line = pointer.querySelector("line");
    const readout = el("output", { class: "slice-readout" }, "Point at the drawing, or use the arrow keys.");
    const dots = lines.map((one) => pointer.appendChild(drawn("circle", { r: 4, fill: one.getAttribute("stroke") })));
    const heights = () => data.curves.map(({ terms }) => data.x.map((_, k) =>
      Object.entries(terms).reduce((sum, [name, row]) => sum + (gains[name] ?? 1) * row[k], 0)));
    let now = heights(), at = null;
    const low = (row) => row.flatMap((v, k) => (k && k + 1 < row.length && v < row[k - 1] && v <= row[k + 1] ? [k] : []));
    const draw = () => {
      now = heights();
      now.forEach((row, c) => {
        const points = row.map((v, k) => [pixel(across, data.x[k]).toFixed(1), pixel(up, v).toFixed(1)]);
        lines[c].setAttribute("points", points.map((p) => p.join(",")).join(" "));
        if (data.minima) circles[c].replaceChildren(...low(row).map((k) => drawn("circle", { cx: points[k][0], cy: points[k][1], r: 6 })));
      });
      if (at !== null) show(at);
    };
    const show = (k) => {
      at = Math.min(data.x.length - 1, Math.max(0, k));
      const x = pixel(across, data.x[at]);
      pointer.setAttribute("visibility", "visible");
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
      dots.forEach((dot, c) => {
        const y = pixel(up, now[c][at]);
        dot.setAttribute("cx", x);
        dot.setAttribute("cy", y);
        dot.setAttribute("visibility", y < up[3] || y > up[2] ? "hidden" : "inherit");
      });
      const [a, b] = data.labels, tail = data.names ? `; ${data.names[at]}` : "";
      readout.textContent = `${[bare(a), short(data.x[at]), unit(a)].join(" ").trim()}: ` +
        now.map((row, c) => [data.curves[c].name, short(row[at]), unit(b)].join(" ").trim()).join(", ") + tail;
    };
    const nearest = (x) => data.x.reduce((best, v, k) => (Math.abs(v - x) < Math.abs(data.x[best] - x) ? k : best), 0);
    pointed(svg, "Arrow keys read values out.", (x) => show(nearest(value(across, x))),
      (dx, dy, times) => show((at ?? -1) + (dx || dy) * times));
    for (const [name, start] of Object.entries(gains)) {
      const text = el("output", {}, short(start));
      const slider = el("input", { type: "range", min: 0, max: 3 * start, step: start / 50, value: start, "aria-label": `Gain of ${name}` });
      slider.oninput = () => {
        gains[name] = Number(slider.value);
        text.textContent = short(gains[name]);
        draw();
      };
      box.append(el("label", {}, `${name} × `, slider, text));
    }
    box.append(readout);
  }

  function map(figure, data, svg, box, ordered) {
    const [across, up] = data.axes, [x0, x1, columns] = data.x, [y0, y1, rows] = data.y, [low, high] = data.range;
    const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const table = bytes(data.colors), cells = data.layers.map((layer) => bytes(layer.v));
    const picture = figure.querySelector(".slice-picture"), marks = figure.querySelector(".slice-marks");
    const pointer = figure.querySelector(".slice-pointer"), words = figure.querySelector(".slice-layer");
    const readout = el("output", { class: "slice-readout" }, "Point at the map, or use the arrow keys.");
    let layer = data.shown, at = null;
    const image = (k) => {
      const canvas = el("canvas", { width: columns, height: rows }), context = canvas.getContext("2d");
      const pixels = context.createImageData(columns, rows);
      cells[k].forEach((v, n) => v !== 255 && pixels.data.set([...table.slice(3 * v, 3 * v + 3), 255], 4 * n));
      context.putImageData(pixels, 0, 0);
      return canvas.toDataURL();
    };
    const choose = (k) => {
      layer = k;
      picture.setAttribute("href", image(k));
      words.textContent = `Shown: ${data.layers[k].name}.`;
      marks.replaceChildren(...data.layers[k].marks.flatMap(([name, x, y]) => {
        const text = drawn("text", { x: x + 9, y: y + 4, fill: "#111", stroke: "#fff" });
        text.textContent = name;
        return [drawn("circle", { cx: x, cy: y, r: 5, fill: "#d55e00", stroke: "#fff", "stroke-width": 1.5 }), text];
      }));
      if (at) show(...at);
    };
    const show = (i, j) => {
      at = [Math.min(columns - 1, Math.max(0, i)), Math.min(rows - 1, Math.max(0, j))];
      const x = x0 + (at[0] / (columns - 1)) * (x1 - x0), y = y0 + (at[1] / (rows - 1)) * (y1 - y0);
      const cell = cells[layer][(rows - 1 - at[1]) * columns + at[0]], [a, b, c] = data.labels;
      pointer.setAttribute("visibility", "visible");
      pointer.setAttribute("transform", `translate(${pixel(across, x)} ${pixel(up, y)})`);
      const told = cell === 255 ? data.nothing : `${bare(c)} ${short(low + (cell / 254) * (high - low))} ${unit(c)}`.trim();
      readout.textContent = `${bare(a)} ${x.toFixed(3)}, ${bare(b)} ${y.toFixed(3)} ${unit(b)}, ${data.layers[layer].name}: ${told}`;
    };
    const index = (v, from, to, count) => Math.round(((v - from) / (to - from)) * (count - 1));
    pointed(svg, "Arrow keys read values out.",
      (x, y) => {
        const [a, b] = [value(across, x), value(up, y)];
        if (a >= across[0] && a <= across[1] && b >= up[0] && b <= up[1]) show(index(a, x0, x1, columns), index(b, y0, y1, rows));
      },
      (dx, dy, times) => show((at?.[0] ?? columns >> 1) + dx * times, (at?.[1] ?? rows >> 1) + dy * times));
    if (data.layers.length > 1 && ordered) {
      const text = el("output", {}, data.layers[layer].name);
      const slider = el("input", { type: "range", min: 0, max: data.layers.length - 1, value: layer, "aria-label": "Layer" });
      slider.oninput = () => {
        choose(Number(slider.value));
        text.textContent = data.layers[layer].name;
        slider.setAttribute("aria-valuetext", data.layers[layer].name);
      };
      box.append(el("label", {}, slider, text));
    } else if (data.layers.length > 1) {
      const group = `slice-${Math.random().toString(36).slice(2)}`;
      data.layers.forEach(({ name }, k) => {
        const tick = el("input", { type: "radio", name: group, value: k });
        tick.checked = k === layer;
        tick.onchange = () => choose(k);
        box.append(el("label", {}, tick, name));
      });
    }
    box.append(readout);
  }

  const ready = () => {
    for (const figure of document.querySelectorAll(".ledger-slice:not(.live)")) {
      const store = figure.querySelector(".slice-data"), data = JSON.parse(store.textContent);
      const box = el("div", { class: "slice-controls", role: "group", "aria-label": "Controls of the slice" });
      const svg = figure.querySelector("svg");
      figure.classList.add("live");
      figure.querySelector(".slice-scroll").after(box);
      if (figure.dataset.kind === "curves") curves(figure, data, svg, box);
      else map(figure, data, svg, box, store.dataset.ordered === "yes");
    }
  };
  document.readyState === "loading" ? document.addEventListener("DOMContentLoaded", ready) : ready();
})();
