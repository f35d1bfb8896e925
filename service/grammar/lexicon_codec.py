"""A lexicon as plain data, and back: what a cache can keep without running anything when it is read."""

from __future__ import annotations

from typing import Any

from service.grammar.lexicon import Lexicon, Node, Sense


def pack(lexicon: Lexicon) -> dict[str, Any]:
    """A lexicon as dicts, lists, tuples and strings; nodes name each other by number."""
    nodes: list[tuple[Any, ...]] = []
    numbers: dict[int, int] = {}

    def number(node: Node) -> int:
        known = numbers.get(id(node))
        if known is None:
            after = {word: number(each) for word, each in node.next.items()}
            senses = None if node.senses is None else list(map(tuple, node.senses))
            split = None
            if node.split is not None:
                split = [(whole, list(map(tuple, each))) for whole, each in node.split.items()]
            known = numbers[id(node)] = len(nodes)
            nodes.append((after, senses, split))
        return known

    number(lexicon.root)
    return {
        "nodes": nodes,
        "words": sorted(lexicon.words),
        "concepts": {concept: sorted(forms) for concept, forms in lexicon.concepts.items()},
        "begins": {concept: sorted(words) for concept, words in lexicon.begins.items()},
        "typical": lexicon.typical,
    }


def unpack(packed: dict[str, Any]) -> Lexicon:
    """The lexicon that was packed; it takes no more phrases."""
    nodes: list[Node] = []
    for after, senses, split in packed["nodes"]:
        nodes.append(
            Node(
                {word: nodes[at] for word, at in after.items()},
                None if senses is None else [Sense(*each) for each in senses],
                None
                if split is None
                else {whole: [Sense(*each) for each in senses] for whole, senses in split},
            )
        )
    lexicon = Lexicon({})
    lexicon.root = nodes[-1]
    lexicon.words = set(packed["words"])
    lexicon.concepts = {concept: set(forms) for concept, forms in packed["concepts"].items()}
    lexicon.begins = {concept: set(words) for concept, words in packed["begins"].items()}
    lexicon.typical = packed["typical"]
    return lexicon
