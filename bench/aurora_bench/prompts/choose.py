# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.prompts.choose DATA`: which prompts are AURORA-Bench, by rule and seed.

120 prompts of the pool to tune on and 80 of the pool only to measure, over twelve categories as
even as the pools allow. Paraphrase groups are taken whole or not at all. Nobody picks: within a
category groups and single prompts come in the order of a hash of seed and name, refusals whose
reason is not there yet first. The seed is the first one whose choice has 904 requirements.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.prompts.documents import Doc, read_documents, write_documents
from aurora_bench.prompts.format import AnnotatedPrompt, flat
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import Split

CATEGORIES = (
    'hover', 'track', 'patrol', 'spatial', 'multi_agent', 'environment', 'communication',
    'perception', 'sequential', 'conditional', 'boundary', 'infeasible',
)  # fmt: skip
SIZES: dict[Split, int] = {'tune': 120, 'held_out': 80}
REQUIREMENTS = 904
# Executed, not only parsed: 30 and 20. A bare hover has no behaviour of its own and is the first
# phase of many sequences, so it is the category that the forty behavioural ones leave out.
BEHAVIORAL = CATEGORIES[1:10]
EXECUTED: dict[Split, dict[str, int]] = {
    'tune': {'behavioral': 24, 'boundary': 3, 'infeasible': 3},
    'held_out': {'behavioral': 16, 'boundary': 2, 'infeasible': 2},
}
_MOST_SEEDS = 1000

