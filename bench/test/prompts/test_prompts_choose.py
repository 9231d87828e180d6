# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped split follows from the pools by rule, and holds what the data card promises."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from aurora_bench.prompts.choose import BEHAVIORAL, Pools, choose, main
from aurora_bench.prompts.format import AnnotatedPrompt, flat
from aurora_bench.prompts.paraphrases import check_split
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import FIRST, FOURTH, SECOND, THIRD, Split, prompt_file
from aurora_bench.prompts.validate import validate

SPLITS: tuple[Split, Split] = ('tune', 'held_out')


def shipped(split: Split, *parts: str) -> list[AnnotatedPrompt]:
    """Return the prompts of some files of one split."""
    return [p for part in parts for p in read_prompts(prompt_file(split, part))]


BENCH: dict[Split, list[AnnotatedPrompt]] = {split: shipped(split, 'bench') for split in SPLITS}
ALL = [p for part in BENCH.values() for p in part]


def pools() -> Pools:
    """Return what the choice was made from."""
    return {split: shipped(split, 'bench', 'more') for split in SPLITS}


def test_every_shipped_file_is_in_order_and_no_group_is_on_both_sides() -> None:
    parts: dict[Split, tuple[str, ...]] = {
        'tune': (*FIRST, SECOND, THIRD, FOURTH),
        'held_out': (*FIRST, THIRD),
    }
    texts = {
        split: [prompt_file(split, part).read_text('utf-8') for part in names]
        for split, names in parts.items()
    }
    prompts, findings = validate([*texts['tune'], *texts['held_out']])
    assert [str(f) for f in findings if f.is_error] == []
    assert len(prompts) == 1122
    assert check_split(validate(texts['tune'])[0], validate(texts['held_out'])[0]) == []


def test_the_first_three_hundred_prompts_are_all_there() -> None:
    assert [len(shipped(split, *FIRST)) for split in SPLITS] == [200, 100]
    assert [len(shipped(split, 'multi_uav')) for split in SPLITS] == [14, 6]


def test_the_benchmark_has_the_size_and_the_balance_of_the_card() -> None:
    assert [len(BENCH[split]) for split in SPLITS] == [120, 80]
    assert sum(len(p.requirements) for p in ALL) >= 904
    assert set(Counter(p.category for p in ALL).values()) == {16, 17}
    reasons = {r.because for p in ALL for r in flat(p.requirements) if r.kind == 'reject'}
    assert len(reasons) == 15


def test_fifty_prompts_are_executed() -> None:
    executed = Counter(p.category for p in ALL if p.end_to_end)
    assert executed.pop('boundary') == executed.pop('infeasible') == 5
    assert set(executed) == set(BEHAVIORAL)
    assert len(BEHAVIORAL) == 9
    assert sum(executed.values()) == 40
    assert min(executed.values()) >= 4


@pytest.mark.parametrize('split', SPLITS)
def test_paraphrase_groups_are_whole(split: Split) -> None:
    inside = {p.paraphrase_group for p in BENCH[split]} - {None}
    outside = {p.paraphrase_group for p in shipped(split, 'more', 'multi_uav')}
    assert inside
    assert inside & outside == set()


def test_the_choice_can_be_repeated() -> None:
    choice = choose(pools())
    for split in SPLITS:
        assert choice.chosen[split] == {p.id for p in BENCH[split]}
        assert choice.executed[split] == {p.id for p in BENCH[split] if p.end_to_end}


def test_a_pool_without_enough_prompts_is_said_so() -> None:
    small: Pools = {**pools(), 'held_out': BENCH['held_out'][:79]}
    with pytest.raises(ValueError, match='expected 80 prompts for held_out'):
        choose(small)


def test_written_again_the_files_stay_what_they_are(tmp_path: Path) -> None:
    for split in SPLITS:
        (tmp_path / split).mkdir()
        for part in ('bench', 'more'):
            text = prompt_file(split, part).read_bytes()
            (tmp_path / split / f'{part}.jsonl').write_bytes(text)
    assert main([str(tmp_path)]) == 0
    for split in SPLITS:
        for part in ('bench', 'more'):
            written = (tmp_path / split / f'{part}.jsonl').read_bytes()
            assert written == prompt_file(split, part).read_bytes()
