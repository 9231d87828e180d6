# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Comparison`: the verdict that a run wrote beside the one that its bag gives, bit by bit."""

from __future__ import annotations

from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.monitor.verify import verdict_status
from aurora_core.outcomes.verdict import ConditionResult, Verdict


class Difference(Document):
    """A condition whose recomputed result is not the recorded one.

    Attributes:
        recorded: Margin in the run's file, None when there is none.
        recomputed: Margin from the bag, None when there is none.
        what: Which fields differ, or that the condition is in one of them only.
    """

    condition: str
    recorded: FiniteFloat | None
    recomputed: FiniteFloat | None
    what: str


class Comparison(Document):
    """The run's own verdict file against the recomputation.

    Attributes:
        file: Name of the verdict file.
        equal: Every value is the same to the last bit.
        differences: Where it is not.
    """

    file: str
    equal: bool
    differences: tuple[Difference, ...] = ()


def compare(recorded: Verdict, recomputed: Verdict, file: str) -> Comparison:
    """Compare two verdicts bit by bit (JSON keeps every bit of a float).

    Notes and the findings that another configuration is installed are left out: they tell of the
    installation that judged, not of the run.
    """
    ours = {result.id: result for result in recomputed.results}
    theirs = {result.id: result for result in recorded.results}
    differences = []
    for name in dict.fromkeys((*theirs, *ours)):
        a, b = theirs.get(name), ours.get(name)
        what = _difference(a, b)
        if what:
            differences.append(
                Difference(
                    condition=name,
                    recorded=a.margin if a is not None else None,
                    recomputed=b.margin if b is not None else None,
                    what=what,
                )
            )
    return Comparison(
        file=file,
        equal=_judged(recorded) == _judged(recomputed),
        differences=tuple(differences),
    )


def _judged(verdict: Verdict) -> str:
    findings = tuple(f for f in verdict.cross_check if f.kind != 'configuration')
    changes: dict[str, object] = {'notes': (), 'cross_check': findings}
    if findings != verdict.cross_check:
        changes['status'] = verdict_status(verdict.integrity, verdict.results, len(findings))
    return Verdict.model_validate({**dict(verdict), **changes}).canonical_json()


def _difference(recorded: ConditionResult | None, recomputed: ConditionResult | None) -> str:
    if recorded is None:
        return 'not in the record'
    if recomputed is None:
        return 'not in the bag'
    a, b = recorded.model_dump(mode='json'), recomputed.model_dump(mode='json')
    return ', '.join(name for name in a if a[name] != b[name])