Pools = dict[Split, Sequence[AnnotatedPrompt]]


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Ids of the benchmark and, of those, the ids that are executed."""

    seed: int
    chosen: dict[Split, frozenset[str]]
    executed: dict[Split, frozenset[str]]


def choose(pools: Pools) -> Choice:
    """Return the choice of the first seed that gives enough requirements.

    Raises:
        ValueError: No seed does, or a pool is too small.
    """
    counts = _quotas(pools)
    for seed in range(1, _MOST_SEEDS + 1):
        chosen = {split: _chosen(pools[split], counts[split], seed) for split in SIZES}
        if sum(len(p.requirements) for part in chosen.values() for p in part) >= REQUIREMENTS:
            executed = {split: _executed(chosen[split], split, seed) for split in SIZES}
            return Choice(
                seed=seed,
                chosen={s: frozenset(p.id for p in part) for s, part in chosen.items()},
                executed={s: frozenset(p.id for p in part) for s, part in executed.items()},
            )
    raise ValueError(f'expected a choice with {REQUIREMENTS} requirements, found none')


def _quotas(pools: Pools) -> dict[Split, Counter[str]]:
    """Give one place after the other to the category that has least so far, of both splits."""
    counts: dict[Split, Counter[str]] = {'tune': Counter(), 'held_out': Counter()}
    # The smaller pool first: the larger one evens out what it lacks.
    for split in ('held_out', 'tune'):
        stock = Counter[str](p.category for p in pools[split])
        for _ in range(SIZES[split]):
            open_ones = [c for c in CATEGORIES if counts[split][c] < stock[c]]
            if not open_ones:
                raise ValueError(f'expected {SIZES[split]} prompts for {split}, found fewer')
            total = {c: counts['tune'][c] + counts['held_out'][c] for c in open_ones}
            spare = {c: stock[c] - counts[split][c] for c in open_ones}
            counts[split][min(open_ones, key=lambda c: (total[c], -spare[c]))] += 1
    return counts


def _chosen(
    pool: Sequence[AnnotatedPrompt], quota: Counter[str], seed: int
) -> list[AnnotatedPrompt]:
    found: list[AnnotatedPrompt] = []
    for category in CATEGORIES:
        left = quota[category]
        units = _units([p for p in pool if p.category == category], seed)
        for k, unit in enumerate(units):
            if left - len(unit) in _sums(units[k + 1 :]):
                found += unit
                left -= len(unit)
        if left:
            raise ValueError(f'expected {quota[category]} prompts of {category} in whole groups')
    return found


def _sums(units: Sequence[Sequence[AnnotatedPrompt]]) -> set[int]:
    """Return how many prompts some of these units can have together."""
    sums = {0}
    for unit in units:
        sums |= {n + len(unit) for n in sums}
    return sums


def _units(prompts: Sequence[AnnotatedPrompt], seed: int) -> list[list[AnnotatedPrompt]]:
    """Return groups and single prompts in their order."""
    units: dict[str, list[AnnotatedPrompt]] = {}
    for prompt in sorted(prompts, key=lambda p: p.id):
        units.setdefault(prompt.paraphrase_group or prompt.id, []).append(prompt)
    waiting = sorted(units, key=lambda name: _hash(seed, name))
    ordered: list[list[AnnotatedPrompt]] = []
    seen: set[str] = set()
    while waiting:
        name = next((n for n in waiting if _reasons(units[n]) - seen), waiting[0])
        waiting.remove(name)
        seen |= _reasons(units[name])
        ordered.append(units[name])
    return ordered


def _executed(chosen: Sequence[AnnotatedPrompt], split: Split, seed: int) -> list[AnnotatedPrompt]:
    """Take turns over the categories; one of a group, marked ones first, new reasons first."""
    # The two splits begin at opposite ends, so that what is left over evens out.
    turns_over = BEHAVIORAL if split == 'tune' else BEHAVIORAL[::-1]
    ways = {'behavioral': turns_over, 'boundary': ('boundary',), 'infeasible': ('infeasible',)}
    found: list[AnnotatedPrompt] = []
    for way, number in EXECUTED[split].items():
        queues = [_queue([p for p in chosen if p.category == c], seed) for c in ways[way]]
        turns = (queue.pop(0) for _ in range(number) for queue in queues if queue)
        found += [prompt for prompt, _ in zip(turns, range(number), strict=False)]
    return found


def _queue(prompts: Sequence[AnnotatedPrompt], seed: int) -> list[AnnotatedPrompt]:
    ranked = sorted(prompts, key=lambda p: (not p.end_to_end, _hash(seed, p.id)))
    queue: list[AnnotatedPrompt] = []
    again: list[AnnotatedPrompt] = []
    for prompt in ranked:
        is_new = not (_reasons([prompt]) and _reasons([prompt]) <= _reasons(queue))
        if prompt.paraphrase_group is None or prompt.paraphrase_group not in {
            p.paraphrase_group for p in (*queue, *again)
        }:
            (queue if is_new else again).append(prompt)
    return [*queue, *again]


def _reasons(prompts: Sequence[AnnotatedPrompt]) -> set[str]:
    return {r.because for p in prompts for r in flat(p.requirements) if r.kind == 'reject'}


def _hash(seed: int, name: str) -> str:
    return hashlib.sha256(f'{seed}:{name}'.encode()).hexdigest()


def main(arguments: Sequence[str] | None = None) -> int:
    """Write `bench.jsonl` and `more.jsonl` of both splits from what the two hold together."""
    parser = argparse.ArgumentParser(prog='aurora_bench.prompts.choose', description=__doc__)
    parser.add_argument('data', type=Path, help='folder with tune/ and held_out/')
    data: Path = parser.parse_args(arguments).data
    files = {s: [data / s / f'{part}.jsonl' for part in ('bench', 'more')] for s in SIZES}
    choice = choose({s: [p for path in files[s] for p in read_prompts(path)] for s in SIZES})
    for split, paths in files.items():
        documents = sorted((d for path in paths for d in read_documents(path)), key=_place)
        chosen = [d for d in documents if d['id'] in choice.chosen[split]]
        for document in chosen:
            document['end_to_end'] = document['id'] in choice.executed[split]
        others = [d for d in documents if d['id'] not in choice.chosen[split]]
        for path, part in zip(paths, (chosen, others), strict=True):
            write_documents(path, part)
    sys.stdout.write(f'seed {choice.seed}\n')
    return 0


def _place(document: Doc) -> tuple[int, str]:
    return CATEGORIES.index(document['category']), document['id']


if __name__ == '__main__':
    sys.exit(main())
