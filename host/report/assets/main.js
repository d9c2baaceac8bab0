// Starts the page: decodes the numbers, draws every plot, links those that share an axis.
(() => {
  const page = JSON.parse(document.getElementById("data").textContent);
  const decoded = new Map();
  const arrays = (index) => {
    if (index === undefined) return undefined;
    if (!decoded.has(index)) decoded.set(index, Data.decode(page.arrays[index]));
    return decoded.get(index);
  };
  const groups = new Map();
  const plots = [...document.querySelectorAll("[data-plot]")].map((figure) => {
    const number = Number(figure.dataset.plot);
    const spec = page.plots[number];
    const plot = new Plot(figure, spec, arrays, number);
    const group = spec.linked ? groups.get(spec.linked) || [] : [];
    if (spec.linked) groups.set(spec.linked, group);
    group.push(plot);
    plot.group = group;
    Zoom.attach(plot, group);
    return plot;
  });

  // One legend for all small multiples of a kind, else one per plot.
  const shared = new Map();
  for (const plot of plots) {
    const legend = plot.figure.querySelector(".legend") || plot.figure.closest(".multiples").querySelector(".legend");
    shared.set(legend, [...(shared.get(legend) || []), plot]);
  }
  shared.forEach((members, legend) => Plot.drawLegend(legend, members));

  // Draws when a plot gets its width: at the start, on a new window size, when a fold is opened.
  const widths = new ResizeObserver((entries) => {
    for (const entry of entries) plots.find((plot) => plot.area === entry.target).draw();
  });
  plots.forEach((plot) => { plot.draw(); widths.observe(plot.area); });

  // On paper a plot is drawn for the width of the page, so that its letters keep their size.
  const paperWidth = 680;
  window.addEventListener("beforeprint", () => {
    for (const plot of plots) {
      const beside = plot.figure.closest(".multiples");
      const columns = beside ? Number(beside.style.getPropertyValue("--columns")) : 1;
      plot.draw((paperWidth - 25 * (columns - 1)) / columns);
    }
  });
  window.addEventListener("afterprint", () => plots.forEach((plot) => plot.draw()));

  // The contents show where the reader is.
  const links = new Map([...document.querySelectorAll("nav a")].map((link) => [link.hash.slice(1), link]));
  const headings = [...document.querySelectorAll("h2[id]")];
  const mark = () => {
    const here = headings.filter((heading) => heading.getBoundingClientRect().top < 140).pop() || headings[0];
    for (const [name, link] of links) link.classList.toggle("here", Boolean(here) && name === here.id);
  };
  window.addEventListener("scroll", mark, { passive: true });
  mark();
})();
