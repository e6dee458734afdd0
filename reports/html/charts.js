// Draws a chart in place of each picture that has data; the picture stays for print and without scripts.
const figures = [...document.querySelectorAll("figure.charted")];

class Chart {
  constructor(figure) {
    this.figure = figure;
    this.data = JSON.parse(figure.querySelector("script").textContent);
    this.shown = this.data.sources.map(() => true);
    this.curve = 0; // what the keys read
    this.point = -1;
    this.build();
    new IntersectionObserver(
      (entries, observer) => {
        if (!entries.some(entry => entry.isIntersecting)) return;
        observer.disconnect();
        this.draw();
      },
      { rootMargin: "800px" },
    ).observe(figure);
  }

  build() {
    const { data, figure } = this;
    this.boxes = data.sources.map((source, k) => {
      const box = element("input", { type: "checkbox", checked: true });
      box.addEventListener("change", () => this.show(k, box.checked));
      return box;
    });
    const labels = data.sources.map((source, k) => {
      const swatch = element("span", { className: `swatch ${source.dash}` });
      swatch.style.borderColor = source.colour;
      swatch.style.borderColor = `light-dark(${source.colour},${source.on_dark})`;
      return element("label", {}, this.boxes[k], swatch, source.name);
    });
    const every = (text, checked) => {
      const button = element("button", { type: "button", textContent: text });
      button.addEventListener("click", () => data.sources.forEach((_, k) => this.show(k, checked)));
      return button;
    };
    this.place = element("div", { className: "chart" });
    this.place.tabIndex = 0;
    this.place.setAttribute("role", "application");
    this.place.setAttribute(
      "aria-label",
      `${data.label}. Left and right read the values along a curve, up and ` +
        "down choose the curve, plus and minus zoom, 0 shows all.",
    );
    this.place.addEventListener("keydown", event => this.key(event));
    this.reading = element("output", { className: "reading" });
    const hint =
      "Drag to zoom, double-click to see all; with the keys: arrows to read values, +, − and 0 to zoom." +
      (data.thinned ? ` Of ${data.shells} shells the lowest and the highest of each strip are drawn.` : "");
    figure.append(
      element(
        "fieldset",
        { className: "sources" },
        element("legend", { textContent: "Sources" }),
        ...labels,
        every("all", true),
        every("none", false),
      ),
      this.place,
      element("div", { className: "under" }, this.reading, element("span", { textContent: hint })),
    );
  }

  draw() {
    this.figure.classList.add("drawn");
    this.whole = axesAndColours(this.data);
    Plotly.newPlot(this.place, traces(this.data, this.shown), axesAndColours(this.data), {
      responsive: true,
      displaylogo: false,
      showSendToCloud: false,
      doubleClick: "reset",
      doubleClickDelay: 500,
      modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
      toImageButtonOptions: { filename: "gbnbench", scale: 2 },
    }).then(
      () => {
        this.ready = true;
      },
      () => this.figure.classList.remove("drawn"), // the picture is there
    );
  }

  redraw() {
    if (!this.ready) return;
    const layout = axesAndColours(this.data),
      now = this.place.layout;
    for (const name of Object.keys(layout))
      if (/axis/.test(name) && now[name].range) layout[name].range = [...now[name].range];
    Plotly.react(this.place, traces(this.data, this.shown), layout);
  }

  show(k, shown) {
    this.shown[k] = this.boxes[k].checked = shown;
    if (this.ready)
      Plotly.restyle(this.place, {
        visible: this.place.data.map(trace => trace.source < 0 || this.shown[trace.source]),
      });
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== this.place || !this.ready) return;
    const act = {
      ArrowRight: () => this.read(0, 1),
      ArrowLeft: () => this.read(0, -1),
      ArrowUp: () => this.read(-1, 0),
      ArrowDown: () => this.read(1, 0),
      "+": () => this.zoom(0.5),
      "=": () => this.zoom(0.5),
      "-": () => this.zoom(2),
      0: () => this.zoom(0),
      Escape: () => {
        Plotly.Fx.unhover(this.place);
        this.reading.value = "";
      },
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  zoom(factor) {
    const change = {};
    for (const name of Object.keys(this.whole).filter(name => /axis/.test(name))) {
      const [low, high] = factor ? this.place.layout[name].range : this.whole[name].range;
      const middle = (low + high) / 2,
        half = ((high - low) / 2) * (factor || 1);
      change[`${name}.range`] = [middle - half, middle + half];
    }
    Plotly.relayout(this.place, change);
  }

  // Tell the value that is so many curves and so many shells on, among the curves that are shown.
  read(curve, step) {
    const { data } = this,
      on = data.curves.map((_, k) => k).filter(k => this.shown[data.curves[k].source]);
    if (!on.length) {
      this.reading.value = "No source is on.";
      return;
    }
    const at = on.indexOf(this.curve);
    this.curve = on[at < 0 ? 0 : (at + curve + on.length) % on.length];
    const now = data.curves[this.curve],
      x = data.grids[now.grid],
      last = x.length - 1;
    this.point = Math.min(Math.max(this.point + step, 0), last);
    const [source, panel] = [data.sources[now.source], data.panels[now.panel]];
    const y = now.y[this.point],
      text = y === null ? (now.zero.includes(this.point) ? "zero to rounding" : "none") : String(y);
    this.reading.value = `${source.name}: nu ${x[this.point]}, ${panel.title} ${text}`;
    const number = this.place.data.findIndex(trace => trace.x === x && trace.y === now.y);
    if (y !== null && number >= 0)
      Plotly.Fx.hover(
        this.place,
        [{ curveNumber: number, pointNumber: this.point }],
        panel === data.panels[0] ? "xy" : "xy2",
      );
  }
}

const charts = figures.map(figure => new Chart(figure));
dark.addEventListener("change", () => charts.forEach(chart => chart.redraw()));
