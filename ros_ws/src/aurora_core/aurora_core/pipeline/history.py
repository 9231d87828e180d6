# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The history of a request: which past runs it may look at, and what is kept of its own."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.pipeline.stages import RunRequest
from aurora_core.repair.experience import RepairEpisode, Taught, learned, remember_repairs
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status
from aurora_core.retrieval.episodes import Episode, EpisodeStore
from aurora_core.spec.scenario import ScenarioSpec


def history_of(request: RunRequest) -> EpisodeStore | None:
    """Return the history that a request names, None without one."""
    if request.history is None:
        return None
    return EpisodeStore(request.history, frozen=request.history_frozen)


def remember(request: RunRequest, report: RunReport, spec: ScenarioSpec | None) -> bool:
    """Keep a verified run in the history of its request; return whether it was kept.

    Raises:
        ConfigError: The history cannot be written.
    """
    history = history_of(request)
    if history is None or spec is None or report.status is not Status.VERIFIED:
        return False
    # A run with injected faults shows what was done to it, not what the request is like.
    return not report.faults and history.add(episode_of(report, spec))


def learned_of(request: RunRequest) -> Taught:
    """Return what the history of a request teaches repair, nothing without one.

    Raises:
        ConfigError: The history cannot be read.
    """
    return Taught() if request.history is None else learned(request.history)


def remember_lessons(
    request: RunRequest, report: RunReport, episode: RepairEpisode | None
) -> bool:
    """Keep what repair learned in the history of a request; return whether it was kept.

    Raises:
        ConfigError: The history cannot be written.
    """
    if request.history is None or request.history_frozen or episode is None:
        return False
    # A run with injected faults shows what was done to it, not what the request is like.
    if report.faults or not episode.lessons:
        return False
    remember_repairs(request.history, episode)
    return True


def episode_of(report: RunReport, spec: ScenarioSpec) -> Episode:
    """Return what is kept of a run."""
    return Episode(
        id=report.run_id,
        prompt=report.prompt,
        map_name=report.map,
        status=report.status.value,
        elements=tuple(dict.fromkeys(_elements(spec))),
        conditions=tuple(condition.sentence for condition in report.conditions),
        worst_normalised=report.metrics.worst_normalised,
        trace_sha256=report.trace.sha256 if report.trace is not None else '',
    )


def _elements(spec: ScenarioSpec) -> Iterator[str]:
    for agent in spec.agents:
        kinds = ' '.join(behavior.kind.value for behavior in agent.behaviors)
        yield f'{agent.type.value} {kinds}'.strip()
    for mission in spec.missions:
        parts = (mission.mode, mission.pattern, mission.target)
        yield ' '.join(str(part) for part in parts if part is not None)
    for event in spec.events:
        cause = event.trigger.on if event.trigger is not None else ''
        effect = event.action.do if event.action is not None else ''
        yield ' then '.join(filter(None, (cause, effect)))
    yield from (f'weather {spec.world.weather.value}', f'at {spec.world.time_of_day.value}')
