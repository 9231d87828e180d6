# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What issue and design ask of the lockstep, and whether it was found."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from statistics import median

from aurora_bench.lockstep.campaign import Campaign, Plan
from aurora_bench.lockstep.figures import RECORDER, Engine, Measured
from aurora_bench.results import Goal

# (engine, agents, least real-time factor) with 1 UAV over 60 s.
SPEED_GOALS: tuple[tuple[Engine, int, float], ...] = (
    ('ros', 10, 40.0),
    ('ros', 30, 30.0),
    ('local', 10, 250.0),
)
RECORDER_GOAL = 0.10
RESET_GOAL = 1.0 / 20.0
START_GOAL = 2.0
# What the loop costs over the least that it could cost here: accepted, and aimed at.
BARRIER_GOAL, BARRIER_AIM = 5.0, 4.0
SUMO_GOAL = 2.0
_GOAL_SECONDS = 60


def recorder_share(campaign: Campaign, engine: Engine) -> tuple[float, float] | None:
    """Return the recorder's share of wall time (with against without) and of CPU time."""
    pairs = campaign.recorder_pairs.get(engine, [])
    if not pairs:
        return None
    with_s = median(recorded.loop_s for recorded, _ in pairs)
    without_s = median(bare.loop_s for _, bare in pairs)
    cpu = median(run.parts_s[RECORDER] / max(run.cpu_s, 1e-9) for run, _ in pairs)
    return 1.0 - without_s / with_s, cpu


def graph_over_barrier(campaign: Campaign, plan: Plan) -> float | None:
    """Return the graph's tick as a multiple of the bare barrier, None when not measured."""
    base = find(campaign.measured, 'ros', plan.base.agents, plan.base.seconds)
    if base is None or not campaign.barrier_us:
        return None
    return base.us_per_tick.median / median(campaign.barrier_us)


def start_over_bare(campaign: Campaign) -> float | None:
    """Return the start of the graph as a multiple of the bare one, None when not measured."""
    if not campaign.cold_start_s or not campaign.bare_start_s:
        return None
    return median(campaign.cold_start_s) / median(campaign.bare_start_s)


def local_over_sumo(campaign: Campaign, plan: Plan) -> tuple[float, float] | None:
    """Return the local tick over SUMO's step with its state read (CPU, wall), None likewise."""
    base = find(campaign.measured, 'local', plan.base.agents, plan.base.seconds)
    if base is None:
        return None
    return (
        median(run.over_sumo for run in base.runs),
        median(run.over_sumo_wall for run in base.runs),
    )


def goals(campaign: Campaign, plan: Plan) -> tuple[Goal, ...]:
    """Return every goal with what was found.

    On a busy machine goals of wall time are stated and not judged, in neither direction.
    """
    quiet = campaign.is_quiet
    found: list[Goal] = []
    for engine, agents, least in SPEED_GOALS:
        measured = find(campaign.measured, engine, agents, _GOAL_SECONDS)
        factor = measured.real_time_factor.median if measured else None
        found.append(
            _goal(
                f'{engine}: real-time factor, {agents} agents, 1 UAV, {_GOAL_SECONDS} s',
                f'at least {least:g}',
                None if factor is None else (f'{factor:.1f}', factor >= least),
                quiet=quiet,
            )
        )
    for engine in ('ros', 'local'):
        share = recorder_share(campaign, engine)
        text = '' if share is None else f'{share[0]:.1%} (CPU {share[1]:.1%})'
        found.append(
            _goal(
                f'{engine}: share of the recorder in a run',
                f'at most {RECORDER_GOAL:.0%}',
                None if share is None else (text, share[0] <= RECORDER_GOAL),
                quiet=quiet,
            )
        )
    return (*found, *_graph_goals(campaign, plan), _determinism(campaign.measured))


def _graph_goals(campaign: Campaign, plan: Plan) -> tuple[Goal, ...]:
    base = find(campaign.measured, 'ros', plan.base.agents, plan.base.seconds)
    reset = None
    if base is not None:
        warm = median(run.load_s for run in base.runs) / median(campaign.cold_start_s)
        reset = (f'{warm:.3f}', warm <= RESET_GOAL)
    quiet = campaign.is_quiet
    barrier, sumo = graph_over_barrier(campaign, plan), local_over_sumo(campaign, plan)
    start = start_over_bare(campaign)
    return (
        _goal('ros: warm reset / cold start', f'at most {RESET_GOAL:.3f}', reset, quiet=quiet),
        _goal(
            'ros: cold start / bare start of as many processes',
            f'at most {START_GOAL:g}',
            _at_most(start, START_GOAL),
            quiet=quiet,
        ),
        _goal(
            'ros: tick / bare three-process barrier',
            f'at most {BARRIER_GOAL:g} (aim {BARRIER_AIM:g})',
            _at_most(barrier, BARRIER_GOAL),
            quiet=quiet,
        ),
        _goal(
            "local: tick / SUMO's step with its state read",
            f'at most {SUMO_GOAL:g}',
            None if sumo is None else (_cpu_and_wall(*sumo), sumo[0] <= SUMO_GOAL),
            quiet=True,  # CPU time over CPU time of the same runs
        ),
    )


def _at_most(ratio: float | None, limit: float) -> tuple[str, bool] | None:
    return None if ratio is None else (f'{ratio:.2f}', ratio <= limit)


def _cpu_and_wall(cpu: float, wall: float) -> str:
    return f'{cpu:.2f} CPU, {wall:.2f} wall'


def _goal(name: str, target: str, found: tuple[str, bool] | None, *, quiet: bool) -> Goal:
    if found is None:
        return Goal(name=name, target=target, figure='not measured', met=None)
    figure, met = found
    if not quiet:
        return Goal(name=name, target=target, figure=f'{figure}, busy machine', met=None)
    return Goal(name=name, target=target, figure=figure, met=met)


def one_hash_each(measured: Sequence[Measured]) -> tuple[int, int]:
    """Return how many configurations have one trace hash over all runs of all engines, of all."""
    hashes: dict[tuple[int, int, int], set[str]] = defaultdict(set)
    for each in measured:
        hashes[each.agents, each.uavs, each.seconds] |= each.hashes
    return sum(len(found) == 1 for found in hashes.values()), len(hashes)


def _determinism(measured: Sequence[Measured]) -> Goal:
    equal, count = one_hash_each(measured)
    runs = sum(len(each.runs) for each in measured)
    engines = ' and '.join(dict.fromkeys(each.engine for each in measured))
    return Goal(
        name='configurations with one trace hash over all runs of all engines',
        target=f'all {count}',
        figure=f'{equal} ({runs} runs; {engines})',
        met=equal == count,
    )


def find(
    measured: Sequence[Measured], engine: Engine, agents: int, seconds: int
) -> Measured | None:
    """Return what was measured with 1 UAV, None when it was not."""
    for each in measured:
        if (each.engine, each.agents, each.uavs, each.seconds) == (engine, agents, 1, seconds):
            return each
    return None
