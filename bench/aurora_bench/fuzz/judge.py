# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the answer to any text: its numbers are those of the text, and no others.

Numbers are read by `aurora_bench.prompts.numerals`, not by the product's reader.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping

from pydantic import BaseModel

from aurora_bench.prompts.numerals import stated_numbers
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.spec.parameter import Parameter, Provenance, Span
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

_DIGITS = re.compile(
    r'\d{1,3}(?:,\d{3})+(?!\d)|\d+(?:\.\d+)?(?:e[-+]?\d+)?', re.ASCII | re.IGNORECASE
)
# A number as it is written: signed, with groups of thousands and an exponent.
_WRITTEN = re.compile(
    r'(?P<number>(?:(?<!\d)[-−+])?(?:\d{1,3}(?:,\d{3})+|\d+|(?=\.\d))(?:\.\d+)?(?:e[-+]?\d+)?)',
    re.IGNORECASE,
)
# Two numbers with one unit.
_RANGE = re.compile(r'(?P<low>\d[\d.,]*) ?[-–−] ?(?P<high>\d[\d.,]*) ?(?P<unit>[^\d\W].*)')
# What a number may be taken times: a diameter gives a radius, a percentage a share.
_FACTORS = (1.0, 0.5, 0.01)
# What may be numbered, right in front of its number.
_ACTOR = re.compile(
    r'(?:uav|dron+e|quad|quadrotor|quadcopter|copter|multirotor|aircraft|robot|unit|car|van|truck|'
    r'lorry|bus|bike|motorcycle|bicycle|pedestrian|ped|ambulance|police|vehicle|rsu)s?\W{0,2}$',
    re.IGNORECASE,
)
_CLOSE = 1e-6
# `1 h`: the independent reader wants the letter glued to the number.
_HOURS = (1.0, 3600.0)
# `30, 45 and 60 km/h`: the unit behind the last is that of all.
_LISTED = re.compile(
    r'(?:\s*(?:,\s*and|,|and|or|&)\s*\d+(?:\.\d+)?)+\s*(?P<unit>[a-z]+(?:/[a-z]+)?)', re.IGNORECASE
)
# A group beyond this many is cut there: it is refused as too many in any case.
_MOST_AGENTS = 200


def faults(prompt: str, outcome: ParseOutcome) -> Iterator[str]:
    """Return what is wrong with an answer, in words; nothing when all is well."""
    for clause in outcome.clauses:
        if prompt[clause.span.start : clause.span.end] != clause.text:
            yield f'clause text differs from its span: {clause.text!r}'
    spec = outcome.spec
    if spec is None:
        if not outcome.question and not outcome.refusals:
            yield 'neither a specification nor a question nor a refusal'
        return
    if spec.prompt != prompt:
        yield 'the specification holds another prompt'
    yield from _invented(prompt, spec, _corrections(outcome))
    yield from _dropped(prompt, spec, outcome)


def _corrections(outcome: ParseOutcome) -> dict[str, str]:
    """Return the slips of spelling that the answer says it took for other words."""
    notes = ' '.join(c.note for c in outcome.clauses)
    return dict(re.findall(r"read '([^']+)' as '([^']+)'", notes))


def _invented(prompt: str, spec: ScenarioSpec, meant: Mapping[str, str]) -> Iterator[str]:
    for path, parameter in parameters(spec):
        if parameter.provenance is not Provenance.EXPLICIT or parameter.span is None:
            continue
        span = parameter.span
        if span.end > len(prompt):
            yield f'{path}: span {span.start}..{span.end} is outside the prompt'
            continue
        said = ' '.join(prompt[span.start : span.end].split())
        for written, word in meant.items():
            said = said.replace(written, word)
        if not any(c.isdigit() for c in said):
            continue  # a number in words, or a word that stands for one (`north`, `no retries`)
        listed = _LISTED.match(prompt, span.end)
        shared = listed is not None and _says(f'{said} {listed["unit"]}', parameter.value)
        if not shared and not _says(said, parameter.value):
            yield f'{path}: {parameter.value:g} {parameter.unit} is not what {said!r} says'


