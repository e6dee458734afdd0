// A page that is not whole reads itself again, unless it is being used, the reader says no, or an hour brought
// nothing new: a run that was killed cannot say that it ended.
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
  if (Date.now() - Date.parse(document.lastModified) > 3600e3) {
    reload.setAttribute("aria-pressed", "true");
    reload.after(" The page has stopped reloading, because nothing was added for an hour: the run may have ended. The same command continues it.");
  }
  setInterval(() => {
    const stopped = reload.getAttribute("aria-pressed") === "true";
    if (!stopped && Date.now() - used >= wait) location.reload();
  }, wait);
}
