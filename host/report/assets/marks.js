// How each kind of series is drawn: from numbers to one SVG path, never more points than the screen has columns for.
const Marks = (() => {
  const fix = (v) => Math.round(v * 10) / 10;

  // Index range of sorted x that touches the domain, one point beyond on either side.
  function visible(series, domain) {
    if (!series.sorted) return [0, series.x.length];
    return [Math.max(0, Data.lowerBound(series.x, domain[0]) - 1), Math.min(series.x.length, Data.lowerBound(series.x, domain[1]) + 1)];
  }

  function path(series, sx, sy, stepped) {
    const [from, to] = visible(series, sx.domain);
    const width = Math.abs(sx.pixels[1] - sx.pixels[0]);
    const { x, y } = series;
    let out = "", open = false, last = 0;
    const point = (i) => {
      if (!Number.isFinite(y[i])) { open = false; return; }
      const px = fix(sx(x[i])), py = fix(sy(y[i]));
      if (!open) out += `M${px} ${py}`;
      else if (stepped) out += `H${px}` + (py === last ? "" : `V${py}`);
      else out += `L${px} ${py}`;
      open = true;
      last = py;
    };
    if (!series.sorted || to - from <= 3 * width) {
      for (let i = from; i < to; ++i) point(i);
      return out;
    }
    // Per pixel column: first, least, greatest, last.
    for (let i = from; i < to;) {
      const column = Math.floor(sx(x[i]));
      let j = i, least = i, greatest = i;
      while (j < to && Math.floor(sx(x[j])) === column) {
        if (!(y[j] >= y[least])) least = j;
        if (y[j] > y[greatest]) greatest = j;
        ++j;
      }
      for (const k of [...new Set([i, least, greatest, j - 1])].sort((a, b) => a - b)) point(k);
      i = j;
    }
    return out;
  }

  function dots(series, sx, sy) {
    const [from, to] = visible(series, sx.domain);
    let out = "";
    for (let i = from; i < to; ++i) if (Number.isFinite(series.y[i])) out += `M${fix(sx(series.x[i]))} ${fix(sy(series.y[i]))}h0`;
    return out;
  }

  function errorBars(series, sx, sy, flipped) {
    let out = "";
    for (let i = 0; i < series.low.length; ++i) {
      if (!Number.isFinite(series.low[i]) || !Number.isFinite(series.high[i])) continue;
      if (flipped) out += `M${fix(sx(series.low[i]))} ${fix(sy(series.slot(i)))}H${fix(sx(series.high[i]))}`;
      else out += `M${fix(sx(series.slot ? series.slot(i) : series.x[i]))} ${fix(sy(series.low[i]))}V${fix(sy(series.high[i]))}`;
    }
    return out;
  }

  function band(series, sx, sy) {
    const [from, to] = visible(series, sx.domain);
    const stride = Math.max(1, Math.floor((to - from) / (2 * Math.abs(sx.pixels[1] - sx.pixels[0]))));
    let out = "";
    let start = from;
    const close = (end) => {
      if (end - start < 2) return;
      let forth = "", back = "";
      for (let i = start; i < end; i += stride) {
        forth += `${forth ? "L" : "M"}${fix(sx(series.x[i]))} ${fix(sy(series.high[i]))}`;
        back = `L${fix(sx(series.x[i]))} ${fix(sy(series.low[i]))}` + back;
      }
      out += forth + back + "Z";
    };
    for (let i = from; i < to; ++i) {
      if (Number.isFinite(series.low[i]) && Number.isFinite(series.high[i])) continue;
      close(i);
      start = i + 1;
    }
    close(to);
    return out;
  }

  // Bars from zero (or from the edge of a logarithmic axis); horizontal where the y axis has categories.
  function bars(series, sx, sy, flipped) {
    let out = "";
    const along = flipped ? sx : sy;
    const base = along(Math.max(along.domain[0], Math.min(along.domain[1], 0)));
    const n = flipped ? series.x.length : series.y.length;
    for (let i = 0; i < n; ++i) {
      const end = along(flipped ? series.x[i] : series.y[i]);
      if (!Number.isFinite(end)) continue;
      const centre = series.slot ? series.slot(i) : (flipped ? series.y[i] : series.x[i]);
      const across = flipped ? sy : sx;
      const a = across(centre - series.barWidth / 2), b = across(centre + series.barWidth / 2);
      const gap = Math.min(1, Math.abs(b - a) * 0.06) * Math.sign(b - a);
      out += flipped ? `M${fix(base)} ${fix(a + gap)}H${fix(end)}V${fix(b - gap)}H${fix(base)}Z` : `M${fix(a + gap)} ${fix(base)}V${fix(end)}H${fix(b - gap)}V${fix(base)}Z`;
    }
    return out;
  }

  const light = [[0, [247, 250, 252]], [0.25, [184, 214, 232]], [0.5, [98, 168, 204]], [0.75, [28, 106, 160]], [1, [10, 44, 92]]];
  const twoHues = [[0, [0, 84, 140]], [0.25, [98, 168, 204]], [0.5, [248, 248, 246]], [0.75, [238, 160, 92]], [1, [168, 66, 0]]];

  function colourAt(fraction, diverging) {
    const stops = diverging ? twoHues : light;
    const f = Math.max(0, Math.min(1, fraction));
    const k = Math.min(stops.length - 2, Math.floor(f * (stops.length - 1)));
    const [a, from] = stops[k], [b, to] = stops[k + 1];
    return from.map((c, i) => Math.round(c + (to[i] - c) * (f - a) / (b - a)));
  }

  // The map as a picture of one pixel per cell, row 0 at the bottom.
  function picture(map) {
    const canvas = document.createElement("canvas");
    canvas.width = map.columns;
    canvas.height = map.rows;
    const context = canvas.getContext("2d");
    const image = context.createImageData(map.columns, map.rows);
    for (let row = 0; row < map.rows; ++row) {
      for (let column = 0; column < map.columns; ++column) {
        const value = map.values[row * map.columns + column];
        if (!Number.isFinite(value)) continue;
        const at = 4 * ((map.rows - 1 - row) * map.columns + column);
        image.data.set([...colourAt((value - map.limits[0]) / (map.limits[1] - map.limits[0]), map.diverging), 255], at);
      }
    }
    context.putImageData(image, 0, 0);
    return canvas.toDataURL();
  }

  return { path, dots, errorBars, band, bars, picture, colourAt };
})();
