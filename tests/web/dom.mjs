// What lit-html asks of a document when it is loaded; templates are not rendered under Node.

globalThis.document ??= { createTreeWalker: () => ({}) };
