# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from aurora_core.outcomes.verdict import Finding, Verdict, VerdictStatus
from aurora_core.report.comparison import compare
from aurora_core.report.run_documents import read_document
from aurora_core.report.run_folder import json_text


def test_a_verdict_survives_its_file_to_the_last_bit(
    tmp_path: Path, make: SimpleNamespace
) -> None:
    verdict = make.verdict(make.result(margin=0.1 + 0.2, worst_time_s=1.0 / 3.0))
    path = tmp_path / 'verdict.0.json'
    path.write_text(json_text(verdict))
    recorded = read_document(path, Verdict)
    assert isinstance(recorded, Verdict)
    assert compare(recorded, verdict, path.name).equal


def test_one_bit_is_a_difference(make: SimpleNamespace) -> None:
    ours = make.verdict(make.result(margin=0.2))
    theirs = make.verdict(make.result(margin=math.nextafter(0.2, 1.0)))
    comparison = compare(theirs, ours, 'verdict.0.json')
    assert not comparison.equal
    assert comparison.differences[0].condition == 'm1.visible'
    assert 'margin' in comparison.differences[0].what


def test_conditions_that_are_in_one_of_them_only_are_named(make: SimpleNamespace) -> None:
    recorded = make.verdict(make.result('a'), make.result('b'))
    recomputed = make.verdict(make.result('b'), make.result('c'))
    found = compare(recorded, recomputed, 'f').differences
    assert {d.condition: d.what for d in found} == {
        'a': 'not in the bag',
        'c': 'not in the record',
    }


def test_what_tells_of_the_installation_is_no_difference(make: SimpleNamespace) -> None:
    recorded = make.verdict(make.result())
    noted = Verdict.model_validate(dict(recorded) | {'notes': ('recorded elsewhere',)})
    assert compare(recorded, noted, 'verdict.0.json').equal
    finding = Finding(kind='configuration', subject='version', tick=0, time_s=0.0, text='older')
    foreign = make.verdict(
        make.result(), status=VerdictStatus.INCONCLUSIVE, cross_check=(finding,)
    )
    assert compare(recorded, foreign, 'verdict.0.json').equal
    # Not so for what the trace shows, nor for a record that says less than the bag.
    failed = make.verdict(
        make.result(margin=-1.0), status=VerdictStatus.INCONCLUSIVE, cross_check=(finding,)
    )
    assert not compare(recorded, failed, 'verdict.0.json').equal
    event = finding.model_copy(update={'kind': 'event'})
    claimed = make.verdict(
        make.result(), status=VerdictStatus.INCONCLUSIVE, cross_check=(finding, event)
    )
    assert not compare(recorded, claimed, 'verdict.0.json').equal
