"""Roadtalk as a service: sessions, language, words and HTTP around `sim`, with `web` as its page."""
