# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The totals that the data card gives are those of the files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import cast

import pytest

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import FIRST, Split, prompt_file

CARD = (Path(__file__).resolve().parents[3] / 'docs/bench/prompts.md').read_text('utf-8')
SPLITS: tuple[Split, Split] = ('tune', 'held_out')
FILE = re.compile(r'`(tune|held_out)/(\w+)\.jsonl`')


def table() -> dict[tuple[Split, str], tuple[int, int]]:
    """Return prompts and requirements that the first table of the card gives each file."""
    found: dict[tuple[Split, str], tuple[int, int]] = {}
    rows = [
        line.split('|')[1:4]
        for line in CARD.splitlines()
        if line.startswith(('| `tune/', '| `held_out/'))
    ]
    for files, prompts, requirements in rows:
        named = FILE.findall(files)
        counts = zip(prompts.split(','), requirements.split(','), strict=True)
        for (split, part), (number, required) in zip(named, counts, strict=True):
            found[cast(Split, split), part] = int(number), int(required)
    return found


def shipped(split: Split, *parts: str) -> list[AnnotatedPrompt]:
    """Return the prompts of some files of one split."""
    return [p for part in parts for p in read_prompts(prompt_file(split, part))]


def test_the_table_names_every_file() -> None:
    folder = prompt_file('tune', 'bench').parents[1]
    there = {(path.parent.name, path.stem) for path in folder.glob('*/*.jsonl')}
    assert set(table()) == there


@pytest.mark.parametrize(('split', 'part'), table())
def test_a_file_has_the_totals_of_its_row(split: Split, part: str) -> None:
    prompts = shipped(split, part)
    counts = (len(prompts), sum(len(p.requirements) for p in prompts))
    assert counts == table()[split, part]


def test_the_text_about_the_benchmark_is_true() -> None:
    tune, held_out = (shipped(split, 'bench') for split in SPLITS)
    both = [*tune, *held_out]
    required = [r for p in both for r in p.requirements]
    assert (
        f'is {len(both)} prompts, {len(tune)} to tune on and {len(held_out)} only to measure'
    ) in CARD
    assert f'with {len(required)} annotated requirements' in CARD
    groups = [p.paraphrase_group for p in both if p.paraphrase_group is not None]
    assert f'{len(set(groups))} paraphrase groups hold {len(groups)} of the prompts' in CARD
    marked = [sum(p.end_to_end for p in part) for part in (tune, held_out)]
    assert f'{sum(marked)} ({marked[0]} and {marked[1]}) are marked `end_to_end`' in CARD
    links, orders = (sum(r.kind == kind for r in required) for kind in ('link', 'order'))
    assert f'Few links ({links}) and orders ({orders} of {len(required)})' in CARD


def test_the_text_about_references_and_realizations_is_true() -> None:
    parts = [shipped(split, *FIRST) for split in SPLITS]
    first = [p for part in parts for p in part]
    assert f'({sum(p.reference is not None for p in first)}) has a `reference`' in CARD
    marked = [[p for p in part if p.end_to_end and p.reference is not None] for part in parts]
    flown = [[p for p in part if p.category != 'multi_uav'] for part in marked]
    asked, shown = [len(part) for part in flown], [_realized(part) for part in flown]
    assert (
        f'{sum(shown)} are verified and have a `realization`: {shown[0]} of the {asked[0]} to '
        f'tune on and {shown[1]} of the {asked[1]} held-out ones'
    ) in CARD
    assert f'shown for {sum(shown)} of the {sum(asked)} that are not refusals' in CARD
    several = [p for part in marked for p in part if p.category == 'multi_uav']
    assert f'Of the {len(several)} that `multi_uav` marks {_realized(several)} are' in CARD


def _realized(prompts: list[AnnotatedPrompt]) -> int:
    return sum(p.realization is not None for p in prompts)
