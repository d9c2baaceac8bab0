// One plot: its series, what part of them is looked at, and its drawing.
const colours = {
  measured: "#1c2430", reference: "#8a939e", model: "#0072b2", other_model: "#d55e00", truth: "#009e73",
  warning: "#b3245a", under: "#b4bdc7", fourth: "#8055a8", muted: "#b9c0c8",
};
const freeColours = ["#0072b2", "#d55e00", "#009e73", "#b3579a", "#c78a00", "#3f9fd6", "#1c2430", "#7a828c"];
const escapeText = (text) => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const withUnit = (axis) => (axis.unit ? `${axis.label} (${axis.unit})` : axis.label);

class Plot {
  constructor(figure, spec, arrays, number) {
    this.figure = figure;
    this.area = figure.querySelector(".area");
    this.spec = spec;
    this.number = number;
    this.flipped = Boolean(spec.y.categories);
    this.group = [this];
    let next = 0;
    this.series = spec.series.map((one) => {
      const out = { ...one, x: arrays(one.x), y: arrays(one.y), low: arrays(one.low), high: arrays(one.high) };
      if (out.y === undefined) out.y = out.low.map((v, i) => (v + out.high[i]) / 2);
      out.colour = colours[one.colour] || freeColours[next++ % freeColours.length];
      out.shown = one.shown !== false;
      out.sorted = !this.flipped && Data.isSorted(out.x);
      return out;
    });
    this.placeBars();
    // Under a model's line the measured one is drawn broad and pale, so that both are seen where they agree.
    const lines = this.series.filter((s) => (s.mark === "line" || s.mark === "step") && s.colour !== colours.reference);
    for (const one of lines) if (one.colour === colours.measured && lines.length > 1) Object.assign(one, { colour: colours.under, broad: true });
    if (spec.heat_map) {
      const map = (this.map = { ...spec.heat_map, values: arrays(spec.heat_map.values) });
      let [least, greatest] = Data.range(map.values);
      if (map.diverging) least = -(greatest = Math.max(Math.abs(least), Math.abs(greatest)));
      map.limits = [map.least ?? least, map.greatest ?? greatest];
      if (!(map.limits[0] < map.limits[1])) map.limits = [map.limits[0] - 1, map.limits[0] + 1];
      map.picture = Marks.picture(map);
    }
    this.view = { x: null, y: null };
    this.area.innerHTML = `<svg role="img" tabindex="0"><g class="content"></g><g class="overlay"></g></svg><div class="read-out" hidden></div><span class="hint">drag to zoom \u00b7 click, then wheel \u00b7 double-click to reset</span>`;
    this.svg = this.area.querySelector("svg");
    this.svg.setAttribute("aria-label", [spec.title, `${withUnit(spec.y)} against ${withUnit(spec.x)}`].filter(Boolean).join(": "));
    this.content = this.svg.querySelector(".content");
    this.overlay = this.svg.querySelector(".overlay");
    this.readOut = this.area.querySelector(".read-out");
  }

  // Bars of several series stand side by side in their category.
  placeBars() {
    const categories = this.flipped || this.spec.x.categories;
    const beside = categories ? this.series.filter((s) => s.mark === "bars") : [];
    this.series.forEach((one) => {
      one.barWidth = one.width ?? 0.8;
      if (!categories) return;
      const at = beside.indexOf(one);
      const offset = at < 0 ? 0 : (0.8 / beside.length) * (at - (beside.length - 1) / 2);
      if (at >= 0) one.barWidth = 0.8 / beside.length;
      one.slot = (i) => (this.flipped ? one.y[i] : one.x[i]) + offset;
    });
  }

  shownSeries() { return this.series.filter((s) => s.shown); }

  fullRange(which) {
    const axis = this.spec[which];
    if (axis.categories) return [-0.5, axis.categories.length - 0.5];
    let least = Infinity, greatest = -Infinity;
    const take = (values, from, to) => {
      if (!values) return;
      const [a, b] = Data.range(values, from, to);
      if (axis.log && a <= 0) { for (const v of values) if (v > 0 && v < least) least = v; } else if (a < least) least = a;
      if (b > greatest) greatest = b;
    };
    for (const one of this.shownSeries()) {
      const inView = which === "y" && this.view.x && one.sorted;
      const from = inView ? Math.max(0, Data.lowerBound(one.x, this.view.x[0]) - 1) : 0;
      const to = inView ? Math.min(one.x.length, Data.lowerBound(one.x, this.view.x[1]) + 1) : one.x.length;
      take(one[which], from, to);
      const spreads = (which === "y") !== this.flipped;
      if (spreads) { take(one.low, from, to); take(one.high, from, to); }
      if (one.mark === "bars") {
        if (spreads && !axis.log) take([0], 0, 1);
        if (!spreads) take([least - one.barWidth / 2, greatest + one.barWidth / 2], 0, 2);
      }
    }
    if (this.map) take(this.map[which], 0, 2);
    for (const guide of this.spec.guides || []) if (guide.at === which) take([guide.value], 0, 1);
    const tight = this.map || (which === "x" && this.series.some((s) => s.mark !== "points" && s.mark !== "bars"));
    const [a, b] = tight && least < greatest ? [least, greatest] : Scale.pad([least, greatest], axis.log);
    return [axis.least ?? a, axis.greatest ?? b];
  }