def _says(said: str, value: float) -> bool:
    """Return whether words with digits state a value: as it stands or with one of their units."""
    ends = _RANGE.fullmatch(said)
    if ends is not None:  # `20-30 ft`: the unit is that of both
        return any(_says(f'{ends[end]} {ends["unit"]}', value) for end in ('low', 'high'))
    units = [abs(n.value) for n in stated_numbers(_plainly(said))]
    bare = [abs(float(n)) for n in _WRITTEN.findall(_ungrouped(said))]
    sums = [sum(units)] if len(units) > 1 else []
    stated = (*units, *bare, *sums)
    signed = '-' in said or '−' in said or value >= 0.0
    return signed and any(
        abs(abs(value) - number * factor * share) <= _CLOSE * max(1.0, abs(value))
        for number in stated
        for factor in _FACTORS
        for share in (_HOURS if re.search(r'\dh\b|\d h\b', said, re.IGNORECASE) else (1.0,))
    )


def _ungrouped(said: str) -> str:
    """Drop the commas between groups of three digits; any other between digits is decimal."""
    grouped = re.sub(r'(?<=\d),(?=\d{3}(?!\d))', '', said)
    return re.sub(r'(?<=\d),(?=\d)', '.', grouped).replace('−', '-')


def _plainly(said: str) -> str:
    """Write numbers without groups, signs and exponents: the independent reader knows none."""
    return _WRITTEN.sub(lambda m: f'{abs(float(m.group())):.15f}', _ungrouped(said))


def _dropped(prompt: str, spec: ScenarioSpec, outcome: ParseOutcome) -> Iterator[str]:
    stated = [p.span for _, p in parameters(spec) if p.span is not None]
    open_clauses = [c.span for c in outcome.clauses if c.status is not ClauseStatus.ENCODED]
    read = [c.span for c in outcome.clauses if c.status is ClauseStatus.ENCODED]
    members = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    flown = {m.id: m.uav for m in spec.missions}
    counts = {len(spec.agents), len(spec.uavs), *Counter(a.type for a in spec.agents).values()}
    for match in _DIGITS.finditer(prompt):
        where = Span(start=match.start(), end=match.end())
        if any(_inside(where, s) for s in stated) or any(_inside(where, c) for c in open_clauses):
            continue
        value = float(match.group().replace(',', ''))
        bodies = [*(a.span for a in spec.agents), *(u.span for u in spec.uavs)]
        made = [span for span in bodies if span is not None]
        cited = [c.ids for c in outcome.clauses if _inside(where, c.span)]
        groups = {sum(_inside(where, s) for s in made)}
        groups |= {len({flown.get(one, one) for one in ids} & members) for ids in cited}
        cut = max(len(spec.agents), len(spec.uavs)) > _MOST_AGENTS
        too_many = value > _MOST_AGENTS and cut
        numbers_someone = (
            value in counts | groups or too_many or _is_name(prompt, match.start(), value)
        )
        if not numbers_someone:
            known = 'encoded' if any(_inside(where, c) for c in read) else 'in no clause'
            yield f'the number {match.group()!r} at {match.start()} went nowhere ({known})'


def _is_name(prompt: str, start: int, value: float) -> bool:
    """Return whether a number only tells actors apart: `drone 2`, `uav1`."""
    named = _ACTOR.search(prompt[:start]) is not None
    return named and value == int(value) and 1 <= value <= _MOST_AGENTS


def _inside(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end


def parameters(value: object, path: str = '') -> Iterator[tuple[str, Parameter]]:
    """Return every parameter of a document with its path."""
    if isinstance(value, Parameter):
        yield path, value
    elif isinstance(value, BaseModel):
        for name, inner in value:
            yield from parameters(inner, f'{path}/{name}')
    elif isinstance(value, tuple):
        for k, inner in enumerate(value):
            yield from parameters(inner, f'{path}/{k}')
