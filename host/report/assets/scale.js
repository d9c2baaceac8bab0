// From numbers to pixels and back; ticks; numbers as text.
const Scale = (() => {
  const superscripts = { "-": "\u207b", 0: "\u2070", 1: "\u00b9", 2: "\u00b2", 3: "\u00b3", 4: "\u2074", 5: "\u2075", 6: "\u2076", 7: "\u2077", 8: "\u2078", 9: "\u2079" };

  function make(domain, pixels, log) {
    const f = log ? Math.log10 : (v) => v;
    const g = log ? (v) => 10 ** v : (v) => v;
    const a = f(domain[0]), b = f(domain[1]);
    const scale = (value) => pixels[0] + (f(value) - a) / (b - a) * (pixels[1] - pixels[0]);
    scale.invert = (pixel) => g(a + (pixel - pixels[0]) / (pixels[1] - pixels[0]) * (b - a));
    scale.domain = domain;
    scale.pixels = pixels;
    return scale;
  }

  function powerOfTen(exponent) {
    return "10" + String(exponent).split("").map((c) => superscripts[c]).join("");
  }

  // 1, 2 or 5 times a power of ten, not below `rough`.
  function roundStep(rough) {
    const power = 10 ** Math.floor(Math.log10(rough));
    return power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999);
  }

  function multiples(domain, step) {
    const out = [];
    const slack = 1e-9 * (domain[1] - domain[0]);
    for (let k = Math.ceil((domain[0] - slack) / step); k * step <= domain[1] + slack; ++k) out.push(k * step);
    return out;
  }

  function ticks(domain, count, log) {
    if (log) return logTicks(domain, count);
    const span = domain[1] - domain[0];
    let step = roundStep(span / Math.max(1, count));
    let out = multiples(domain, step);
    // Two numbers at least, or nobody can read a value off the axis.
    for (let tries = 0; out.length < 2 && tries < 4; ++tries) out = multiples(domain, (step = roundStep(step / 2.5)));
    const size = Math.max(Math.abs(domain[0]), Math.abs(domain[1]));
    const exponent = size >= 1e5 || size < 2e-3 ? Math.floor(Math.log10(size)) : 0;
    const decimals = Math.max(0, Math.min(12, exponent - Math.floor(Math.log10(step) + 1e-9)));
    return out.map((value) => {
      let text = (value / 10 ** exponent).toFixed(decimals);
      if (Number(text) === 0) text = "0";
      else if (exponent) text += "\u00b7" + powerOfTen(exponent);
      return { value, text: text.replace("-", "\u2212") };
    });
  }

  function logTicks(domain, count) {
    const first = Math.floor(Math.log10(domain[0])), last = Math.ceil(Math.log10(domain[1]));
    const stride = Math.max(1, Math.ceil((last - first) / Math.max(2, count)));
    const marks = last - first <= 2 ? [1, 2, 5] : [1];
    const out = [];
    for (let exponent = first; exponent <= last; exponent += stride) {
      for (const mark of marks) {
        const value = mark * 10 ** exponent;
        if (value < domain[0] * 0.999 || value > domain[1] * 1.001) continue;
        const plain = exponent >= -3 && exponent <= 4;
        out.push({ value, text: plain ? String(Number(value.toPrecision(3))) : (mark > 1 ? mark + "\u00b7" : "") + powerOfTen(exponent) });
      }
    }
    return out;
  }

  // A value as read from a plot: five digits, no more.
  function number(value) {
    if (!Number.isFinite(value)) return "\u2013";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e6 || size < 1e-4) {
      const exponent = Math.floor(Math.log10(size));
      return (value / 10 ** exponent).toFixed(3).replace("-", "\u2212") + "\u00b7" + powerOfTen(exponent);
    }
    return value.toFixed(Math.max(0, 4 - Math.floor(Math.log10(size)))).replace("-", "\u2212");
  }

  function pad(range, log) {
    let [least, greatest] = range;
    if (!(least <= greatest)) return log ? [0.1, 10] : [0, 1];
    if (log) {
      const room = Math.max(0.02, 0.04 * Math.log10(greatest / least));
      return [least / 10 ** room, greatest * 10 ** room];
    }
    if (least === greatest) {
      const room = least === 0 ? 1 : Math.abs(least) * 0.1;
      return [least - room, greatest + room];
    }
    const room = 0.05 * (greatest - least);
    return [least - room, greatest + room];
  }

  return { make, ticks, number, pad };
})();
