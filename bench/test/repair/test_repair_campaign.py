# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aurora_bench.repair.__main__ import USAGE, main
from aurora_bench.repair.campaign import Episode, with_settings
from aurora_bench.repair.faults import Fault, faults, with_fault
from aurora_bench.repair.kinds import KINDS, PLACE
from aurora_bench.repair.tables import goals, last_line
from aurora_core.agsg.parameters import parameters_of
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.repair.settings import load_repair_settings
from aurora_core.spec.parameter import Provenance


def _one_of_each(attempt: int) -> list[Fault]:
    return [fault.drawn(attempt) for fault in faults(len(KINDS), 3)]


def test_faults_are_drawn_of_all_kinds_and_alike_for_a_seed() -> None:
    first = [fault.drawn(0) for fault in faults(2 * len(KINDS), 1)]
    assert first == [fault.drawn(0) for fault in faults(2 * len(KINDS), 1)]
    assert first != [fault.drawn(0) for fault in faults(2 * len(KINDS), 2)]
    assert {fault.kind for fault in first} == {kind.name for kind in KINDS}


def test_another_draw_is_another_request_of_the_same_fault() -> None:
    for first, second in zip(_one_of_each(0), _one_of_each(1), strict=True):
        assert (first.key, first.kind, first.cause) == (second.key, second.kind, second.cause)
        assert first != second


@pytest.mark.parametrize('fault', _one_of_each(0), ids=lambda fault: fault.kind)
def test_a_fault_is_what_the_request_has_as_its_default(fault: Fault) -> None:
    known = installed_knowledge()
    spec, cause = with_fault(known, fault, 'downtown')
    found = {path: parameter for path, _, parameter in parameters_of(spec)}
    for end, value in fault.values.items():
        [parameter] = [p for path, p in found.items() if path.endswith(end)]
        assert parameter.value == value
        assert parameter.provenance is not Provenance.EXPLICIT
    mended, _ = with_fault(known, fault, 'downtown', good=True)
    if fault.cause == PLACE:
        assert mended == spec
    else:
        assert mended != spec
    # A cause that is stated is a word of the prompt: locked, and no parameter of its own name.
    assert (cause in (*found, PLACE)) == (fault.prompt == fault.good_prompt)


def _episode(key: str, **more: Any) -> Episode:
    fields = {'key': key, 'kind': KINDS[0].name, 'status': 'verified', **more}
    return Episode.model_validate(fields)


def test_only_faults_that_show_are_counted() -> None:
    episodes = [
        _episode('a', showed=True, repaired=True, simulations=1, localized=True),
        _episode('b', showed=True, repaired=True, simulations=3, localized=True),
        _episode('c', showed=True, status='violated', simulations=5),
        _episode('d', showed=False),
    ]
    line = last_line(episodes)
    assert line.startswith('repaired 2 of 3 faults  0.667 ')
    assert 'cause among first three 2 of 3' in line
    met = {goal.name: goal.met for goal in goals(episodes)}
    assert not met['repaired']
    assert met['nothing else changed']


def test_what_is_never_mended_counts_in_the_median_of_what_mending_takes() -> None:
    # Taken over the mended one alone it would be 1.
    episodes = [
        _episode('a', showed=True, repaired=True, simulations=1),
        _episode('b', showed=True, status='violated', simulations=0),
        _episode('c', showed=True, status='violated', simulations=5),
    ]
    assert 'median co-simulations - ' in last_line(episodes)
    met = {goal.name: goal.met for goal in goals(episodes)}
    assert not met['median co-simulations']


def test_an_edit_outside_its_neighbourhood_is_told_also_of_a_locked_fault() -> None:
    episodes = [
        _episode('a', showed=True, repaired=True, simulations=1),
        _episode('b', showed=True, mends=False, changed=('links/link1/loss is locked',)),
    ]
    assert last_line(episodes).endswith('nothing else changed 1 of 2')
    assert not {goal.name: goal.met for goal in goals(episodes)}['nothing else changed']


def test_a_proposal_is_timed_against_the_run_that_it_answers_to() -> None:
    shown = {'showed': True, 'repaired': True}
    slow = _episode('a', **shown, proposing_s=(1.0, 3.0), first_s=2.0)
    quick = _episode('b', **shown, proposing_s=(0.2,), first_s=2.0)
    figures = {goal.name: (goal.figure, goal.met) for goal in goals([slow, quick])}
    assert figures['median proposal in first realisations'] == ('0.50', True)


def test_a_journal_of_other_settings_is_not_gone_on_with(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    nothing = ['--number', '0', '--resume', str(tmp_path)]
    assert main(nothing) == 0
    assert main(nothing) == 0
    for other in (
        ['--seed', '2'],
        ['--repair', '3'],
        ['--no-replay'],
        ['--map', 'junction'],
        ['--set', 'lambda_sem=0'],
    ):
        assert main([*nothing, *other]) == USAGE, other
        assert 'is of another campaign' in capsys.readouterr().err


def test_a_setting_that_is_not_there_is_refused() -> None:
    settings = load_repair_settings()
    assert with_settings(settings, {'weights.inferred': 7.0}).weights.inferred == 7.0
    for changes in ({'lambda': 1}, {'weights.other': 1.0}, {'epsilon': -1.0}):
        with pytest.raises(ValueError, match=r'config/repair.yaml has no|validation error'):
            with_settings(settings, changes)
    assert main(['--number', '0', '--set', 'lambda=1']) == USAGE
