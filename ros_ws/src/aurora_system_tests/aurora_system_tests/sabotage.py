# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine with an executor that something is wrong with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.comm.link import MessageLink
from aurora_core.execution.events import EventRunner
from aurora_core.execution.plan import Execution
from aurora_core.execution.scenario_executor import ScenarioExecutor
from aurora_core.execution.step_output import Stepper
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import RunRequest
from aurora_core.pipeline.verification import judge_content, load_bag
from aurora_core.spec.scenario import Event

Sabotage = Callable[[ScenarioExecutor], Stepper]


class SabotagedStages(LocalStages):
    """The local engine with another executor.

    Args:
        sabotage: Makes it of the honest one.
    """

    def __init__(self, sabotage: Sabotage) -> None:
        super().__init__(installed())
        self._sabotage = sabotage

    def execution(self, agsg: Agsg, request: RunRequest) -> Execution:
        """Return what is run, with the sabotaged executor."""
        honest = super().execution(agsg, request)
        assert isinstance(honest.stepper, ScenarioExecutor)
        return replace(honest, stepper=self._sabotage(honest.stepper))

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Judge without the honest executor beside it, which would find every bug at once."""
        content, recorded = load_bag(bag)
        self.judged = judge_content(self.known, content, recorded, recompute=False)
        return self.judged.verdict


def with_runner(kind: type[EventRunner]) -> Sabotage:
    """Return the sabotage that runs the events otherwise."""

    def sabotage(executor: ScenarioExecutor) -> Stepper:
        executor._runner = executor._run_events(kind)
        return executor

    return sabotage


def with_machines(
    kind: type[MissionMachine] = MissionMachine, plan: Callable[[UavPlan], UavPlan] = lambda p: p
) -> Sabotage:
    """Return the sabotage that flies otherwise, or another plan than the one grounded."""

    def sabotage(executor: ScenarioExecutor) -> Stepper:
        machines = tuple(kind(plan(m.plan), m._settings, m._dt) for m in executor._setup.machines)
        return ScenarioExecutor(replace(executor._setup, machines=machines))

    return sabotage


def with_links(kind: type[MessageLink], **settings: str) -> Sabotage:
    """Return the sabotage that carries messages otherwise, or between others."""

    def sabotage(executor: ScenarioExecutor) -> Stepper:
        links = tuple(
            kind(replace(k.settings, **settings), k._dt, k._generator, k._loss_at)  # type: ignore[arg-type]
            for k in executor._setup.links
        )
        other = ScenarioExecutor(replace(executor._setup, links=links))
        if settings:  # the sender of an event would not find its link any more
            other._runner._links = links
            for state in other._runner._states:
                action = dict(state.event.action or {}) | settings
                event = dict(state.event) | {'action': action}
                state.event = Event.model_validate(event)
        return other

    return sabotage


def with_agents(**changes: Any) -> Sabotage:
    """Return the sabotage that carries out other groundings of the vehicles and persons."""

    def sabotage(executor: ScenarioExecutor) -> Stepper:
        agents = tuple(a.model_copy(update=changes) for a in executor._setup.agents)
        return ScenarioExecutor(replace(executor._setup, agents=agents))

    return sabotage
