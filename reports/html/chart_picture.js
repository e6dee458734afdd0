// What the plotting library is to draw: the curves of a chart, its axes and its colours, dark or light.
const dark = matchMedia("(prefers-color-scheme: dark)");
const fonts = getComputedStyle(document.body).fontFamily;
const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function traces(data, shown) {
  const made = [];
  const axes = panel => ({ xaxis: "x", yaxis: panel ? `y${panel + 1}` : "y" });
  for (const curve of data.curves) {
    const source = data.sources[curve.source],
      x = data.grids[curve.grid],
      panel = data.panels[curve.panel];
    const common = {
      ...axes(curve.panel),
      source: curve.source,
      name: plain(source.name),
      showlegend: false,
    };
    const ink = dark.matches ? source.on_dark : source.colour;
    const few = x.length < 40;
    const size = curve.alone.length && !few ? x.map(() => 0) : 5;
    if (!few) for (const k of curve.alone) size[k] = 4;
    made.push({
      ...common,
      type: "scatter",
      x,
      y: curve.y,
      mode: few || curve.alone.length ? "lines+markers" : "lines",
      line: { color: ink, dash: source.dash, width: 1.6 },
      marker: { color: ink, size, opacity: 1 },
      hovertemplate: `%{y:.4~g}<extra>${plain(source.name)}</extra>`,
    });
    if (curve.zero.length)
      made.push({
        ...common,
        type: "scatter",
        mode: "markers",
        x: curve.zero.map(k => x[k]),
        y: curve.zero.map(() => panel.range[0]),
        cliponaxis: false,
        marker: { color: ink, size: 6, symbol: "triangle-down", opacity: 0.6 },
        hovertemplate: `zero to rounding<extra>${plain(source.name)}</extra>`,
      });
  }
  for (const guide of data.guides)
    made.push({
      ...axes(0),
      type: "scatter",
      mode: "lines",
      x: guide.x,
      y: guide.y,
      source: -1,
      name: guide.name,
      showlegend: true,
      hoverinfo: "skip",
      line: { color: colour("--soft"), dash: "dot", width: 1.6 },
    });
  made.forEach(trace => {
    trace.visible = trace.source < 0 || shown[trace.source];
  });
  return made;
}

function axesAndColours(data) {
  const ends = axis => (axis.log ? axis.range.map(Math.log10) : axis.range);
  const axis = (from, more) => ({
    title: { text: from.title, standoff: 6 },
    type: from.log ? "log" : "linear",
    range: ends(from),
    gridcolor: colour("--rule"),
    linecolor: colour("--soft"),
    zeroline: false,
    ticks: "outside",
    tickcolor: colour("--soft"),
    exponentformat: "power",
    ...more,
  });
  const layout = {
    font: { family: fonts, size: 13, color: colour("--ink") },
    paper_bgcolor: colour("--card"),
    plot_bgcolor: colour("--card"),
    margin: { l: 74, r: 16, t: 34, b: 54 },
    hovermode: "x unified",
    hoversubplots: "axis",
    hoverlabel: {
      bgcolor: colour("--card"),
      bordercolor: colour("--soft"),
      font: { color: colour("--ink") },
    },
    dragmode: "zoom",
    legend: { x: 0, y: 1.01, yanchor: "bottom", orientation: "h" },
    shapes: [],
    height: data.panels.length > 1 ? 560 : 480,
    xaxis: axis(data.x, {
      anchor: data.panels.length > 1 ? "y2" : "y",
      hoverformat: ".4~g",
      tickformat: "~g", // 0.5 in full: of a bare 5 nobody knows the decade when no power of ten is in view
      ...(data.x.log ? { nticks: 4 } : {}), // marks at 2 and 5 of a decade; of more, labels touch
      unifiedhovertitle: { text: "nu %{x:.4~g}" },
    }),
  };
  data.panels.forEach((panel, k) => {
    const domain = data.panels.length === 1 ? [0, 1] : k === 0 ? [0.4, 1] : [0, 0.33];
    layout[k ? `yaxis${k + 1}` : "yaxis"] = axis(panel, { domain, anchor: "x" });
    for (const rule of panel.rules)
      layout.shapes.push({
        type: "line",
        xref: "paper",
        x0: 0,
        x1: 1,
        layer: "below",
        y0: rule,
        y1: rule,
        yref: k ? `y${k + 1}` : "y",
        line: { color: colour("--soft"), width: 1, dash: k ? "dash" : "solid" },
      });
  });
  return layout;
}

// A name is text: the library would read tags and %{...} in it.
function plain(name) {
  return name.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/%\{/g, "%&#8203;{");
}
