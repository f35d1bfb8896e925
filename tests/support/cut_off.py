"""What a script sees wrong in a page as it is drawn: what sticks out of the window, and text that is cut."""

from __future__ import annotations

from typing import Final

CUT_OFF: Final = """
() => {
  const found = [];
  const wide = document.documentElement.scrollWidth;
  if (wide > innerWidth + 1) found.push(`the page is ${wide} px wide in a window of ${innerWidth}`);
  const top = [...document.querySelectorAll("dialog[open]")].at(-1) ?? document.body;
  const scrolls = (element) => {
    for (let at = element; at && at !== document.documentElement; at = at.parentElement)
      if (/auto|scroll/.test(getComputedStyle(at).overflowX + getComputedStyle(at).overflowY)) return true;
    return false;
  };
  const called = (element) => {
    const words = element.textContent.trim().replace(/\\s+/g, " ").slice(0, 40);
    return `${element.tagName.toLowerCase()}.${element.className} “${words}”`;
  };
  for (const element of top.querySelectorAll("*")) {
    if (!element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    if (element.closest(".unseen, .skip, svg, canvas, .lanes, [aria-hidden=true]")) continue;
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!own && !element.matches("button, input, select")) continue;
    const style = getComputedStyle(element), box = element.getBoundingClientRect();
    if (box.width < 2 || box.height < 2) continue;
    if (/hidden|clip/.test(style.overflowX) && element.scrollWidth > element.clientWidth + 1)
      found.push(`cut by its own edge: ${called(element)}`);
    if ((box.left < -1 || box.right > innerWidth + 1) && !scrolls(element))
      found.push(`outside the window: ${called(element)}`);
    for (let at = element.parentElement; at && at !== document.body; at = at.parentElement) {
      const over = getComputedStyle(at);
      if (over.position === "fixed") break;
      if (!/hidden|clip/.test(over.overflowX)) continue;
      if (/auto|scroll/.test(over.overflowY)) continue;
      const frame = at.getBoundingClientRect();
      const aside = box.left < frame.left - 1.5 || box.right > frame.right + 1.5;
      if ((aside || box.bottom > frame.bottom + 1.5) && !scrolls(element.parentElement))
        found.push(`cut by ${at.className || at.id}: ${called(element)}`);
      break;
    }
  }
  return [...new Set(found)];
}
"""
"""A function for the page; lines about what is wrong."""
