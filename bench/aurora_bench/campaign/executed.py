# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of what was executed: moments, missions, messages, repair episodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median

from aurora_bench.campaign.measured import Flown, Measured
from aurora_bench.campaign.metrics import groups
from aurora_bench.campaign.record import CampaignRun, Ending
from aurora_bench.results import Cell, Table

Runs = Sequence[CampaignRun]
# Parts of a repair episode, in the order in which they come.
EPISODE = ('repair', 'ground', 'execute', 'verify')


def coordination_table(runs: Runs) -> Table:
    """Return how moments of events and messages came out."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        found = measured_of(part)
        for what, values in moments(found).items():
            if values:
                rows.append(
                    (
                        reader, configuration.value, what, len(values), median(values),
                        max(values), None,
                    )
                )  # fmt: skip
        sent = sum(m.sent for m in found)
        if sent:
            told = sum(len(m.latency_s) for m in found)
            rows.append(
                (reader, configuration.value, 'messages delivered', sent, None, None, told / sent)
            )
    return Table(
        headings=('reader', 'configuration', 'what', 'number', 'median [s]', 'greatest [s]',
                  'share'),
        rows=rows,
        caption='Events and messages. The clocks of the simulators are one (lockstep): their '
        'offset is zero by construction',
    )  # fmt: skip


def moments(found: Sequence[Measured]) -> dict[str, list[float]]:
    """Return absolute errors of moments, and latencies, by what they are."""
    return {
        'event: recorded to recomputed moment': [abs(v) for m in found for v in m.event_s],
        'event: recorded to stated time': [abs(v) for m in found for v in m.stated_s],
        'message: latency': [v for m in found for v in m.latency_s],
    }


def mission_table(runs: Runs) -> Table:
    """Return how missions came out by mode."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        for mode, flown in missions_of(part).items():
            captured = [f.capture_s for f in flown if f.capture_s is not None]
            on_target = [f.on_target for f in flown if f.on_target is not None]
            off_m = [f.off_m for f in flown if f.off_m is not None]
            most_m = [f.off_most_m for f in flown if f.off_most_m is not None]
            rows.append(
                (
                    reader, configuration.value, mode, len(flown), len(captured),
                    median(captured) if captured else None, max(captured, default=None),
                    median(on_target) if on_target else None,
                    median(off_m) if off_m else None, max(most_m, default=None),
                )
            )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'mission', 'flown', 'captured', 'capture [s], median',
            'greatest', 'time on target, median share', 'off [m], median', 'greatest [m]',
        ),
        rows=rows,
        caption='Missions of the realisation that a run is judged by; off: horizontal distance '
        'after capture from the way (navigate), the hover point, or the standoff (track)',
    )  # fmt: skip


def missions_of(runs: Runs) -> dict[str, list[Flown]]:
    """Return the missions of executed runs by mode, by name."""
    found: dict[str, list[Flown]] = {}
    for one in measured_of(runs):
        for mission in one.missions:
            found.setdefault(mission.mode, []).append(mission)
    return dict(sorted(found.items()))


def measured_of(runs: Runs) -> list[Measured]:
    """Return what was measured of those runs that were executed."""
    return [r.measured for r in runs if r.measured is not None]


def program_table(runs: Runs) -> Table:
    """Return what the independent checker says of programs that completed."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        if not configuration.writes_program:
            continue
        done = [
            r for r in part
            if r.ending is Ending.COMPLETED and r.feasibility != 'infeasible'
        ]  # fmt: skip
        said = [s.outcome for r in done for s in r.said]
        rows.append(
            (
                reader, configuration.value, len(part), len(done),
                sum(r.contradicted for r in done), len(said), said.count('holds'),
                said.count('does_not'), said.count('cannot_tell'),
            )
        )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'programs', 'completed, possible requests',
            'of these contradicted', 'requirements asked', 'hold', 'do not hold', 'cannot tell',
        ),
        rows=rows,
        caption='Programs of models: the paper calls those that complete unverifiable; the '
        'independent checker judges their recordings by the annotation alone',
    )  # fmt: skip


def episode_table(runs: Runs) -> Table:
    """Return what repair episodes took, by part and by co-simulation."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        episodes = [(r, parts) for r in part if (parts := episode_of(r))]
        if not episodes:
            continue
        whole = [sum(parts.values()) for _, parts in episodes]
        for name in EPISODE:
            values = [parts.get(name, 0.0) for _, parts in episodes]
            each = [parts.get(name, 0.0) / max(1, r.simulations - 1) for r, parts in episodes]
            rows.append(
                (
                    reader, configuration.value, name, len(episodes), median(values),
                    median(each), sum(values) / sum(whole),
                )
            )  # fmt: skip
        each = [sum(p.values()) / max(1, r.simulations - 1) for r, p in episodes]
        rows.append(
            (
                reader, configuration.value, 'episode', len(episodes), median(whole),
                median(each), 1.0,
            )
        )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'part', 'episodes', 'median [s]',
            'median per co-simulation [s]', 'share',
        ),
        rows=rows,
        caption='Repair episodes: wall seconds after the first verdict',
    )  # fmt: skip


def episode_of(run: CampaignRun) -> Mapping[str, float]:
    """Return the seconds of the repair episode of a run by part; empty where there was none."""
    return {
        name: run.seconds[f'again {name}'] for name in EPISODE if f'again {name}' in run.seconds
    }
