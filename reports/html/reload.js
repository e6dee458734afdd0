// A page that is not whole reads itself again, unless it is being used or the reader says no.
const reload = document.getElementById("reload");
if (reload) {
  const wait = 1000 * Number(reload.dataset.seconds);
  let used = 0;
  for (const kind of ["pointerdown", "keydown", "wheel"])
    addEventListener(kind, () => (used = Date.now()), { passive: true });
  reload.hidden = false;
  reload.addEventListener("click", () => {
    const stopped = reload.getAttribute("aria-pressed") === "false";
    reload.setAttribute("aria-pressed", String(stopped));
  });
  setInterval(() => {
    const stopped = reload.getAttribute("aria-pressed") === "true";
    if (!stopped && Date.now() - used >= wait) location.reload();
  }, wait);
}
