// The rows and columns shown of a table of measures, written as CSV, Markdown or LaTeX.
const text = cell => cell.dataset.text ?? cell.textContent.trim();
const isNumber = cell => cell.dataset.value !== undefined;

// Full numbers; beside a column its standard errors and its verdicts, where it has any.
function asCsv(table) {
  const quote = word => (/[",\n\r]/.test(word) ? `"${word.replaceAll('"', '""')}"` : word);
  const full = cell => (isNumber(cell) ? cell.dataset.value.replace("1e999", "inf") : text(cell));
  const fields = table.columns().flatMap(k => {
    const title = table.heads[k].dataset.name ?? table.name(k);
    const cells = table.rows().map(row => row.cells[k]);
    const beside = { standard_error: "error", verdict: "verdict" };
    const more = Object.entries(beside).filter(([, key]) => cells.some(cell => cell.dataset[key]));
    return [
      [title, ...cells.map(full)],
      ...more.map(([word, key]) => [`${title}_${word}`, ...cells.map(cell => cell.dataset[key] ?? "")]),
    ];
  });
  const lines = Array.from({ length: table.rows().length + 1 }, (_, k) =>
    fields.map(f => quote(f[k])).join(","),
  );
  return lines.join("\n") + "\n";
}

// Every shown cell: write(its text, whether it is a number), the best by strong(that), a verdict after it.
function written(table, write, strong) {
  return table.rows().map(row =>
    table.columns().map(k => {
      const cell = row.cells[k];
      const word = write(text(cell), isNumber(cell));
      const verdict = cell.dataset.verdict ? ` (${cell.dataset.verdict})` : "";
      return (cell.classList.contains("best") ? strong(word) : word) + verdict;
    }),
  );
}

function asMarkdown(table) {
  const escape = word => word.replace(/[\\|*_`[\]<>]/g, "\\$&");
  const titles = table.columns().map(k => escape(table.name(k)));
  const rule = table.columns().map(k => (k ? "--:" : ":--"));
  const lines = written(
    table,
    (word, number) => (number ? word : escape(word)),
    word => `**${word}**`,
  );
  return [titles, rule, ...lines].map(line => `| ${line.join(" | ")} |`).join("\n") + "\n";
}

function asLatex(table) {
  const names = {
    "\\": "backslash",
    "~": "asciitilde",
    "^": "asciicircum",
    "<": "less",
    ">": "greater",
    "|": "bar",
  };
  const escape = word =>
    word.replace(/[\\~^<>|&%$#_{}]/g, sign => (names[sign] ? `\\text${names[sign]}{}` : `\\${sign}`));
  const power = word => word.replace(/e(-?)\+?0*(\d+)$/, " \\cdot 10^{$1$2}");
  const maths = word =>
    word === "–" ? "--" : `$${power(word.replace("∞", "\\infty").replace("±", "\\pm"))}$`;
  const strong = word => (word.startsWith("$") ? `$\\mathbf{${word.slice(1, -1)}}$` : `\\textbf{${word}}`);
  const titles = table.columns().map(k => escape(table.name(k)));
  const lines = written(table, (word, number) => (number ? maths(word) : escape(word)), strong);
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
