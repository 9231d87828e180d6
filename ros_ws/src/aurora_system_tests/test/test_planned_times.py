# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What happens in a run lies between the earliest and the latest time of its schedule."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.judging.codec import conditions_from_json
from aurora_core.judging.evaluation import Context
from aurora_core.judging.happening import moment
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.verification import load_bag
from aurora_core.quantities.view import RunView
from aurora_core.trace.bag_content import BagContent
from aurora_system_tests.local_runs import run_prompt

PROMPTS = {
    'two missions and a deadline': (
        'A drone hovers over City Hall at 50 m for 20 seconds and then flies a rectangle of 100 m '
        'by 60 m. It must be on the ground by 200 s.'
    ),
    'one after the other': (
        'Drone A hovers at 30 m over City Hall for 20 s. After it has finished its mission drone '
        'B hovers over Harbor Market at 40 m for 20 s.'
    ),
    'an altitude that is waited for': (
        'The drone ascends to 40 m. When it reaches 40 m the ambulance starts. The drone tracks '
        'the ambulance for 20 s.'
    ),
}


@pytest.mark.parametrize('name', PROMPTS)
def test_a_run_keeps_to_its_schedule(name: str, tmp_path: Path) -> None:
    report, bag = run_prompt('times', PROMPTS[name], 1, tmp_path, LocalStages(installed()))
    assert report.status == 'verified'
    content, agsg = load_bag(bag)
    assert agsg.schedule is not None
    happened = _happened(content, agsg)
    assert {time.point for time in agsg.schedule.times} == set(happened)
    for time in agsg.schedule.times:
        assert time.earliest_s <= happened[time.point] <= time.latest_s, time.point


def _happened(content: BagContent, agsg: Agsg) -> dict[str, float]:
    """Return when each event, mission and landing was, recomputed from the states."""
    conditions = conditions_from_json(content.world.conditions_json)
    context = Context(RunView(content.trace, content.world), agsg.realised_spec, conditions)
    touchdown_m = installed().tolerances.touchdown_height_m
    ticks = {f'events/{event.id}': moment(context, event.id) for event in agsg.spec.events}
    for mission in context.mission_arguments:
        phase = context.phase(mission, touchdown_m)
        ticks[f'missions/{mission.mission}/captured'] = phase.capture_tick
        ticks[f'missions/{mission.mission}/over'] = phase.end_tick
        landed = context.flight(mission, touchdown_m).landed_tick
        ticks[f'uavs/{mission.uav}/landed'] = landed
    return {point: context.time_s(tick) for point, tick in ticks.items() if tick is not None}
