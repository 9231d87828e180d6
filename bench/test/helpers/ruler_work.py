# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Cheap trials and a checker, for tests of rulers; in a module that the workers can import."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from aurora_bench.rulers.checking import Said
from aurora_bench.rulers.trial import Cause, JudgedTrial, Trial, judged

SAID = (
    Said(requirement='r1', kind='uav', outcome='holds', why='one is there'),
    Said(requirement='r2', kind='mission', outcome='cannot_tell', why='no sample'),
)
AGAINST = Said(requirement='r3', kind='agent', outcome='does_not', why='0 cars, not 1')


@dataclass(kw_only=True)
class CheapWork:
    """Judges by the prompt's words, without any run."""

    folder: Path

    def prepare(self) -> None:
        """Nothing is loaded."""

    def __call__(self, trial: Trial) -> JudgedTrial:
        """Return what the prompt says, and leave a folder."""
        (self.folder / trial.folder).mkdir(parents=True)
        text = trial.prompt.prompt
        if 'kills' in text:
            os._exit(9)
        if 'fails' in text:
            failed = ('altitude', f'seed {trial.seed}')
            return judged(trial, status='violated', cause=Cause.CONDITION, words=failed)
        if 'lies' in text:
            return judged(
                trial,
                status='verified',
                cause=Cause.CONTRADICTED,
                words=('agent',),
                said=(*SAID, AGAINST),
            )
        return judged(trial, status='verified', cause=None, said=SAID)


def contradicts_missions(bag: Path, prompt: Mapping[str, Any]) -> SimpleNamespace:
    """Check a bag: no mission holds, of bodies nothing is known, `beyond` is answered too."""
    assert (bag / 'metadata.yaml').is_file()
    outcomes = {'mission': 'does_not', 'beyond': 'cannot_tell'}
    answers = [
        SimpleNamespace(
            requirement=r['id'], kind=r['kind'], outcome=outcomes.get(r['kind'], 'holds'), why='so'
        )
        for r in prompt['requirements']
    ]
    return SimpleNamespace(answers=answers, binding={})


def breaks(bag: Path, prompt: Mapping[str, Any]) -> SimpleNamespace:
    """Check a bag and break."""
    raise KeyError('no topic')
