// @ts-check
/** The chosen theme, before anything is seen: the one script that holds up the page, so it does nothing else. */
{
  let theme = "";
  try {
    theme = localStorage.getItem("roadtalk.theme") ?? "";
  } catch {
    // Not allowed: the system's theme holds.
  }
  const dark = /** @type {HTMLLinkElement | null} */ (document.getElementById("dark"));
  if (dark && (theme === "light" || theme === "dark")) {
    document.documentElement.dataset.theme = theme;
    dark.media = theme === "dark" ? "all" : "not all";
  }
}
