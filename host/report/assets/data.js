"use strict";
// The numbers of the page: decoding, searching, thinning to what a screen shows.
const Data = (() => {
  function decode(packed) {
    if (Array.isArray(packed)) return new Float64Array(0);
    if (packed.count !== undefined) {
      const out = new Float64Array(packed.count);
      const step = (packed.end - packed.start) / (packed.count - 1);
      for (let i = 0; i < out.length; ++i) out[i] = packed.start + step * i;
      return out;
    }
    const text = atob(packed.offsets);
    const bytes = new DataView(new ArrayBuffer(text.length));
    for (let i = 0; i < text.length; ++i) bytes.setUint8(i, text.charCodeAt(i));
    const out = new Float64Array(text.length / 4);
    for (let i = 0; i < out.length; ++i) out[i] = packed.start + bytes.getFloat32(4 * i, true);
    return out;
  }

  function isSorted(x) {
    for (let i = 1; i < x.length; ++i) if (x[i] < x[i - 1]) return false;
    return true;
  }

  // First index with x[index] >= value.
  function lowerBound(x, value) {
    let low = 0, high = x.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (x[middle] < value) low = middle + 1; else high = middle;
    }
    return low;
  }

  // Index of the element nearest to value in sorted x.
  function nearest(x, value) {
    const at = lowerBound(x, value);
    if (at === 0) return 0;
    if (at === x.length) return x.length - 1;
    return value - x[at - 1] < x[at] - value ? at - 1 : at;
  }

  // Least and greatest finite number of values[from..to).
  function range(values, from = 0, to = values.length) {
    let least = Infinity, greatest = -Infinity;
    for (let i = from; i < to; ++i) {
      if (values[i] < least) least = values[i];
      if (values[i] > greatest && values[i] !== Infinity) greatest = values[i];
    }
    return [least, greatest];
  }

  return { decode, isSorted, lowerBound, nearest, range };
})();
