# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The hand-made families of requests, filled with their values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from importlib.resources import files
from typing import Any

import yaml

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_core.spec.scenario import ScenarioSpec

_FAMILIES = 'families.yaml'
# Requests as people type them, by two authors.
_TYPED = {'typed': 'typed.yaml', 'second': 'second.yaml'}


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One request and what has to become of it.

    Attributes:
        id: Family or push, with its number.
        source: `prompt`, `typed` and `second` are read by the offline parser; `annotation`, `push`
            and `reference` are specifications.
        because: Fair reasons to refuse it; empty for what must not be refused.
        spec: None for a prompt.
        document: The annotation: of a specification, that it was built from; of a prompt, what it
            says; empty where there is none.
    """

    id: str
    source: str
    prompt: str
    because: tuple[str, ...]
    spec: ScenarioSpec | None = None
    document: Mapping[str, Any] = field(default_factory=dict)

    @property
    def must_be_refused(self) -> bool:
        """Whether it cannot be."""
        return bool(self.because)


def family_cases() -> Iterator[Case]:
    """Yield every request of the families, as a prompt and, where it is annotated, as a request.

    Raises:
        ValueError: A family is not well-formed.
    """
    for family in _rows(_FAMILIES):
        because = tuple(family['because'])
        for side, reasons in (('refused', because), ('kept', ())):
            for k, value in enumerate(family[side], start=1):
                gaps = value if isinstance(value, dict) else {'v': value}
                ident = f'{family["id"]}-{side}-{k}'
                text = family['prompt'].format(**gaps)
                if 'requirements' not in family:
                    yield Case(id=ident, source='prompt', prompt=text, because=reasons)
                    continue
                document = _annotated(ident, text, family['requirements'], gaps)
                read = Case(
                    id=ident, source='prompt', prompt=text, because=reasons, document=document
                )
                spec = reference_spec(AnnotatedPrompt.model_validate(document), judged=True)
                yield read
                yield replace(read, source='annotation', spec=spec)


def typed_cases() -> Iterator[Case]:
    """Yield the requests as people type them: first what cannot be, then what can.

    A reason may be several that are fair, with spaces between them.
    """
    for source, file in _TYPED.items():
        typed = _rows(file)
        for side, name in (('cannot', 'refused'), ('can', 'kept')):
            for k, row in enumerate(typed[side], start=1):
                because = tuple(row['because'].split()) if side == 'cannot' else ()
                ident = f'{row["because"].split()[0]}-{name}-{k}'
                yield Case(id=ident, source=source, prompt=row['prompt'].strip(), because=because)


def _rows(file: str) -> Any:
    """Return what a file of this package holds; they have thousands of lines."""
    loader = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)  # in C: a tenth of the time
    text = files(__package__).joinpath(file).read_text('utf-8')
    return yaml.load(text, Loader=loader)  # noqa: S506  # nosec B506


def _annotated(
    ident: str, text: str, requirements: list[dict[str, Any]], gaps: Mapping[str, Any]
) -> dict[str, Any]:
    asked = [_filled(r, gaps) for r in requirements]
    return {
        'id': ident,
        'category': 'boundary',
        'prompt': text,
        'feasibility': 'boundary',
        'paraphrase_group': None,
        'end_to_end': False,
        'requirements': [
            {'id': f'r{k}', **r}
            for k, r in enumerate(asked, start=1)
            if r.get('value') != ''  # an empty gap asks for nothing
        ],
    }


def _filled(value: Any, gaps: Mapping[str, Any]) -> Any:
    """Return a part of a requirement with its gaps filled; what is a number then becomes one."""
    if isinstance(value, dict):
        return {name: _filled(inner, gaps) for name, inner in value.items()}
    if isinstance(value, list):
        return [_filled(inner, gaps) for inner in value]
    if not isinstance(value, str) or '{' not in value:
        return value
    text = value.format(**gaps)
    first, _, factor = text.partition(' * ')
    first, _, divisor = first.partition(' / ')
    try:
        number = float(first) * float(factor or 1.0) / float(divisor or 1.0)
    except ValueError:
        return text
    return int(number) if number.is_integer() else number
