# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_core.errors import ReportError
from aurora_core.monitor.verdict import Verdict, VerdictStatus
from aurora_core.report.run_folder import json_text
from aurora_core.report.verify_report import (
    VerifyReport,
    compare,
    read_recorded,
    verify_exit_code,
)
from aurora_core.trace.trace import Integrity


def _report(verdict: Verdict, recorded: Verdict | None = None) -> VerifyReport:
    return VerifyReport(
        bag='bag.0',
        ticks=10,
        trace_sha256='a' * 64,
        verdict=verdict,
        recorded=compare(recorded, verdict, 'verdict.0.json') if recorded is not None else None,
    )


def test_a_verdict_survives_its_file_to_the_last_bit(
    tmp_path: Path, make: SimpleNamespace
) -> None:
    verdict = make.verdict(make.result(margin=0.1 + 0.2, worst_time_s=1.0 / 3.0))
    path = tmp_path / 'verdict.0.json'
    path.write_text(json_text(verdict))
    recorded = read_recorded(path)
    assert recorded is not None
    assert compare(recorded, verdict, path.name).equal


def test_one_bit_is_a_difference(make: SimpleNamespace) -> None:
    ours = make.verdict(make.result(margin=0.2))
    theirs = make.verdict(make.result(margin=math.nextafter(0.2, 1.0)))
    comparison = compare(theirs, ours, 'verdict.0.json')
    assert not comparison.equal
    assert comparison.differences[0].condition == 'm1.visible'
    assert 'margin' in comparison.differences[0].what
    assert verify_exit_code(_report(ours, theirs)) == 4


def test_conditions_that_are_in_one_of_them_only_are_named(make: SimpleNamespace) -> None:
    recorded = make.verdict(make.result('a'), make.result('b'))
    recomputed = make.verdict(make.result('b'), make.result('c'))
    found = compare(recorded, recomputed, 'f').differences
    assert {d.condition: d.what for d in found} == {
        'a': 'not in the bag',
        'c': 'not in the record',
    }


def test_no_record_is_no_error_but_a_damaged_one_is(tmp_path: Path) -> None:
    assert read_recorded(tmp_path / 'verdict.0.json') is None
    (tmp_path / 'verdict.0.json').write_text('{"status":')
    with pytest.raises(ReportError, match='verdict'):
        read_recorded(tmp_path / 'verdict.0.json')


def test_exit_codes_are_those_of_the_contract(make: SimpleNamespace) -> None:
    good = make.verdict()
    assert verify_exit_code(_report(good, good)) == 0
    assert verify_exit_code(_report(good)) == 0
    assert verify_exit_code(_report(make.verdict(make.result(margin=-1.0)))) == 1
    assert verify_exit_code(_report(make.verdict(status=VerdictStatus.INCONCLUSIVE))) == 4
    assert verify_exit_code(_report(make.verdict(integrity=Integrity.ALTERED))) == 4
    nothing = Verdict(status=VerdictStatus.VERIFIED, results=(), integrity=Integrity.INTACT)
    assert verify_exit_code(_report(nothing)) == 4


def test_a_note_about_the_installation_is_no_difference(make: SimpleNamespace) -> None:
    recorded = make.verdict(make.result())
    noted = Verdict.model_validate(dict(recorded) | {'notes': ('recorded elsewhere',)})
    assert compare(recorded, noted, 'verdict.0.json').equal
    assert verify_exit_code(_report(noted, recorded)) == 0
