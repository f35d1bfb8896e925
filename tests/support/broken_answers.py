"""What a language model may answer that is unfit."""

from __future__ import annotations

import gzip
import json

from service.llm.transport import MAX_ANSWER_BYTES
from tests.llm.server import Reply, acts, reply, says

GOOD = json.dumps({"actions": [{"do": "add", "kind": "barrier", "count": 5}]})


UNREADABLE = "The language model answered something that cannot be read as actions."


NO_ACTION = "The language model answered something that is no action of this simulator."


NO_ANSWER = "What the language model's server sent is no answer of a language model."


TOO_LONG = "The language model's answer was longer than is read."


NOT_SAID = "The language model named something that was not said."


NOTHING = "The language model found nothing to do in this."


TOO_MANY = "The language model answered with more than 8 actions."


ADD = {"do": "add", "kind": "barrier", "count": 5}


BOMB: dict[str, object] = {"do": "pause"}
for _ in range(40):
    BOMB = {"do": "ask", "about": "what_if", "change": [BOMB]}


BROKEN: dict[str, tuple[Reply, str, int]] = {
    "malformed JSON": (says('{"actions": [{"do": "add"'), UNREADABLE, 2),
    "prose only": (says("I am sorry, I cannot do that."), UNREADABLE, 2),
    "two objects": (says(f"{GOOD}\n{GOOD}"), UNREADABLE, 2),
    "two fences": (says(f"```\n{GOOD}\n```\n```\n{GOOD}\n```"), UNREADABLE, 2),
    "empty": (says(""), UNREADABLE, 2),
    "null": (says(None), UNREADABLE, 2),
    "NaN": (says('{"actions": [{"do": "adjust", "parameter": "courtesy", "by": NaN}]}'), UNREADABLE, 2),
    "infinite": (says('{"actions": [{"do": "adjust", "parameter": "courtesy", "by": 1e999}]}'), NO_ACTION, 2),
    "deep": (says('{"actions": ' + "[" * 50_000 + "]" * 50_000 + "}"), UNREADABLE, 2),
    "no list": (says('{"actions": {"do": "pause"}}'), NO_ACTION, 2),
    "another key": (says('{"result": []}'), NO_ACTION, 2),
    "one key more": (says('{"actions": [], "thanks": 1}'), NO_ACTION, 2),
    "unknown action": (acts({"do": "fly"}), NO_ACTION, 2),
    "no name": (acts({"kind": "barrier"}), NO_ACTION, 2),
    "name of no kind": (acts({"do": ["teach"]}), NO_ACTION, 2),
    "not an object": (acts("pause", 3, None), NO_ACTION, 2),
    "number in words": (acts({"do": "add", "kind": "barrier", "count": "5"}), NO_ACTION, 2),
    "out of range": (acts({"do": "add", "kind": "barrier", "count": 10**30}), NO_ACTION, 2),
    "field too many": (acts(ADD | {"name": "<script>alert(1)</script>"}), NO_ACTION, 2),
    "script as value": (acts({"do": "set", "parameter": "weather", "value": "<script>"}), NO_ACTION, 2),
    "word for a number": (acts({"do": "set", "parameter": "rows", "value": "many"}), NO_ACTION, 2),
    "number for a word": (acts({"do": "set", "parameter": "weather", "value": 3}), NO_ACTION, 2),
    "question in a question": (
        acts({"do": "ask", "about": "what_if", "change": [{"do": "ask", "about": "help"}]}),
        NO_ACTION,
        2,
    ),
    "word in a question": (
        acts(
            {"do": "ask", "about": "what_if", "change": [{"do": "set", "parameter": "weather", "value": "x"}]}
        ),
        NO_ACTION,
        2,
    ),
    "teach": (
        acts(ADD, {"do": "teach", "phrase": "stop", "meaning": [{"do": "resume"}]}),
        "The language model wanted to teach, which it may not.",
        1,
    ),
    "teach, badly": (acts({"do": "teach"}), "The language model wanted to teach, which it may not.", 1),
    "load": (acts({"do": "load", "name": "x"}), "The language model wanted to load, which it may not.", 1),
    "save": (acts({"do": "save", "name": "x"}), "The language model wanted to save, which it may not.", 1),
    "load, hidden": (
        acts({"do": "ask", "about": "what_if", "change": [{"do": "load", "name": "x"}]}),
        "The language model wanted to load, which it may not.",
        1,
    ),
    "nine": (acts(*[ADD] * 9), TOO_MANY, 1),
    "a thousand": (acts(*[ADD] * 1000), TOO_MANY, 1),
    "nine, hidden": (acts({"do": "ask", "about": "what_if", "change": [ADD] * 8}), TOO_MANY, 1),
    "what if, forty deep": (acts(BOMB), TOO_MANY, 1),
    "another id": (
        acts({"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "pothole-4"}}),
        NOT_SAID,
        1,
    ),
    "part of an id": (
        acts({"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "hole-3"}}),
        NOT_SAID,
        1,
    ),
    "no id at all": (acts({"do": "add", "kind": "barrier", "count": 1, "where": {"id": ".*"}}), NOT_SAID, 1),
    "id in a question": (
        acts(
            {
                "do": "ask",
                "about": "what_if",
                "change": [{"do": "remove", "kind": "av", "count": 1, "where": {"id": "av-1"}}],
            }
        ),
        NOT_SAID,
        1,
    ),
    "nothing": (acts(), NOTHING, 1),
    "500": (reply("{}", 500), "The language model's server failed (500).", 1),
    "404": (reply("{}", 404), "The language model's server failed (404).", 1),
    "204": (reply("", 204), "The language model's server failed (204).", 1),
    "401": (reply("{}", 401), "The language model's server refused the key it was given.", 1),
    "403": (reply("{}", 403), "The language model's server refused the key it was given.", 1),
    "429": (reply("{}", 429), "The language model's server is asked too much at present.", 1),
    "a page": (reply("<html><script>alert(1)</script>", content_type="text/html"), NO_ANSWER, 1),
    "text": (reply(says(GOOD).body, content_type="text/plain"), NO_ANSWER, 1),
    "no completion": (reply(GOOD), NO_ANSWER, 1),
    "no choices": (reply('{"choices": []}'), NO_ANSWER, 1),
    "not JSON": (reply("oops"), NO_ANSWER, 1),
    "not UTF-8": (reply(b"\xff\xfe\xfd"), NO_ANSWER, 1),
    "null body": (reply("null"), NO_ANSWER, 1),
    "text in parts": (reply('{"choices": [{"message": {"content": [{"type": "text"}]}}]}'), NO_ANSWER, 1),
    "tool call": (
        reply(
            '{"choices": [{"message": {"tool_calls": [{"function": {"name": "shell"}}], "content": null}}]}'
        ),
        UNREADABLE,
        2,
    ),
    "cut short": (says(GOOD, finish_reason="length"), TOO_LONG, 1),
    "huge": (reply(b" " * (MAX_ANSWER_BYTES + 1)), TOO_LONG, 1),
    "packed": (
        reply(gzip.compress(b" " * 100_000_000), extra="content-encoding: gzip\r\n"),
        NO_ANSWER,
        1,
    ),
    "closed midway": (
        reply('{"choices": [', missing=100),
        "The language model's answer broke off.",
        1,
    ),
    "closed in the head": (Reply("HTTP/1.1 200 O", missing=1), "The language model's answer broke off.", 1),
    "closed at once": (Reply("", missing=1), "The language model's answer broke off.", 1),
    "not HTTP": (Reply("SSH-2.0-OpenSSH\r\n\r\n", missing=1), "The language model's answer broke off.", 1),
}
