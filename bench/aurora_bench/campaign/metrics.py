# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's metrics of many runs, and those beside them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from scipy.stats import binomtest

from aurora_bench.campaign.plan import Configuration
from aurora_bench.campaign.record import CampaignRun, Ending
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.report.share import Share

Runs = Sequence[CampaignRun]


class Metric(NamedTuple):
    """A share of runs.

    Attributes:
        name: Heading of its column.
        about: What is counted.
        of: Tells of one run whether it counts.
    """

    name: str
    about: str
    of: Callable[[CampaignRun], bool]


# C, RF, P and SF as the paper defines them, of all runs. C + RF + declined = 1, and
# P + SF + undecided = C.
METRICS = (
    Metric('C', 'executed to the end', lambda r: r.ending is Ending.COMPLETED),
    Metric('RF', 'broke, or took too long', lambda r: r.ending is Ending.FAILED),
    Metric('declined', 'ended before execution', lambda r: r.ending is Ending.DECLINED),
    Metric('P', 'completed, every monitored condition holds', lambda r: r.passed),
    Metric('SF', 'completed, a monitored condition does not hold', lambda r: r.unmet),
    Metric('undecided', 'completed, the trace cannot decide', lambda r: r.undecided),
    Metric('verified', 'P, and every clause is read and judged', lambda r: r.status == 'verified'),
    Metric('right', 'as the annotation asks for, uncontradicted', lambda r: r.right),
)


# What needs an executable specification: of B1 to B3 there is none.
OF_SPECIFICATIONS = frozenset({'P', 'SF', 'undecided', 'verified'})


def share(runs: Iterable[CampaignRun], of: Callable[[CampaignRun], bool]) -> Share:
    """Return for how many runs something is so."""
    found = [of(run) for run in runs]
    return Share(met=sum(found), total=len(found))


def fidelity(runs: Runs) -> Share:
    """Return the share of annotated requirements that specifications hold (the paper's Fid)."""
    return Share(met=sum(r.met for r in runs), total=sum(r.requirements for r in runs))


def field_fidelity(runs: Runs) -> Share:
    """Return the same by annotated field."""
    return Share(met=sum(r.fields_met for r in runs), total=sum(r.fields for r in runs))


def groups(runs: Runs) -> dict[tuple[str, Configuration], list[CampaignRun]]:
    """Return the runs by reader and configuration, in their order."""
    found: dict[tuple[str, Configuration], list[CampaignRun]] = {}
    for run in runs:
        found.setdefault((run.reader, run.configuration), []).append(run)
    return found


class Paired(NamedTuple):
    """Two configurations on the same prompts and seeds.

    Attributes:
        pairs: How many.
        gained: So in the second alone.
        lost: So in the first alone.
        p: Two-sided, of a difference as large by chance.
    """

    pairs: int
    gained: int
    lost: int
    p: float


def paired(before: Runs, after: Runs, of: Callable[[CampaignRun], bool]) -> Paired:
    """Return the exact McNemar test of two configurations.

    Source: Q. McNemar, "Note on the sampling error of the difference between correlated
    proportions or percentages", Psychometrika 12 (1947) 153-157, with the binomial distribution.
    Runs of one prompt with several seeds are counted as independent, which they are not.
    """
    first = {_pair(r): of(r) for r in before}
    second = {_pair(r): of(r) for r in after}
    both = [(first[key], second[key]) for key in first if key in second]
    gained = sum(b and not a for a, b in both)
    lost = sum(a and not b for a, b in both)
    changed = gained + lost
    p = float(binomtest(gained, changed, 0.5).pvalue) if changed else 1.0
    return Paired(pairs=len(both), gained=gained, lost=lost, p=p)


def _pair(run: CampaignRun) -> tuple[str, str, str, int]:
    return run.reader, run.file, run.id, run.seed


def by_category(runs: Runs) -> dict[str, list[CampaignRun]]:
    """Return the runs by category, by name."""
    found: dict[str, list[CampaignRun]] = {}
    for run in runs:
        found.setdefault(run.category, []).append(run)
    return dict(sorted(found.items()))


def per_prompt(runs: Runs) -> dict[str, Share]:
    """Return the pass probability of every prompt over its seeds."""
    found: dict[str, list[CampaignRun]] = {}
    for run in runs:
        found.setdefault(f'{run.file}:{run.id}', []).append(run)
    return {key: share(part, lambda r: r.passed) for key, part in found.items()}


# What became of runs whose first realisation does not hold.
REPAIRED, TRIED, NOTHING = 'repaired', 'tried, none holds', 'nothing simulated again'


def repair_outcomes(runs: Runs) -> dict[str, int]:
    """Return what became of runs that did not hold at first, of those with repair on."""
    counts = dict.fromkeys((REPAIRED, TRIED, NOTHING), 0)
    for run in runs:
        if run.first is None or run.first is VerdictStatus.VERIFIED:
            continue
        if run.passed:
            counts[REPAIRED] += 1
        elif run.simulations > 1:
            counts[TRIED] += 1
        else:
            counts[NOTHING] += 1
    return counts


def anchors_by_outcome(runs: Runs) -> Mapping[str, list[CampaignRun]]:
    """Return completed runs that have an anchor score by whether they passed."""
    scored = [r for r in runs if r.anchor is not None]
    return {
        'passed': [r for r in scored if r.passed],
        'a condition fails': [r for r in scored if r.unmet],
    }
