for (const button of document.querySelectorAll(".measures thead button")) {
  button.addEventListener("click", () => {
    const head = button.closest("th"), table = head.closest("table"), body = table.tBodies[0];
    const column = [...head.parentNode.children].indexOf(head);
    const up = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    for (const other of head.parentNode.children) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", up === 1 ? "ascending" : "descending");
    const key = row => { const text = row.children[column].dataset.value; return text === "" ? NaN : Number(text); };
    const order = [...body.rows].sort((a, b) => {
      if (column === 0) return up * (Number(a.dataset.order) - Number(b.dataset.order));
      const x = key(a), y = key(b);
      if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
      return up * (x < y ? -1 : x > y ? 1 : 0);
    });
    body.append(...order);
  });
}