  rows() {
    return { top: this.spec.y.label ? 21 : 8, bottom: this.spec.height - (this.spec.x.label ? 35 : 21) };
  }

  yTicks(range) {
    if (this.flipped) return this.categoryTicks(this.spec.y.categories, range);
    const { top, bottom } = this.rows();
    return Scale.ticks(range, Math.max(3, (bottom - top) / 38), this.spec.y.log);
  }

  // Room for the numbers on the left; plots that share an x axis take the widest, so that their axes line up.
  leftMargin() {
    const longest = Math.max(...this.yTicks(this.view.y || this.fullRange("y")).map((t) => t.text.length), 1);
    return 14 + (this.flipped ? 6.6 : 7.2) * longest;
  }

  draw(width = this.area.clientWidth) {
    if (width < 40) return;
    const { spec } = this;
    const height = spec.height;
    let x = this.view.x || this.fullRange("x");
    let y = this.view.y || this.fullRange("y");
    const { top, bottom } = this.rows();
    const right = width - (this.map ? 76 : 12);
    const yTicks = this.yTicks(y);
    const left = Math.min(width * 0.45, Math.max(...this.group.map((plot) => plot.leftMargin())));
    if (spec.square) [x, y] = this.squared(x, y, right - left, bottom - top);
    const xTicks = spec.x.categories ? this.categoryTicks(spec.x.categories, x) : Scale.ticks(x, (right - left) / 85, spec.x.log);
    const sx = (this.sx = Scale.make(x, [left, right], spec.x.log));
    const sy = (this.sy = Scale.make(y, this.flipped ? [top, bottom] : [bottom, top], spec.y.log));
    this.box = { left, right, top, bottom, width, height };
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.content.innerHTML = `<clipPath id="clip-${this.number}"><rect x="${left}" y="${top - 1}" width="${right - left}" height="${bottom - top + 2}"/></clipPath>` +
      this.axes(xTicks, yTicks) + `<g clip-path="url(#clip-${this.number})">${this.mapPicture()}${this.guideLines()}${this.shownSeries().map((s) => this.seriesPath(s, sx, sy)).join("")}</g>` +
      this.guideNames() + this.colourBar();
    this.hideCross();
  }

  squared(x, y, width, height) {
    const perX = (x[1] - x[0]) / width, perY = (y[1] - y[0]) / height;
    const widen = (range, factor) => [(range[0] + range[1]) / 2 - (range[1] - range[0]) / 2 * factor, (range[0] + range[1]) / 2 + (range[1] - range[0]) / 2 * factor];
    return perX > perY ? [x, widen(y, perX / perY)] : [widen(x, perY / perX), y];
  }

  categoryTicks(names, range) {
    return names.map((text, value) => ({ value, text })).filter((t) => t.value >= range[0] && t.value <= range[1]);
  }

  axes(xTicks, yTicks) {
    const { left, right, top, bottom, height } = this.box;
    const { spec, sx, sy } = this;
    let out = "";
    const line = (name, x1, y1, x2, y2) => `<line class="${name}" x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}"/>`;
    for (const tick of yTicks) {
      const at = Math.round(sy(tick.value)) + 0.5;
      if (!this.flipped) out += line(tick.value === 0 ? "zero" : "grid", left, at, right, at);
      out += `<text x="${left - 7}" y="${at + 3.5}" text-anchor="end">${escapeText(tick.text)}</text>`;
    }
    for (const tick of xTicks) {
      const at = Math.round(sx(tick.value)) + 0.5;
      if (!spec.x.categories) out += line(tick.value === 0 && this.flipped ? "zero" : "grid", at, top, at, bottom);
      const wide = (tick.text.length * 6.6) / 2;
      const anchor = spec.x.categories || (at - wide > 0 && at + wide < this.box.width) ? "middle" : at + wide >= this.box.width ? "end" : "start";
      out += `<text x="${anchor === "end" ? this.box.width - 2 : at}" y="${bottom + 15}" text-anchor="${anchor}">${escapeText(tick.text)}</text>`;
    }
    if (spec.y.label) out += `<text class="axis-label" x="0" y="12">${escapeText(withUnit(spec.y))}</text>`;
    if (spec.x.label) out += `<text class="axis-label" x="${right}" y="${height - 5}" text-anchor="end">${escapeText(withUnit(spec.x))}</text>`;
    return out + `<path class="frame" d="M${left + 0.5} ${top}V${bottom + 0.5}H${right}"/>`;
  }

