(async () => {
  "use strict";
  const report = JSON.parse(document.getElementById("report-data").textContent);
  const plots = [...document.querySelectorAll(".plot")];
  const fail = (why) => plots.forEach((plot) => {
    plot.style.height = "auto";
    plot.textContent = `${why} The folder figures has the figures as pictures.`;
  });
  if (typeof DecompressionStream === "undefined") {
    fail("This browser is too old to draw this figure.");
    return;
  }
  const packed = document.getElementById("plotly-packed").textContent;
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const code = document.createElement("script");
  code.textContent = await new Response(stream).text();
  document.head.append(code);

  const PRINTED = 700, LOWER = 0.82, HIGHEST = 880;  // width of a page [px]; two figures fit on it
  const SIZE = 13, SMALL = 11, LINE = 17, OVER = 16;  // px; OVER: a label may be longer than its axis
  const PHONE = 640, PANEL = 250, HIGH = 420, KEY = 18;  // px; HIGH: with names beside it
  const axis = (rule) => ({
    gridcolor: rule, zerolinecolor: rule, linecolor: rule, ticks: "outside", tickcolor: rule,
    automargin: true, exponentformat: "power", minexponent: 4, title: {standoff: 8, font: {size: SIZE}},
  });
  const scale = {colorbar: {title: {font: {size: SIZE}}}};
  const maps = {heatmap: [scale], contour: [scale], mesh3d: [scale], surface: [scale]};
  const template = (text, page, rule) => ({data: maps, layout: {
    font: {color: text, family: 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif', size: SIZE},
    paper_bgcolor: page, plot_bgcolor: page, colorway: COLOURS,
    xaxis: axis(rule), yaxis: axis(rule), hovermode: "closest",
    margin: {l: 60, r: 20, t: 30, b: 50},
    legend: {orientation: "h", yref: "container", y: 0, yanchor: "bottom", x: 0, font: {size: 12}},
    colorscale: {sequential: "Cividis"},
    scene: {xaxis: {gridcolor: rule}, yaxis: {gridcolor: rule}, zaxis: {gridcolor: rule}},
  }});
  const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
  const LIGHT = template("#1d1f21", "#ffffff", "#dcdfe2");
  const DARK = template("#e6e8ea", "#16191c", "#3b4147");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const look = () => (dark.matches ? DARK : LIGHT);
  const config = {
    responsive: true, displaylogo: false, modeBarButtonsToRemove: ["lasso2d", "select2d"],
    toImageButtonOptions: {scale: 2},
    displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false,
  };
  const stacked = (plot, layout, data) => {  // on a phone panels lie one below the other
    if (!layout.meta?.places || innerWidth > PHONE) return layout;
    const beside = (one) => one.xref.endsWith("domain") && one.x >= 1 && one.xanchor === "left";
    const annotations = (layout.annotations || []).map(
      (one) => beside(one) ? {...one, font: {...one.font, size: 9}} : one);
    const margin = {...layout.margin, r: Math.max(12, 0.75 * (layout.margin?.r || 0))};
    const names = data.filter((one) => one.name && one.showlegend !== false).length;
    const own = {...layout, annotations, margin, height: layout.height + KEY * names};
    plot.style.height = `${own.height}px`;
    const {columns, places} = layout.meta;
    if (columns === 1) return own;
    const step = 1 / (places.length - 0.36);
    const order = [...places.keys()].sort((a, b) => places[a][1] - places[b][1] || a - b);
    order.forEach((panel, slot) => {
      const name = panel ? panel + 1 : "";
      const top = 1 - slot * step;
      own[`xaxis${name}`] = {...layout[`xaxis${name}`], domain: [0, 1]};
      own[`yaxis${name}`] = {...layout[`yaxis${name}`], domain: [Math.max(top - 0.64 * step, 0), top]};
    });
    own.height = (annotations.some(beside) ? HIGH : PANEL) * places.length + KEY * names;
    plot.style.height = `${own.height}px`;
    return own;
  };
  const scaleBelow = (trace) => trace.colorbar ? {...trace, colorbar: {
    ...trace.colorbar, orientation: "h", x: 0, xanchor: "left", y: -0.16, yanchor: "top",
    title: {...trace.colorbar.title, side: "top"}}} : trace;
  const bare = (text) => text.replace(/<[^>]*>/g, "");
  const wrapped = (text, letters) => text.replaceAll("<br>", " ").split(" ").reduce(
    (done, word) => bare(`${done} ${word}`.split("<br>").pop()).length > letters && done
      ? `${done}<br>${word}` : `${done} ${word}`.trim(), "");
  const lettersIn = (text, length, room) => {  // of a line that takes `length` px
    const longest = Math.max(...text.split("<br>").map((line) => bare(line).length));
    return Math.max(Math.floor(0.95 * longest * room / length), 6);  // letters differ in width
  };
  const fitLabels = (plot, box, now) => {  // labels of axes are no longer than these
    for (const label of plot.querySelectorAll(".infolayer text")) {
      const [, letter, number] = label.getAttribute("class")?.match(/^([xy])(\d*)title$/) || [];
      const axis = letter && plot._fullLayout[`${letter}axis${number}`];
      if (!axis?.visible) continue;
      const place = label.getBoundingClientRect();
      const long = letter === "x" ? place.width : place.height;
      const aside = letter === "x" ? [place.left - box.left, box.right - place.right] : [0, 0];
      const room = Math.min(axis._length + OVER, long + 2 * Math.min(...aside) - (aside[0] && 4));
      if (long <= room + 1) continue;
      const name = `${axis._name}.title`;
      const letters = lettersIn(axis.title.text, long, room);
      now[`${name}.text`] = wrapped(axis.title.text, letters);
      if (axis.title.text.split(" ").some((word) => bare(word).length > letters)) {
        now[`${name}.font.size`] = SMALL;
      }
    }
  };
  const fitNotes = (plot, box, now) => {  // words stay in the chart, on maps in the panel
    const upright = [];
    for (const mark of plot.querySelectorAll(".annotation")) {
      const number = mark.dataset.index, note = plot._fullLayout.annotations[number];
      const place = mark.getBoundingClientRect(), name = `annotations[${number}]`;
      if (note.textangle) {
        const moved = ([right, up]) => new DOMRect(
          place.x + right, place.y - up, place.width, place.height);
        const top = box.top + plot._fullLayout._size.t;
        const free = (one) => upright.every((other) => other.right <= one.left + 2
          || other.left >= one.right - 2 || other.bottom <= one.top || other.top >= one.bottom);
        const ups = upright.map((other) => place.bottom - other.top).filter((up) => up > 0);
        const beside = place.width + 4;  // on the other side of its line
        const moves = [[0, 0], [beside, 0], ...ups.flatMap((up) => [[0, up], [beside, up]])];
        const move = moves.find((one) => free(moved(one)) && moved(one).top >= top) || [0, 0];
        now[`${name}.xshift`] = note.xshift + move[0];
        now[`${name}.yshift`] = note.yshift + move[1];
        upright.push(moved(move));
        continue;
      }
      const axis = plot._fullLayout[note.xref.replace(/^x(\d*)$/, "xaxis$1")];
      const end = axis && note.font.color === "#ffffff" ? box.left + axis._offset + axis._length : box.right;
      const over = place.right - end;
      if (over <= 0 || note.xanchor !== "left") continue;
      const left = Math.min(over + 2, place.left - box.left);
      now[`${name}.xshift`] = note.xshift - left;
      if (left > over) continue;
      const lines = note.text.split("<br>").length;
      now[`${name}.text`] = wrapped(note.text, lettersIn(note.text, place.width, box.width - 4));
      const more = now[`${name}.text`].split("<br>").length - lines;
      if (note.yref === "paper") now["margin.t"] = plot._fullLayout.margin.t + LINE * more;
    }
  };
  const fit = async (plot) => {
    for (const parts of [fitLabels, fitNotes]) {  // labels of several lines move the rest
      const now = {};
      parts(plot, plot.getBoundingClientRect(), now);
      if (Object.keys(now).length) await Plotly.relayout(plot, now);
    }
  };
  const drawn = new Set();
  const draw = async (plot, own) => {
    drawn.add(plot);
    const {data, layout, frames} = report.charts[plot.dataset.figure];
    const whole = {...stacked(plot, layout, data), template: look(), ...own};
    const shown = innerWidth > PHONE || !layout.meta?.places ? data : data.map(scaleBelow);
    await Plotly.newPlot(plot, {data: shown, layout: whole, config, frames: frames || []});
    await fit(plot);
  };
  const drawOpen = async () => {  // what is folded has no width yet
    for (const plot of plots) {
      if (plot.closest("details:not([open])")) continue;
      await (drawn.has(plot) ? Plotly.Plots.resize(plot) : draw(plot));
    }
  };
  const reveal = () => {  // a link leads to a folded figure
    const aim = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const part = aim?.closest("details:not([open])");
    if (!part) return;
    part.open = true;
    aim.scrollIntoView();
  };
  document.querySelectorAll(".more").forEach((part) => part.addEventListener("toggle", drawOpen));
  addEventListener("hashchange", reveal);
  await drawOpen();
  reveal();
  document.body.dataset.drawn = "yes";
  dark.addEventListener("change", () => {
    drawn.forEach((plot) => Plotly.relayout(plot, {template: look()}));
  });
  const heights = new Map(plots.map((plot) => [plot, parseFloat(plot.style.height)]));
  const folded = [...document.querySelectorAll("details:not([open])")];
  addEventListener("beforeprint", () => {
    folded.forEach((part) => { part.open = true; });
    plots.forEach((plot) => {
      const height = Math.min(LOWER * heights.get(plot), HIGHEST);
      Object.assign(plot.style, {width: `${PRINTED}px`, height: `${height}px`});
      const print = {template: LIGHT, width: PRINTED, height};
      if (drawn.has(plot)) Plotly.relayout(plot, print);
      else draw(plot, print).catch(() => {});  // folded again before it was whole
    });
  });
  addEventListener("afterprint", () => {
    folded.forEach((part) => { part.open = false; });
    plots.forEach((plot) => {
      const height = heights.get(plot);
      Object.assign(plot.style, {width: "", height: `${height}px`});
      if (plot.closest("details:not([open])")) {
        Plotly.purge(plot);
        drawn.delete(plot);
        return;
      }
      Plotly.relayout(plot, {template: look(), width: null, height, autosize: true});
    });
  });
})();
