# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model is asked: rules, vocabulary, the map's places, worked examples, and the prompt."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from aurora_core.document import Document
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.reading import Reading
from aurora_core.parsing.tokens import TokenKind, tokenize
from aurora_core.ports.language_model import Message, ModelRequest
from aurora_core.retrieval.background import Background
from aurora_core.spec.vocabulary import AgentType, Place

# A large map has more named places than a prompt could mean.
_MOST_LANDMARKS = 40
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


@lru_cache(maxsize=1)
def schema_text() -> str:
    """Return the JSON Schema of an answer, without the titles that repeat its names."""
    return json.dumps(_untitled(Reading.model_json_schema()), sort_keys=True)


def _untitled(schema: Any) -> Any:
    if isinstance(schema, dict):
        return {
            name: _untitled(value)
            for name, value in schema.items()
            if name not in ('title', 'description')
        }
    return [_untitled(one) for one in schema] if isinstance(schema, list) else schema


def first_request(facts: PromptFacts, background: Background | None = None) -> ModelRequest:
    """Return the first turn for a prompt.

    Args:
        facts: The prompt and its map.
        background: What is shown beside them.
    """
    told = (Message(role='system', content=_system(facts, background)), *_shown(facts.prompt))
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
    landmarks = _nearest(facts.context.landmark_names, facts.prompt, _MOST_LANDMARKS)
    known = {
        'map': facts.context.map_name,
        'agent_types': [t.value for t in AgentType],
        'places': [p.value for p in Place] + [f'landmark:{name}' for name in landmarks],
    }
    return '\n'.join(
        (
            data['rules'],
            'Triggers and effects.',
            data['triggers'],
            'Known here: ' + json.dumps(known),
            *(() if background is None else _told(background, data['background'])),
            'Schema: ' + schema_text(),
        )
    )


def _told(background: Background, rules: str) -> tuple[str, ...]:
    return (
        rules.rstrip(),
        'Registries: ' + background.registries_text(),
        'Retrieved: ' + background.selected_text(),
    )


def _shown(prompt: str) -> tuple[Message, ...]:
    """Return the examples that are most like the prompt, the closest last."""
    by_prompt = {example.prompt: example for example in examples()}
    chosen = _nearest(tuple(by_prompt), prompt, _EXAMPLES)
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
