// @ts-check
/** Light or dark, and the command language, from the palette and by a sentence. */

import { chooseLanguage, LANGUAGE, languages, t } from "../core/texts.js";
import { chooseTheme, theme } from "../core/theme.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Panel } from "./index.js" */

const THEMES = /** @type {const} */ ([["light", "light"], ["dark", "dark"], ["system", ""]]);

/** @returns {Panel} */
export function createAppearance() {
  return { commands: [...themeCommands(), ...languageCommands()] };
}

/** @returns {Command[]} */
function themeCommands() {
  return THEMES.map(([name, value]) => ({
    name: `theme-${name}`,
    group: t("groups.views"),
    now: () => (theme() === value ? null : { label: t("help.colours_chosen", { name: t(`help.${name}`) }), run: () => chooseTheme(value) }),
  }));
}

/** @returns {Command[]} */
function languageCommands() {
  return languages().map(([code, name]) => ({
    name: `language-${code}`,
    group: t("groups.views"),
    now: () => (code === LANGUAGE ? null : { label: t("help.language_chosen", { name }), run: () => chooseLanguage(code) }),
  }));
}
