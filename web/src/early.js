// @ts-check
/**
 * Theme and language, before anything is seen: the one script that holds up the page, so it does nothing else. The
 * texts of that language are asked for here, beside the modules that need them (`core/texts.js`).
 */
{
  const root = document.documentElement;
  const stored = (/** @type {string} */ name) => {
    try {
      return localStorage.getItem(name) ?? "";
    } catch {
      return ""; // Not allowed: the system's settings hold.
    }
  };

  const theme = stored("roadtalk.theme");
  const dark = /** @type {HTMLLinkElement | null} */ (document.getElementById("dark"));
  if (dark && (theme === "light" || theme === "dark")) {
    root.dataset.theme = theme;
    dark.media = theme === "dark" ? "all" : "not all";
  }

  const known = (root.dataset.languages ?? "en").split(" ");
  const wished = [new URLSearchParams(location.search).get("lang") ?? "", stored("roadtalk.language"), ...navigator.languages];
  root.lang = wished.map((code) => code.toLowerCase().split("-")[0]).find((code) => known.includes(code)) ?? "en";
  Reflect.set(globalThis, "pageTexts", fetch(`texts/${root.lang}.json`).then((response) => response.json()));
}
