// What modules of the page ask of a browser when they are loaded: a document for lit-html, which renders nothing under
// Node, and the English texts.

import { readFileSync } from "node:fs";

globalThis.document ??= { createTreeWalker: () => ({}) };
globalThis.pageTexts ??= JSON.parse(readFileSync(process.env.PAGE_TEXTS, "utf-8"));
