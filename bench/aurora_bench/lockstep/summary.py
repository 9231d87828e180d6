# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From what was measured to tables and the JSON document."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import Any

from aurora_bench.lockstep.campaign import Campaign, Plan
from aurora_bench.lockstep.figures import (
    AIR,
    EXECUTOR,
    RECORDER,
    SUMO,
    Measured,
    Spread,
    spread,
)
from aurora_bench.lockstep.goals import (
    find,
    graph_over_barrier,
    local_over_sumo,
    recorder_share,
    start_over_bare,
)
from aurora_bench.lockstep.scenarios import prompt
from aurora_bench.results import Cell, Table

LOCAL_PARTS = (SUMO, AIR, EXECUTOR, RECORDER)
PROCESSES = ('sync', 'sumo_bridge', 'uav_bridge', 'uav_sim', 'executor', 'recorder', 'monitor')
OTHERS = 'others'

NOTES = (
    'us/tick and RTF (simulated seconds per wall second) are of the tick loop alone: loading, '
    'closing (bag closed, read again, hashed) and verifying stand apart. Each is the median of '
    'the repetitions; least and greatest RTF stand beside it. CPU times are user and system time '
    'from /proc/PID/stat at the first and at the last tick (graph) or of the thread between the '
    'ports (local engine; what the watch takes by itself is measured beside and taken off), so '
    'that a busy machine shows in the wall columns alone.',
    'Recorder share: 1 - (loop without recorder / loop with recorder), wall, by turns at the '
    'smallest configuration. Without: the local loop calls the same ports and writes nothing; in '
    'the graph a node in the place of the recorder answers its services, subscribes to nothing '
    'while ticks flow and gives the clock all its credit. In brackets: CPU time of recording / '
    'CPU time of all, which a busy machine disturbs less.',
    'Warm reset: from sending the goal of /aurora/execute in a running graph to tick 0 (graph of '
    'the scenario read, simulators loaded, recorder opened). Cold start: `ros2 run '
    'aurora_bringup up` until every node is ready. Bare start: as many Python processes at once, '
    'each with rclpy, one node and nothing else, until every node is there.',
    'Bare barrier: three rclpy processes, one tick out and two states of 11 doubles back, each '
    'process on its own wait set, reliable and keep all; measured before and after the graph.',
    "Ratios are of the smallest configuration. SUMO's step with its state read is what the local "
    'loop spends in the port of the ground simulator, in the same run. The goal is judged by CPU '
    'time, which includes what other threads of the process do beside the loop (the disk).',
    'Scenarios: with 1 UAV a prompt goes through parser, check and grounding as any other ('
    'background traffic fills up to the number of agents). With more UAVs the track mission of '
    'that specification is repeated by code, 10 m higher each time, and grounded as any other.',
)


def notes(campaign: Campaign) -> tuple[str, ...]:
    """Return the paragraphs under the tables."""
    busy = ', '.join(f'{share:.0%}' for share in campaign.busy)
    looks = f'Others used {busy} of the cores when this campaign paused to look.'
    if campaign.is_quiet:
        return (looks, *NOTES)
    return (
        f'**{looks} Wall times are those of a busy machine: goals of time are not judged. '
        'Run it again on a quiet one.**',
        *NOTES,
    )


def tables(campaign: Campaign, plan: Plan) -> tuple[Table, ...]:
    """Return the tables of the Markdown file."""
    local = [each for each in campaign.measured if each.engine == 'local']
    ros = [each for each in campaign.measured if each.engine == 'ros']
    found = [_speed_table(campaign.measured)]
    if local:
        found.append(_parts_table(local, LOCAL_PARTS, 'Local engine: CPU us per tick by part'))
    if ros:
        names = (*PROCESSES, OTHERS)
        found.append(_parts_table(ros, names, 'Graph: CPU us per tick by process'))
    rows = [_spread_row(name, figures) for name, figures in _beside(campaign, plan).items()]
    if rows:
        headings = ('figure', 'median', 'least', 'greatest', 'repetitions')
        found.append(Table(headings=headings, rows=rows, caption='Beside the ticks'))
    return tuple(found)


def shown_parts(measured: Measured) -> dict[str, float]:
    """Return CPU us per tick by part as tables and figure show it: idle nodes in one."""
    parts = measured.parts_us()
    if measured.engine == 'local':
        return parts
    shown = {name: parts.get(name, 0.0) for name in PROCESSES}
    return {**shown, OTHERS: sum(us for name, us in parts.items() if name not in shown)}


