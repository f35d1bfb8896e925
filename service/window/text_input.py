"""A line of text being written: letters, a cursor, what is being composed, and what was sent before."""

from __future__ import annotations

MAX_CHARS = 500
"""What is longer is not read by the language either."""
MAX_SENT = 200


class Line:
    """One editable line."""

    def __init__(self) -> None:
        self.text = ""
        self.cursor = 0
        self.composing = ""
        """letters an input method has not settled on yet; they stand at the cursor"""
        self.sent: list[str] = []
        self._back = 0
        self._draft = ""

    def set(self, text: str) -> None:
        """Another text; the cursor goes to its end."""
        self.text = text[:MAX_CHARS]
        self.cursor = len(self.text)
        self.composing = ""

    def insert(self, text: str) -> None:
        """Letters at the cursor; line breaks become spaces, and what has no shape is left out."""
        clean = "".join(" " if letter in "\r\n\t" else letter for letter in text)
        clean = "".join(letter for letter in clean if letter.isprintable())[: MAX_CHARS - len(self.text)]
        self.text = self.text[: self.cursor] + clean + self.text[self.cursor :]
        self.cursor += len(clean)
        self.composing = ""

    def move(self, by: int) -> None:
        """The cursor some letters on, or back."""
        self.cursor = min(len(self.text), max(0, self.cursor + by))

    def move_word(self, way: int) -> None:
        """The cursor to the next word's end, or the last one's beginning."""
        at = self.cursor
        if way < 0:
            while at and self.text[at - 1] == " ":
                at -= 1
            while at and self.text[at - 1] != " ":
                at -= 1
        else:
            while at < len(self.text) and self.text[at] == " ":
                at += 1
            while at < len(self.text) and self.text[at] != " ":
                at += 1
        self.cursor = at

    def home(self) -> None:
        """The cursor to the beginning."""
        self.cursor = 0

    def end(self) -> None:
        """The cursor to the end."""
        self.cursor = len(self.text)

    def backspace(self) -> None:
        """Without the letter before the cursor."""
        if self.cursor:
            self._cut(self.cursor - 1)

    def delete(self) -> None:
        """Without the letter after the cursor."""
        self.text = self.text[: self.cursor] + self.text[self.cursor + 1 :]

    def delete_word(self) -> None:
        """Without the word before the cursor."""
        at = self.cursor
        self.move_word(-1)
        start, self.cursor = self.cursor, at
        self._cut(start)

    def delete_before(self) -> None:
        """Without all that is before the cursor."""
        self._cut(0)

    def _cut(self, start: int) -> None:
        self.text = self.text[:start] + self.text[self.cursor :]
        self.cursor = start

    def send(self) -> str:
        """The text, remembered; the line is empty after it."""
        text = self.text.strip()
        if text:
            self.sent = [*(each for each in self.sent if each != text), text][-MAX_SENT:]
        self.set("")
        self._back, self._draft = 0, ""
        return text

    def older(self) -> None:
        """What was sent before; what is being written is kept."""
        if self._back == 0:
            self._draft = self.text
        if self._back < len(self.sent):
            self._back += 1
            self.set(self.sent[-self._back])

    def newer(self) -> None:
        """What was sent after that; in the end what was being written."""
        if self._back:
            self._back -= 1
            self.set(self.sent[-self._back] if self._back else self._draft)
