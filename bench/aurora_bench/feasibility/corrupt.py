# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Certificates with one thing wrong in them, or held up against another request.

Every change makes the certificate say something untrue: a re-check that accepts it is at fault.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from aurora_bench.feasibility.judge import Judged
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.recheck import recheck

Doc = dict[str, Any]
_Change = Callable[[Doc, random.Random], str | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Corrupted:
    """One corrupted certificate and what the re-check says of it."""

    id: str
    what: str
    accepted: bool


def corrupted(results: Sequence[Judged], count: int, seed: int) -> tuple[Corrupted, ...]:
    """Corrupt certificates that were accepted, each in another way, and check them again.

    Args:
        results: Of the ruler.
        count: So many, fewer where there are not so many.
        seed: Which ones.
    """
    draw = random.Random(seed)
    found = [c for r in results for c in _changed(r, draw)] + list(_exchanged(results))
    return tuple(draw.sample(found, min(count, len(found))))


def _changed(result: Judged, draw: random.Random) -> Iterator[Corrupted]:
    for proof, valid in zip(result.certificates, result.valid, strict=True):
        for name, change in _CHANGES if valid else ():
            document = proof.model_dump(mode='json')
            what = change(document, draw)
            if what is None:
                continue
            try:
                forged = Certificate.model_validate(document)
            except ValidationError:
                continue  # a certificate that cannot be read is refused by its schema
            accepted = recheck(forged, result.document).valid
            yield Corrupted(id=result.case.id, what=f'{name}: {what}', accepted=accepted)


def _exchanged(results: Sequence[Judged]) -> Iterator[Corrupted]:
    """Hold the certificate of a request against the one that may be: the next of its family."""
    kept = {(r.case.source, _family(r.case.id)): r for r in results if not r.case.must_be_refused}
    for result in results:
        other = kept.get((result.case.source, _family(result.case.id)))
        if other is None or other.refused or result.case.source == 'prompt':
            continue
        for proof, valid in zip(result.certificates, result.valid, strict=True):
            if valid and proof.listing == ():
                accepted = recheck(proof, other.document).valid
                yield Corrupted(id=result.case.id, what='of another request', accepted=accepted)


def _family(ident: str) -> str:
    for mark in ('-refused', '-kept', '-over:', '-kept:'):
        ident = ident.replace(mark, '-')
    return ident.rpartition('-')[0] if ident[-1:].isdigit() and ':' not in ident else ident


def _requested(proof: Doc, draw: random.Random) -> str | None:
    if proof['requested'] is None:
        return None
    proof['requested'] = proof['requested'] + draw.choice((-1.0, 1.0, 7.5))
    return f'requested {proof["requested"]:g}'


def _limit(proof: Doc, draw: random.Random) -> str | None:
    if proof['limit'] is None:
        return None
    proof['limit'] = proof['limit'] * draw.choice((0.5, 0.9, 1.1))
    return f'limit {proof["limit"]:g}'


def _path(proof: Doc, draw: random.Random) -> str | None:
    if proof['listing']:
        return None
    parts = proof['path'].split('/')
    parts[min(1, len(parts) - 1)] = draw.choice(('nobody', 'nothing', 'uav99'))
    proof['path'] = '/'.join(parts)
    return f'path {proof["path"]}'


def _fact(proof: Doc, draw: random.Random) -> str | None:
    numbers = [f for f in proof.get('facts', ()) if isinstance(f['value'], float)]
    if not numbers:
        return None
    fact = draw.choice(numbers)
    fact['value'] += draw.choice((-3.0, 2.0))
    return f'{fact["path"]} = {fact["value"]:g}'


def _fact_path(proof: Doc, draw: random.Random) -> str | None:
    facts = proof.get('facts', ())
    if not facts:
        return None
    fact = draw.choice(facts)
    fact['path'] += '_x'
    return f'fact {fact["path"]}'


def _tightened(proof: Doc, draw: random.Random) -> str | None:
    chain = [b for b in proof.get('chain', ()) if b['least_s'] is not None]
    if not chain:
        return None
    bound = draw.choice(chain)
    bound['least_s'] += 4.0
    return f'{bound["of"]} at least {bound["least_s"]:g} s'


def _shortened(proof: Doc, draw: random.Random) -> str | None:
    chain = proof.get('chain', ())
    if len(chain) < 3:
        return None
    gone = chain.pop(draw.randrange(len(chain)))
    return f'without {gone["of"]} {gone["kind"]}'


def _rule(proof: Doc, draw: random.Random) -> str | None:
    if proof.get('rule') is None:
        return None
    timely = bool(proof.get('chain'))
    others = (Rule.ZONE, Rule.PURSUIT, Rule.STACKING) if timely else (Rule.ORDER, Rule.DEADLINE)
    proof['rule'] = draw.choice(others).value
    return f'rule {proof["rule"]}'


def _listing(proof: Doc, draw: random.Random) -> str | None:
    if not proof['listing']:
        return None
    gone = draw.choice(proof['listing'])
    proof['listing'] = [e for e in proof['listing'] if e != gone]
    return f'the list lacks {gone}'


def _word(proof: Doc, draw: random.Random) -> str | None:
    if not proof['listing']:
        return None
    proof['word'] = draw.choice(proof['listing'])
    return f'{proof["word"]} is missing'


def _span(proof: Doc, _draw: random.Random) -> str | None:
    if proof['span'] is None:
        return None
    proof['span'] = {'start': 100_000, 'end': 100_010}
    return 'words beyond the prompt'


def _nearest(proof: Doc, draw: random.Random) -> str | None:
    if not proof.get('mends'):
        return None
    mend = draw.choice(proof['mends'])
    mend['nearest'] += draw.choice((-5.0, -1.0, 1.0, 5.0))
    return f'nearest {mend["nearest"]:g}'


def _clause(proof: Doc, _draw: random.Random) -> str | None:
    if not proof.get('clauses'):
        return None
    proof['clauses'][0] = 'what nobody has said'
    return 'a clause that nobody said'


_CHANGES: tuple[tuple[str, _Change], ...] = (
    ('requested', _requested),
    ('limit', _limit),
    ('path', _path),
    ('fact', _fact),
    ('fact path', _fact_path),
    ('bound', _tightened),
    ('chain', _shortened),
    ('rule', _rule),
    ('list', _listing),
    ('word', _word),
    ('span', _span),
    ('clause', _clause),
    ('nearest', _nearest),
)