def document(campaign: Campaign, plan: Plan) -> dict[str, Any]:
    """Return everything measured as plain JSON values."""
    shares = {engine: recorder_share(campaign, engine) for engine in plan.engines}
    sumo = local_over_sumo(campaign, plan)
    return {
        'options': {
            'engines': list(plan.engines),
            'repetitions': plan.repetitions,
            'barrier_ticks': plan.barrier_ticks,
        },
        'others_use_of_cores': campaign.busy,
        'quiet': campaign.is_quiet,
        'prompts': {str(c): prompt(c) for c in plan.configurations if c.uavs == 1},
        'configurations': [
            {
                **each.model_dump(mode='json', exclude={'runs'}),
                **each.summary(),
                'shares': _shares(shown_parts(each)),
                'runs': [run.model_dump(mode='json') for run in each.runs],
            }
            for each in campaign.measured
        ],
        'ratios': {
            'graph_tick_over_bare_barrier': graph_over_barrier(campaign, plan),
            'local_tick_over_sumo_step': None if sumo is None else sumo[0],
            'local_tick_over_sumo_step_wall': None if sumo is None else sumo[1],
            'cold_start_over_bare_start': start_over_bare(campaign),
        },
        'recorder_share': {
            engine: share and {'wall': share[0], 'cpu': share[1]}
            for engine, share in shares.items()
        },
        'with_and_without_recorder': {
            engine: [[run.model_dump(mode='json') for run in pair] for pair in pairs]
            for engine, pairs in campaign.recorder_pairs.items()
        },
        'beside_the_ticks': {
            name: figures.model_dump(mode='json')
            for name, figures in _beside(campaign, plan).items()
        },
        'load_services_s': [dict(each) for each in campaign.load_services_s],
    }


def _speed_table(measured: Sequence[Measured]) -> Table:
    rows: list[list[Cell]] = []
    for each in measured:
        factor, us = each.real_time_factor, each.us_per_tick
        rows.append(
            [
                each.engine,
                each.agents,
                each.uavs,
                each.seconds,
                len(each.runs),
                round(us.median),
                round(each.cpu_us_per_tick.median),
                round(factor.median, 1),
                f'{factor.low:.1f} – {factor.high:.1f}',
                median(run.load_s for run in each.runs),
                median(run.close_s for run in each.runs),
                each.verify_s,
                ', '.join(f'{name} {share:.0%}' for name, share in _shown_shares(each)),
            ]
        )
    return Table(
        headings=(
            *('engine', 'agents', 'UAVs', 's', 'runs', 'us/tick', 'CPU us/tick', 'RTF'),
            *('RTF least – greatest', 'load s', 'close s', 'verify s', 'share of the CPU'),
        ),
        rows=rows,
        caption='Speed of the tick loop',
    )


def _parts_table(measured: Sequence[Measured], names: Sequence[str], caption: str) -> Table:
    rows: list[list[Cell]] = []
    for each in measured:
        parts = shown_parts(each)
        rows.append(
            [
                each.agents,
                each.uavs,
                each.seconds,
                *(round(parts.get(name, 0.0)) for name in names),
            ]
        )
    return Table(headings=('agents', 'UAVs', 's', *names), rows=rows, caption=caption)


def _beside(campaign: Campaign, plan: Plan) -> dict[str, Spread]:
    """Return what is measured once and for all, by name with unit."""
    values: dict[str, list[float]] = {
        'bare barrier [us/tick]': campaign.barrier_us,
        'cold start of the graph [s]': campaign.cold_start_s,
        'bare start of as many processes [s]': campaign.bare_start_s,
        "SUMO's reload alone [s]": campaign.sumo_reload_s,
    }
    base = find(campaign.measured, 'ros', plan.base.agents, plan.base.seconds)
    local = find(campaign.measured, 'local', plan.base.agents, plan.base.seconds)
    if base is not None:
        barrier_us = median(campaign.barrier_us)
        values['warm reset, execute to tick 0 [s]'] = [run.load_s for run in base.runs]
        name = 'graph tick / bare barrier [ratio]'
        values[name] = [run.us_per_tick / barrier_us for run in base.runs]
        if local is not None:
            work_us = barrier_us + local.us_per_tick.median
            name = 'graph tick / (bare barrier + local tick) [ratio]'
            values[name] = [base.us_per_tick.median / work_us]
    if local is not None:
        name = "SUMO's step with its state read [us/tick]"
        values[name] = [run.sumo_wall_s / run.ticks * 1e6 for run in local.runs]
        name = "local tick / SUMO's step with its state read [ratio]"
        values[name] = [run.over_sumo_wall for run in local.runs]
        name = "local tick / SUMO's step with its state read [ratio of CPU times]"
        values[name] = [run.over_sumo for run in local.runs]
    for name in ('sync', 'ground', 'uav'):
        values[f'load service of {name} [s]'] = [each[name] for each in campaign.load_services_s]
    for engine, pairs in campaign.recorder_pairs.items():
        values[f'{engine} with recorder [us/tick]'] = [run.us_per_tick for run, _ in pairs]
        values[f'{engine} without recorder [us/tick]'] = [run.us_per_tick for _, run in pairs]
    return {name: spread(each) for name, each in values.items() if each}


def _spread_row(name: str, figures: Spread) -> list[Cell]:
    return [name, figures.median, figures.low, figures.high, figures.count]


def _shares(parts: dict[str, float]) -> dict[str, float]:
    total = sum(parts.values())
    return {name: us / total if total > 0.0 else 0.0 for name, us in parts.items()}


def _shown_shares(each: Measured) -> list[tuple[str, float]]:
    return [(name, share) for name, share in _shares(shown_parts(each)).items() if share >= 0.005]
