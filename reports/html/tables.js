// Tables of measures: sorted by a column, columns chosen, rows filtered, copied as CSV, Markdown or LaTeX.
const number = cell => (cell.dataset.value ? Number(cell.dataset.value) : NaN);

class Measures {
  constructor(table) {
    this.table = table;
    this.body = table.tBodies[0];
    this.heads = [...table.tHead.rows[0].cells];
    this.hidden = new Set();
    this.heads.forEach((head, k) =>
      head.querySelector("button.sort").addEventListener("click", () => this.sort(k)),
    );
    this.said = element("output", { className: "said" });
    table.parentNode.before(
      element("div", { className: "tools" }, this.filter(), this.chooser(), this.copier(), this.said),
    );
  }

  name(k) {
    return this.heads[k].querySelector("button.sort").textContent.trim();
  }
  rows() {
    return [...this.body.rows].filter(row => !row.hidden);
  }
  columns() {
    return this.heads.map((_, k) => k).filter(k => !this.hidden.has(k));
  }

  sort(k) {
    const head = this.heads[k],
      up = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    for (const other of this.heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", up === 1 ? "ascending" : "descending");
    const numbers = [...this.body.rows].some(row => "value" in row.cells[k].dataset);
    const compare = (a, b) => {
      if (k === 0) return Number(a.dataset.order) - Number(b.dataset.order);
      if (!numbers) return text(a.cells[k]).localeCompare(text(b.cells[k]));
      const x = number(a.cells[k]),
        y = number(b.cells[k]);
      if (Number.isNaN(x) || Number.isNaN(y)) return up * (Number.isNaN(x) - Number.isNaN(y)); // undefined come last
      return x < y ? -1 : x > y ? 1 : 0;
    };
    this.body.append(...[...this.body.rows].sort((a, b) => up * compare(a, b)));
  }

  filter() {
    const field = element("input", { type: "search", placeholder: "words, or psi6 < 0.5" });
    field.addEventListener("input", () => {
      const tests = this.tests(field.value);
      for (const row of this.body.rows) row.hidden = !tests.every(test => test(row));
      this.said.value = `${this.rows().length} of ${this.body.rows.length} rows`;
    });
    return element("label", {}, "Rows with ", field);
  }

  tests(words) {
    // a condition such as noise_floor < 1e-3, or a word of the row's first cells
    const tests = [];
    const rest = words.replace(
      /(\S[^<>]*?)\s*([<>])\s*(-?[\d.]+(?:e[-+]?\d+)?)(?=\s|$)/gi,
      (all, title, sign, limit) => {
        const k = this.heads.findIndex((head, j) =>
          [head.dataset.name, this.name(j)].some(n => n?.toLowerCase() === title.trim().toLowerCase()),
        );
        if (k < 0) return all;
        tests.push(row =>
          sign === "<" ? number(row.cells[k]) < Number(limit) : number(row.cells[k]) > Number(limit),
        );
        return " ";
      },
    );
    const wanted = rest.toLowerCase().split(/\s+/).filter(Boolean);
    const said = row =>
      [...row.cells]
        .filter(cell => !("value" in cell.dataset))
        .map(text)
        .join(" ")
        .toLowerCase();
    return [...tests, row => wanted.every(word => said(row).includes(word))];
  }

  chooser() {
    const boxes = this.heads.slice(1).map((_, j) => {
      const box = element("input", { type: "checkbox", checked: true });
      box.addEventListener("change", () => this.show(j + 1, box.checked));
      return element("label", {}, box, this.name(j + 1));
    });
    const every = (word, checked) => {
      const button = element("button", { type: "button", textContent: word });
      button.addEventListener("click", () =>
        boxes.forEach((label, j) => {
          label.firstChild.checked = checked;
          this.show(j + 1, checked);
        }),
      );
      return button;
    };
    const list = element("div", { className: "columns" }, every("all", true), every("none", false), ...boxes);
    return element("details", { className: "chooser" }, element("summary", { textContent: "Columns" }), list);
  }

  show(k, shown) {
    this.hidden[shown ? "delete" : "add"](k);
    for (const row of [this.table.tHead.rows[0], ...this.body.rows]) row.cells[k].hidden = !shown;
  }

  copier() {
    const kinds = { CSV: () => asCsv(this), Markdown: () => asMarkdown(this), LaTeX: () => asLatex(this) };
    const buttons = Object.entries(kinds).map(([kind, write]) => {
      const button = element("button", { type: "button", textContent: kind });
      button.addEventListener("click", () => this.copy(kind, write()));
      return button;
    });
    const group = element("span", { className: "copy" }, "Copy as ", ...buttons);
    group.setAttribute("role", "group");
    group.setAttribute("aria-label", "Copy the rows and columns shown");
    return group;
  }

  async copy(kind, written) {
    let done = true;
    try {
      await navigator.clipboard.writeText(written);
    } catch {
      // not allowed, or an older browser
      const field = element("textarea", { value: written });
      document.body.append(field);
      field.select();
      done = document.execCommand("copy");
      field.remove();
    }
    this.said.value = done
      ? `copied ${this.rows().length} rows as ${kind}`
      : "the browser does not let a page copy";
  }
}

for (const table of document.querySelectorAll("table.measures")) new Measures(table);

// A definition opens beside the name that was pressed; without scripts it opens in the middle of the page.
for (const button of document.querySelectorAll("button[popovertarget]")) {
  button.addEventListener("click", () => {
    const note = document.getElementById(button.getAttribute("popovertarget")),
      place = button.getBoundingClientRect();
    note.style.margin = "0";
    note.style.top = `${place.bottom + 6}px`;
    note.style.left = `${Math.max(8, Math.min(place.left, document.documentElement.clientWidth - 380))}px`;
  });
}
