# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model is asked: rules, vocabulary, the map's places, worked examples, and the prompt."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import lru_cache

from pydantic import JsonValue

from aurora_core.document import Document
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.notation import form_text, schema_text
from aurora_core.parsing.llm.operands import table
from aurora_core.parsing.llm.reading import Reading
from aurora_core.parsing.tokens import TokenKind, tokenize
from aurora_core.ports.language_model import Message, ModelRequest
from aurora_core.retrieval.background import Background
from aurora_core.spec.vocabulary import Place

# A large map has more named places than a prompt could mean.
_MOST_LANDMARKS = 40
_FEW_LANDMARKS = 15
# Landmarks stand with the places; what was measured says nothing about words.
_OF_THE_MAP = ('active', 'all', 'description', 'no_fly_zones', 'streets')
_EXAMPLES = 2


class Example(Document):
    """A prompt and a good answer to it."""

    prompt: str
    answer: Reading


@lru_cache(maxsize=1)
def examples() -> tuple[Example, ...]:
    """Return the worked examples."""
    rows = read_data('llm/examples.yaml')['examples']
    return tuple(Example.model_validate_json(json.dumps(row)) for row in rows)


def first_request(
    facts: PromptFacts, background: Background | None = None, *, short: bool = False
) -> ModelRequest:
    """Return the first turn for a prompt.

    Args:
        facts: The prompt and its map.
        background: What is shown beside them.
        short: Fewer rules, one example and no background.
    """
    system = _short(facts) if short else _system(facts, background)
    examples_ = _shown(facts.prompt, 1 if short else _EXAMPLES)
    told = (Message(role='system', content=system), *examples_)
    return ModelRequest(
        messages=(*told, Message(role='user', content=_as_data(facts.prompt))),
        schema_text=schema_text(),
    )


def with_feedback(request: ModelRequest, reply: str, complaints: Sequence[str]) -> ModelRequest:
    """Return the next turn: the model's own answer, and what is wrong with it."""
    points = '\n'.join(f'- {complaint}' for complaint in complaints)
    text = read_data('llm/instructions.yaml')['feedback'] + points
    return ModelRequest(
        messages=(
            *request.messages,
            Message(role='assistant', content=reply),
            Message(role='user', content=text),
        ),
        schema_text=request.schema_text,
    )


def _system(facts: PromptFacts, background: Background | None) -> str:
    data = read_data('llm/instructions.yaml')
    return '\n'.join(
        (
            data['rules'].rstrip(),
            data['triggers'].rstrip(),
            data['operands'].rstrip() + ' ' + table(),
            _known(facts, _MOST_LANDMARKS),
            *(() if background is None else _told(background, facts.prompt, data['background'])),
            _form(),
        )
    )


def _short(facts: PromptFacts) -> str:
    data = read_data('llm/instructions.yaml')
    rules = data['short'].rstrip()
    operands = data['operands'].rstrip() + ' ' + table()
    return '\n'.join((rules, operands, _known(facts, _FEW_LANDMARKS), _form()))


def _known(facts: PromptFacts, most: int) -> str:
    names = facts.context.landmark_names
    known = len(names) - facts.context.grounds
    # Of areas and stops a map may have hundreds: those that the prompt names will do.
    named = {atom.noun.key for atom in facts.places if atom.noun is not None}
    offered = (*names[:known], *(name for name in names[known:] if name in named))
    landmarks = _nearest(offered, facts.prompt, most)
    places = [p.value for p in Place] + [f'landmark:{name}' for name in landmarks]
    return 'Known here: ' + json.dumps({'map': facts.context.map_name, 'places': places})


def _form() -> str:
    return 'Form (? may be left out):\n' + form_text()


def _told(background: Background, prompt: str, rules: str) -> tuple[str, ...]:
    return (
        rules.rstrip(),
        'Registries: ' + json.dumps(_registries(background, prompt), ensure_ascii=False),
        'Retrieved: ' + background.selected_text(),
    )


def _registries(background: Background, prompt: str) -> dict[str, JsonValue]:
    """Return what of the registries helps to read: the form holds the vocabulary."""
    found: dict[str, JsonValue] = {}
    for record in background.registries:
        if record.id == 'maps':
            told = {name: value for name, value in record.data.items() if name in _OF_THE_MAP}
            streets = told.get('streets')
            if isinstance(streets, list):
                told['streets'] = [*_nearest([str(s) for s in streets], prompt, _MOST_LANDMARKS)]
            found[record.id] = told
        elif record.id != 'vocabulary':
            found[record.id] = record.data
    return found


def _shown(prompt: str, most: int) -> tuple[Message, ...]:
    """Return the examples that are most like the prompt, the closest last."""
    by_prompt = {example.prompt: example for example in examples()}
    chosen = _nearest(tuple(by_prompt), prompt, most)
    turns: list[Message] = []
    for text in reversed(chosen):
        answer = by_prompt[text].answer.model_dump_json(exclude_defaults=True)
        turns += [
            Message(role='user', content=_as_data(text)),
            Message(role='assistant', content=answer),
        ]
    return tuple(turns)


def _as_data(prompt: str) -> str:
    """Quote a prompt so that nothing in it can end the quotation."""
    return json.dumps({'prompt': prompt}, ensure_ascii=False)


def _nearest(texts: Sequence[str], prompt: str, most: int) -> tuple[str, ...]:
    """Return the texts that share most of their words with the prompt, in a fixed order."""
    wanted = _words(prompt)

    def likeness(text: str) -> float:
        words = _words(text.replace('_', ' '))
        return len(words & wanted) / max(1, len(words | wanted))

    return tuple(sorted(texts, key=lambda text: (-likeness(text), text))[:most])


def _words(text: str) -> frozenset[str]:
    return frozenset(t.norm for t in tokenize(text) if t.kind is TokenKind.WORD)
