// @ts-check
/** What fits what was typed, best first. */

/**
 * Those that fit what was typed, best first: whole words before beginnings before letters in order.
 * @template {{label: string}} T
 * @param {T[]} entries
 * @param {string} typed
 * @returns {T[]}
 */
export function rank(entries, typed) {
  const wanted = typed.trim().toLowerCase();
  if (wanted === "") return entries;
  return entries
    .map((entry, order) => ({ entry, order, score: score(entry.label.toLowerCase(), wanted) }))
    .filter(({ score }) => score > 0)
    .sort((a, b) => b.score - a.score || a.order - b.order)
    .map(({ entry }) => entry);
}

/** @param {string} label @param {string} wanted */
function score(label, wanted) {
  const at = label.indexOf(wanted);
  if (at === 0) return 4;
  if (at > 0) return label[at - 1] === " " ? 3 : 2;
  let from = -1;
  for (const letter of wanted.replaceAll(" ", "")) {
    from = label.indexOf(letter, from + 1);
    if (from === -1) return 0;
  }
  return 1;
}
