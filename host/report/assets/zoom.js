// Looking closer: drag, wheel and keys change what part of a plot is seen; the pointer reads values off it.
const Zoom = (() => {
  const least = 4;  // px: a shorter drag is a click

  function attach(plot, group) {
    const { svg } = plot;
    const ownPixel = (event) => {
      const box = svg.getBoundingClientRect();
      const factor = plot.box.width / box.width;
      return [(event.clientX - box.left) * factor, (event.clientY - box.top) * factor];
    };
    let start = null;
    svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.pointerType === "touch") return;
      start = ownPixel(event);
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => {
      const at = ownPixel(event);
      if (start) select(plot, start, at);
      else read(plot, at, group);
    });
    svg.addEventListener("pointerup", (event) => {
      if (!start) return;
      const area = dragged(plot, start, ownPixel(event));
      start = null;
      plot.hideCross();
      if (area) look(plot, group, area.x, area.y);
    });
    svg.addEventListener("pointerleave", () => { if (!start) group.forEach((other) => other.hideCross()); });
    svg.addEventListener("dblclick", () => look(plot, group, null, null, true));
    svg.addEventListener("wheel", (event) => {
      // Only once the plot was clicked: a wheel over it otherwise scrolls the page.
      if (!event.ctrlKey && document.activeElement !== svg) return;
      event.preventDefault();
      const [px, py] = ownPixel(event);
      const factor = Math.exp(event.deltaY * 0.002);
      if (event.shiftKey) look(plot, group, undefined, around(plot.sy, py, factor));
      else look(plot, group, around(plot.sx, px, factor), undefined);
    }, { passive: false });
    svg.addEventListener("keydown", (event) => {
      const { left, right } = plot.box;
      const middle = (left + right) / 2, far = (right - left) / 4;
      const actions = {
        "+": () => look(plot, group, around(plot.sx, middle, 0.7)), "=": () => look(plot, group, around(plot.sx, middle, 0.7)),
        "-": () => look(plot, group, around(plot.sx, middle, 1 / 0.7)),
        ArrowLeft: () => look(plot, group, moved(plot.sx, -far)), ArrowRight: () => look(plot, group, moved(plot.sx, far)),
        Escape: () => look(plot, group, null, null, true), 0: () => look(plot, group, null, null, true),
      };
      if (!actions[event.key]) return;
      event.preventDefault();
      actions[event.key]();
    });
  }

  // The range seen after zooming by a factor around a pixel; moved by pixels.
  function around(scale, pixel, factor) {
    return scale.pixels.map((end) => scale.invert(pixel + (end - pixel) * factor));
  }
  function moved(scale, by) { return scale.pixels.map((end) => scale.invert(end + by)); }

  // undefined leaves a range as it is, null goes back to everything.
  function look(plot, group, x, y, reset = false) {
    if (y !== undefined || reset) plot.view.y = y ?? null;
    for (const other of group) {
      if (x !== undefined) other.view.x = x;
      if (reset) other.view.y = null;
      other.draw();
    }
  }

  // The ranges under a drag: x only where it is flat, y only where it is upright.
  function dragged(plot, [ax, ay], [bx, by]) {
    const wide = Math.abs(bx - ax), tall = Math.abs(by - ay);
    if (wide < least && tall < least) return null;
    const { left, right, top, bottom } = plot.box;
    const within = (v, a, b) => Math.max(a, Math.min(b, v));
    const range = (scale, a, b) => [scale.invert(a), scale.invert(b)].sort((p, q) => p - q);
    const x = range(plot.sx, within(ax, left, right), within(bx, left, right));
    const y = range(plot.sy, within(ay, top, bottom), within(by, top, bottom));
    if (tall < 14 || tall < 0.12 * wide) return { x };
    if (wide < 14 || wide < 0.12 * tall) return { y };
    return { x, y };
  }

  function select(plot, start, at) {
    const area = dragged(plot, start, at);
    plot.readOut.hidden = true;
    if (!area) { plot.overlay.innerHTML = ""; return; }
    const { left, right, top, bottom } = plot.box;
    const [x0, x1] = area.x ? area.x.map(plot.sx) : [left, right];
    const [y0, y1] = area.y ? area.y.map(plot.sy).sort((a, b) => a - b) : [top, bottom];
    plot.overlay.innerHTML = `<rect class="selection" x="${x0}" y="${y0}" width="${x1 - x0}" height="${y1 - y0}"/>`;
  }

  function interpolate(one, x) {
    if (x < one.x[0] || x > one.x[one.x.length - 1]) return NaN;
    const at = Data.lowerBound(one.x, x);
    if (one.x[at] === x || at === 0) return one.y[at];
    if (one.mark === "step") return one.y[at - 1];
    return one.y[at - 1] + (one.y[at] - one.y[at - 1]) * (x - one.x[at - 1]) / (one.x[at] - one.x[at - 1]);
  }

  function row(one, text) {
    return `<div class="row"><span class="name"><i style="background:${one.colour}"></i>${escapeText(one.name || "value")}</span><span>${text}</span></div>`;
  }
  const shown = (axis, value) => Scale.number(value) + (axis.unit ? "\u2009" + escapeText(axis.unit) : "");

  function read(plot, [px, py], group) {
    const { left, right, top, bottom } = plot.box;
    if (px < left || px > right || py < top || py > bottom) { group.forEach((other) => other.hideCross()); return; }
    if (plot.map) readMap(plot, px, py);
    else if (plot.spec.x.categories || plot.flipped) readBars(plot, px, py);
    else if (plot.series.every((s) => s.sorted)) for (const other of group) readAt(other, plot.sx.invert(px), other === plot);
    else readNearest(plot, px, py);
  }

  function readAt(plot, x, owner) {
    const { spec, sx, sy, box } = plot;
    const px = sx(x);
    if (!(px >= box.left && px <= box.right)) { plot.hideCross(); return; }
    let rows = "", marks = "";
    for (const one of plot.shownSeries()) {
      if (!one.x.length) continue;
      let at = x, value, text;
      if (one.mark === "points" || one.mark === "bars") {
        const k = Data.nearest(one.x, x);
        if (Math.abs(sx(one.x[k]) - px) > 14) continue;
        at = one.x[k];
        value = one.y[k];
        text = shown(spec.y, value) + (one.low ? ` [${Scale.number(one.low[k])}, ${Scale.number(one.high[k])}]` : "");
      } else if (one.mark === "band") {
        const k = Data.nearest(one.x, x);
        rows += row(one, `${Scale.number(one.low[k])} \u2026 ${shown(spec.y, one.high[k])}`);
        continue;
      } else {
        value = interpolate(one, x);
        if (Number.isNaN(value)) continue;
        text = shown(spec.y, value);
      }
      rows += row(one, text);
      marks += `<circle cx="${sx(at)}" cy="${sy(value)}" r="3.5" fill="${one.colour}" stroke="#fff"/>`;
    }
    plot.overlay.innerHTML = `<line class="cross" x1="${px}" x2="${px}" y1="${box.top}" y2="${box.bottom}"/>${marks}`;
    show(plot, owner && rows ? `<div class="row"><span class="name">${escapeText((plot.group.find((p) => p.spec.x.label) || plot).spec.x.label || "x")}</span><span>${shown(spec.x, x)}</span></div>${rows}` : rows, px);
  }

  function readNearest(plot, px, py) {
    let best = null, nearest = 30 * 30;
    for (const one of plot.shownSeries()) {
      for (let i = 0; i < one.x.length; ++i) {
        const d = (plot.sx(one.x[i]) - px) ** 2 + (plot.sy(one.y[i]) - py) ** 2;
        if (d < nearest) { nearest = d; best = { one, i }; }
      }
    }
    if (!best) { plot.hideCross(); return; }
    const { one, i } = best;
    plot.overlay.innerHTML = `<circle cx="${plot.sx(one.x[i])}" cy="${plot.sy(one.y[i])}" r="4" fill="${one.colour}" stroke="#fff"/>`;
    show(plot, row(one, `${shown(plot.spec.x, one.x[i])}, ${shown(plot.spec.y, one.y[i])}`), px);
  }

  function readBars(plot, px, py) {
    const axis = plot.flipped ? plot.spec.y : plot.spec.x;
    const value = plot.flipped ? plot.spec.x : plot.spec.y;
    const slot = Math.round(plot.flipped ? plot.sy.invert(py) : plot.sx.invert(px));
    let rows = "";
    for (const one of plot.shownSeries()) {
      const places = plot.flipped ? one.y : one.x;
      const k = Array.from(places).findIndex((v) => Math.round(v) === slot);
      if (k < 0) continue;
      const bounds = one.low ? ` [${Scale.number(one.low[k])}, ${Scale.number(one.high[k])}]` : "";
      rows += row(one, shown(value, (plot.flipped ? one.x : one.y)[k]) + bounds);
    }
    plot.overlay.innerHTML = "";
    show(plot, rows && `<div class="name">${escapeText(axis.categories[slot] || "")}</div>${rows}`, px);
  }

  function readMap(plot, px, py) {
    const { map, spec } = plot;
    const x = plot.sx.invert(px), y = plot.sy.invert(py);
    const column = Math.floor((x - map.x[0]) / (map.x[1] - map.x[0]) * map.columns);
    const line = Math.floor((y - map.y[0]) / (map.y[1] - map.y[0]) * map.rows);
    if (column < 0 || line < 0 || column >= map.columns || line >= map.rows) { plot.hideCross(); return; }
    const entry = (name, text) => `<div class="row"><span class="name">${escapeText(name)}</span><span>${text}</span></div>`;
    show(plot, entry(spec.x.label, shown(spec.x, x)) + entry(spec.y.label, shown(spec.y, y)) + entry(map.name, shown(map, map.values[line * map.columns + column])), px);
  }

  function show(plot, html, px) {
    plot.readOut.hidden = !html;
    if (!html) return;
    plot.readOut.innerHTML = html;
    const factor = plot.svg.getBoundingClientRect().width / plot.box.width;
    const wide = plot.readOut.offsetWidth;
    const right = px * factor + 14;
    plot.readOut.style.left = `${right + wide > plot.area.clientWidth ? Math.max(0, px * factor - 14 - wide) : right}px`;
    plot.readOut.style.top = `${plot.box.top * factor + 4}px`;
  }

  return { attach };
})();
