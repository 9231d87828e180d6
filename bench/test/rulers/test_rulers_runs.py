# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a worker makes of one trial, without a simulator."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from ruler_work import breaks, contradicts_missions

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.rulers import runs
from aurora_bench.rulers.runs import RealiseWork, on_map
from aurora_bench.rulers.trial import Cause, Trial
from aurora_core.report.status import Status
from aurora_core.spec.scenario import ScenarioSpec

Doc = dict[str, Any]
UAV: Doc = {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}
HOVER: Doc = {'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover'}


def trial(*requirements: Doc) -> Trial:
    """Return a trial of one prompt."""
    document: Doc = {
        'id': 'hover-901', 'category': 'hover', 'prompt': 'any', 'feasibility': 'feasible',
        'paraphrase_group': None, 'end_to_end': False, 'requirements': [UAV, *requirements],
    }  # fmt: skip
    return Trial(
        key='k', file='mine/own.jsonl', seed=1, prompt=AnnotatedPrompt.model_validate(document),
        document=document, folder='own/hover-901-1',
    )  # fmt: skip


@pytest.fixture
def verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every run be verified, with a recording."""

    def run(
        _asked: object, _stages: object, _known: object, folder: Any, *_: object, **__: object
    ) -> object:
        folder.create()
        bag = folder.bag_path(0)
        bag.mkdir()
        (bag / 'metadata.yaml').write_text('')
        trace = SimpleNamespace(bag=bag.name, sha256='ab', motion_sha256='cd')
        timing = {'execute': 1.0}
        return SimpleNamespace(
            status=Status.VERIFIED,
            summary='',
            trace=trace,
            timing=timing,
            metrics=SimpleNamespace(iterations=1),
            conditions=(),
        )

    monkeypatch.setattr(runs, 'run', run)


def test_what_cannot_be_said_is_not_realised_and_nothing_is_run(tmp_path: Path) -> None:
    found = RealiseWork(folder=tmp_path)(trial({**HOVER, 'mode': 'navigate', 'pattern': 'facade'}))
    assert (found.status, found.cause) == ('not_expressible', Cause.CAPABILITY)
    assert found.words == ('no specification can say: mission pattern facade',)


@pytest.mark.usefixtures('verified')
def test_a_checker_that_breaks_has_confirmed_nothing(tmp_path: Path) -> None:
    work = RealiseWork(folder=tmp_path, check=breaks)
    found = work(trial(HOVER))
    assert (found.status, found.right, found.cause) == ('verified', False, Cause.ERROR)
    assert found.words == ("checker: KeyError: 'no topic'",)


@pytest.mark.usefixtures('verified')
@pytest.mark.parametrize('keep', [True, False])
def test_a_bag_goes_after_it_was_checked_unless_it_is_kept(tmp_path: Path, keep: bool) -> None:
    work = RealiseWork(folder=tmp_path, keep=keep, check=contradicts_missions)
    beyond = {'id': 'r3', 'kind': 'beyond', 'text': 'quietly'}
    found = work(trial(HOVER, beyond))
    assert (found.right, found.cause, found.words) == (False, Cause.CONTRADICTED, ('mission',))
    assert [s.requirement for s in found.said] == ['r1', 'r2']  # beyond is not scored
    assert bool(list(tmp_path.rglob('metadata.yaml'))) is keep


def test_a_reference_lies_on_the_map_of_the_campaign_unless_it_names_one() -> None:
    silent, named = (
        ScenarioSpec.model_validate({'prompt': 'any', 'world': world})
        for world in ({}, {'map_name': 'downtown'})
    )
    assert on_map(silent, 'harbour').world.map_name == 'harbour'
    assert on_map(named, 'harbour').world.map_name == 'downtown'
