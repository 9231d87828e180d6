# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora new`: asks for the pieces of a scenario and writes the prompt."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from aurora_cli.answers import check_facts
from aurora_cli.files import write_file
from aurora_cli.output import UsageProblem, quiet_stdout, say
from aurora_cli.requests import RunOptions, checked, with_prompt
from aurora_core.errors import PromptError
from aurora_core.report.check_report import CheckResult, build_check
from aurora_core.report.visible import one_line

_T = TypeVar('_T')
NONE = 'none'
BODIES = ('ego car', 'bus', 'truck', 'van', 'motorcycle', 'cyclist', 'pedestrian')
OTHERS = ('van', 'truck', 'bus', 'car', 'motorcycle')
MISSIONS = ('follow', 'hover over', 'circle', 'patrol')
_VERBS = {'follow': 'follows', 'hover over': 'hovers over', 'circle': 'circles'}
PLACES = ('behind', 'ahead of')
WEATHERS = ('clear', 'rain', 'heavy rain', 'fog', 'snow')
# Above and beside whatever stands on the bundled maps, and within the limits of the multirotor.
_LEAST_ALTITUDE_M, _MOST_ALTITUDE_M = 10.0, 120.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Pieces:
    """What was answered; lengths in metres, times in seconds."""

    mission: str
    body: str
    altitude_m: float
    distance_m: float | None
    duration_s: float
    other: str
    place: str
    gap_m: float
    alert_m: float | None
    weather: str

    def prompt(self) -> str:
        """Return the prompt, in words that the built-in reader knows whole."""
        sentences = [self._others()] if self.other != NONE else []
        sentences.append(self._flight())
        if self.alert_m is not None:
            sentences.append(
                f'When the {self.other} comes within {self.alert_m:g} m of the {self.body}, the '
                f'drone alerts the {self.body}.'
            )
        return ' '.join(sentences)

    def _others(self) -> str:
        return f'A {self.other} drives {self.gap_m:g} m {self.place} the {self.body}.'

    def _flight(self) -> str:
        when = f'for {self.duration_s:g} seconds'
        sky = '' if self.weather == 'clear' else f'In {self.weather}, '
        a = 'a' if sky else 'A'
        if self.mission == 'patrol':
            side = f'{self.distance_m or 60:g}'
            return (
                f'{sky}{a} drone flies a rectangular patrol of {side} by {side} m at '
                f'{self.altitude_m:g} m altitude.'
            )
        verb = _VERBS[self.mission]
        far = ''
        if self.mission == 'follow':
            far = f', keeping a distance of {self.distance_m:g} m,'
        elif self.mission == 'circle':
            far = f' with a radius of {self.distance_m:g} m'
        return (
            f'{sky}{a} drone {verb} the {self.body} at {self.altitude_m:g} m altitude{far} {when}.'
        )


def new_command(output: Path | None, map_name: str) -> int:
    """Ask on standard error, write the prompt to standard output; return the exit code.

    Raises:
        UsageProblem: There is no such map, or the answers ended.
        AuroraError: The file cannot be written.
    """
    request = checked(RunOptions(map_name=map_name))
    prompt = ask().prompt()
    ready = with_prompt(request, prompt.encode())
    if isinstance(ready, PromptError):
        raise ready
    with quiet_stdout():
        report = build_check(check_facts(ready))
    sys.stdout.write(f'{one_line(prompt)}\n')
    if output is not None:
        write_file(output, f'{prompt}\n'.encode())
    say(f'aurora: {report.result.value}: {report.summary}')
    say('aurora: run it with: aurora run "…", or aurora new | aurora run -')
    return 0 if report.result is CheckResult.FEASIBLE else 3


def ask() -> Pieces:
    """Ask for every piece; an empty answer takes what stands in brackets."""
    mission = _choice('What does the drone do', MISSIONS)
    body = BODIES[0] if mission == 'patrol' else _choice('Whom does it watch', BODIES)
    altitude_m = _number('At which altitude (m)', 40.0, _LEAST_ALTITUDE_M, _MOST_ALTITUDE_M)
    distance_m = None
    if mission != 'hover over':
        what = {'patrol': 'How long is a side (m)', 'circle': 'With which radius (m)'}
        least_m = 20.0 if mission != 'follow' else 10.0
        distance_m = _number(what.get(mission, 'From how far (m)'), 30.0, least_m, 80.0)
    duration_s = 30.0 if mission == 'patrol' else _number('For how long (s)', 30.0, 5.0, 120.0)
    other = NONE
    place, gap_m, alert_m = PLACES[0], 30.0, None
    if mission != 'patrol' and body != 'pedestrian':
        others = tuple(name for name in OTHERS if name != body)
        other = _choice('Who else is on the road', (NONE, *others))
    if other != NONE:
        place = _choice(f'Where is the {other}, seen from the {body}', PLACES)
        gap_m = _number('How far away at the start (m)', 30.0, 10.0, 100.0)
        if _choice('Does the drone alert when it comes near', ('no', 'yes')) == 'yes':
            alert_m = _number('Within how many metres', round(gap_m * 2 / 3), 5.0, gap_m - 1.0)
    return Pieces(
        mission=mission,
        body=body,
        altitude_m=altitude_m,
        distance_m=distance_m,
        duration_s=duration_s,
        other=other,
        place=place,
        gap_m=gap_m,
        alert_m=alert_m,
        weather=_choice('In which weather', WEATHERS),
    )


def _choice(question: str, choices: tuple[str, ...]) -> str:
    def read(text: str) -> str:
        if text.isdecimal() and 1 <= int(text) <= len(choices):
            return choices[int(text) - 1]
        if text.lower() in choices:
            return text.lower()
        raise ValueError(f'one of {", ".join(choices)}, or its number')

    listed = ', '.join(f'{index} {name}' for index, name in enumerate(choices, start=1))
    return _asked(f'{question}? {listed}', choices[0], read)


def _number(question: str, default: float, least: float, most: float) -> float:
    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = float('nan')
        if not least <= value <= most:
            raise ValueError(f'a number from {least:g} to {most:g}')
        return value

    return _asked(f'{question}?', f'{default:g}', read)


def _asked(question: str, default: str, read: Callable[[str], _T]) -> _T:
    while True:
        sys.stderr.write(f'{question} [{default}]: ')
        sys.stderr.flush()
        answer = sys.stdin.readline()
        if not answer:
            raise UsageProblem('the answers ended before the last question')
        try:
            return read(answer.strip() or default)
        except ValueError as err:
            say(f'        expected {err}')
