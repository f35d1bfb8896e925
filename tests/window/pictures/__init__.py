"""The pictures of the window that the README shows; `play.png` beside this is one of them.

    python -m tests.window.pictures                  the README's
    python -m tests.window.pictures --all <folder>   every state of the window, to be looked at

The same each time: time, seed and sentences are fixed, and the letters are pygame's own.
"""
