// Tables of measures: sorted by a column, columns chosen, rows filtered, copied as CSV, Markdown or LaTeX.
const number = cell => (cell.dataset.value ? Number(cell.dataset.value) : NaN);
const text = cell => cell.dataset.text ?? cell.textContent.trim();

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
    const kinds = { CSV: () => this.csv(), Markdown: () => this.markdown(), LaTeX: () => this.latex() };
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

  csv() {
    // full numbers, each measure with its standard error beside it where there are any
    const quote = word => (/[",\n\r]/.test(word) ? `"${word.replaceAll('"', '""')}"` : word);
    const fields = this.columns().flatMap(k => {
      const title = this.heads[k].dataset.name ?? this.name(k),
        cells = this.rows().map(row => row.cells[k]);
      const full = cell =>
        cell.dataset.value === undefined ? text(cell) : cell.dataset.value.replace("1e999", "inf");
      const errors = cells.some(cell => cell.dataset.error);
      const column = [title, ...cells.map(full)];
      return errors
        ? [column, [`${title}_standard_error`, ...cells.map(cell => cell.dataset.error ?? "")]]
        : [column];
    });
    return (
      Array.from({ length: this.rows().length + 1 }, (_, k) =>
        fields.map(field => quote(field[k])).join(","),
      ).join("\n") + "\n"
    );
  }

  lines(write, strong) {
    return this.rows().map(row =>
      this.columns().map(k => {
        const cell = row.cells[k],
          word = write(text(cell), cell.dataset.value !== undefined);
        return cell.classList.contains("best") ? strong(word) : word;
      }),
    );
  }

  markdown() {
    const escape = word => word.replace(/[\\|*_`[\]<>]/g, "\\$&");
    const titles = this.columns().map(k => escape(this.name(k)));
    const rule = this.columns().map(k => (k ? "--:" : ":--"));
    const lines = this.lines(
      (word, value) => (value ? word : escape(word)),
      word => `**${word}**`,
    );
    return [titles, rule, ...lines].map(line => `| ${line.join(" | ")} |`).join("\n") + "\n";
  }

  latex() {
    const special = {
      "\\": "\\textbackslash{}",
      "~": "\\textasciitilde{}",
      "^": "\\textasciicircum{}",
      "<": "\\textless{}",
      ">": "\\textgreater{}",
      "|": "\\textbar{}",
    };
    const escape = word => word.replace(/[\\~^<>|&%$#_{}]/g, sign => special[sign] ?? `\\${sign}`);
    const maths = word =>
      word === "–"
        ? "--"
        : `$${word
            .replace("∞", "\\infty")
            .replace("±", "\\pm")
            .replace(/e(-?)\+?0*(\d+)$/, " \\cdot 10^{$1$2}")}$`;
    const bold = word => (word.startsWith("$") ? `$\\mathbf{${word.slice(1, -1)}}$` : `\\textbf{${word}}`);
    const titles = this.columns().map(k => escape(this.name(k)));
    const lines = this.lines((word, value) => (value ? maths(word) : escape(word)), bold);
    const row = line => `${line.join(" & ")} \\\\`;
    return [
      `\\begin{tabular}{l${"r".repeat(titles.length - 1)}}  % needs booktabs`,
      "\\toprule",
      row(titles),
      "\\midrule",
      ...lines.map(row),
      "\\bottomrule",
      "\\end{tabular}",
      "",
    ].join("\n");
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