  seriesPath(one, sx, sy) {
    const stroke = `fill="none" stroke="${one.colour}" stroke-linejoin="round"`;
    const dash = one.dashed ? ' stroke-dasharray="6 4"' : "";
    const errors = one.low && one.mark !== "band" ? `<path d="${Marks.errorBars(one, sx, sy, this.flipped)}" ${stroke} stroke-width="${one.mark === "bars" ? 1.6 : 1.2}"${one.mark === "bars" ? ' style="stroke:#1c2430"' : ""}/>` : "";
    switch (one.mark) {
      case "band": return `<path d="${Marks.band(one, sx, sy)}" fill="${one.colour}" fill-opacity="0.2"/>`;
      case "bars": return `<path d="${Marks.bars(one, sx, sy, this.flipped)}" fill="${one.colour}"/>` + errors;
      case "points": return errors + `<path d="${Marks.dots(one, sx, sy)}" ${stroke} stroke-linecap="round" stroke-width="${one.x.length > 400 ? 2.6 : 6}"/>`;
      default: return errors + `<path d="${Marks.path(one, sx, sy, one.mark === "step")}" ${stroke} stroke-width="${one.broad ? 4.5 : 1.5}"${one.broad ? ' stroke-linecap="round"' : ""}${dash}/>`;
    }
  }

  mapPicture() {
    if (!this.map) return "";
    const { map, sx, sy } = this;
    const x0 = sx(map.x[0]), x1 = sx(map.x[1]), y0 = sy(map.y[0]), y1 = sy(map.y[1]);
    return `<image href="${map.picture}" x="${x0}" y="${y1}" width="${x1 - x0}" height="${y0 - y1}" preserveAspectRatio="none" style="image-rendering:pixelated"/>`;
  }

  colourBar() {
    if (!this.map) return "";
    const { map, box } = this;
    const scale = Scale.make(map.limits, [box.bottom, box.top]);
    const steps = 48, tall = (box.bottom - box.top) / steps;
    let out = "";
    for (let k = 0; k < steps; ++k) out += `<rect x="${box.right + 12}" y="${box.bottom - (k + 1) * tall}" width="11" height="${tall + 0.4}" fill="rgb(${Marks.colourAt((k + 0.5) / steps, map.diverging)})"/>`;
    for (const tick of Scale.ticks(map.limits, (box.bottom - box.top) / 42)) out += `<text x="${box.right + 28}" y="${scale(tick.value) + 3.5}">${tick.text}</text>`;
    return out + `<text class="axis-label" x="${box.width}" y="12" text-anchor="end">${escapeText(map.unit ? `${map.name} (${map.unit})` : map.name)}</text>`;
  }

  guideLines() {
    const { left, right, top, bottom } = this.box;
    return (this.spec.guides || []).map((guide) => {
      const at = guide.at === "x" ? this.sx(guide.value) : this.sy(guide.value);
      return guide.at === "x" ? `<line class="guide" x1="${at}" x2="${at}" y1="${top}" y2="${bottom}"/>` : `<line class="guide" x1="${left}" x2="${right}" y1="${at}" y2="${at}"/>`;
    }).join("");
  }

  guideNames() {
    const { left, right, top, bottom } = this.box;
    return (this.spec.guides || []).map((guide) => {
      const at = guide.at === "x" ? this.sx(guide.value) : this.sy(guide.value);
      if (guide.at === "x" ? at < left || at > right : at < top || at > bottom) return "";
      const end = at > (left + right) / 2;
      return guide.at === "x" ? `<text class="guide-name" x="${at + (end ? -5 : 5)}" y="${top + 12}" text-anchor="${end ? "end" : "start"}">${escapeText(guide.name)}</text>`
        : `<text class="guide-name" x="${right - 4}" y="${at - 4}" text-anchor="end">${escapeText(guide.name)}</text>`;
    }).join("");
  }

  // A button for every named series; it acts on all plots that share the legend.
  static drawLegend(legend, plots) {
    const [first] = plots;
    if (first.series.filter((s) => s.name).length < 2) return;
    first.series.forEach((one, index) => {
      if (!one.name) return;
      const button = document.createElement("button");
      button.type = "button";
      button.title = "show or hide";
      const shape = { points: '<circle cx="9" cy="5" r="3.2"', bars: '<rect x="4" y="0" width="10" height="10"', band: '<rect x="1" y="1" width="16" height="8" fill-opacity="0.25"' }[one.mark];
      button.innerHTML = `<svg width="18" height="10" aria-hidden="true">${shape ? `${shape} fill="${one.colour}"/>` : `<path d="M0 5H18" stroke="${one.colour}" stroke-width="${one.broad ? 5 : 2.2}"${one.dashed ? ' stroke-dasharray="5 3"' : ""}/>`}</svg>${escapeText(one.name)}`;
      const show = () => button.setAttribute("aria-pressed", String(one.shown));
      button.addEventListener("click", () => {
        const shown = !one.shown;
        for (const plot of plots) plot.series[index].shown = shown;
        show();
        new Set(plots.flatMap((plot) => plot.group)).forEach((plot) => plot.draw());
      });
      show();
      legend.append(button);
    });
  }

  hideCross() {
    this.overlay.innerHTML = "";
    this.readOut.hidden = true;
  }
}
