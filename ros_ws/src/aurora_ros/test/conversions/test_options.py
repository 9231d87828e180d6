# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Options of a run as JSON."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import SpecError
from aurora_core.execution.faults import Fault
from aurora_core.pipeline.stages import RunRequest
from aurora_ros.conversions.options import (
    options_json,
    repair_processes,
    run_request,
    runs_directory,
)


def test_nothing_stated_gives_the_defaults() -> None:
    assert run_request('go', '') == RunRequest(prompt='go')


def test_options_survive() -> None:
    request = RunRequest(
        prompt='go', map_name='junction', seed=9, faults=(Fault(kind='link_loss', subject='*'),)
    )
    assert run_request('go', options_json(request)) == request


def test_short_names_and_the_folder() -> None:
    options = '{"map": "junction", "seed": 3, "out": "/tmp/x"}'
    assert run_request('go', options) == RunRequest(prompt='go', map_name='junction', seed=3)
    assert runs_directory(options) == Path('/tmp/x')
    assert runs_directory('') is None


def test_processes_are_no_part_of_a_request() -> None:
    assert run_request('go', '{"jobs": 2}') == RunRequest(prompt='go')
    assert [repair_processes(text) for text in ('', '{"jobs": null}', '{"jobs": 2}')] == [
        None,
        None,
        2,
    ]


@pytest.mark.parametrize('jobs', ['0', '-1', '"2"', 'true', '1.5'])
def test_a_number_of_processes_that_is_none_is_refused(jobs: str) -> None:
    with pytest.raises(SpecError, match='options_json'):
        repair_processes(f'{{"jobs": {jobs}}}')


@pytest.mark.parametrize(
    'options',
    [
        '{',
        '[]',
        '3',
        '{"sed": 1}',
        '{"seed": "one"}',
        '{"seed": 1.5}',
        '{"seed": true}',
        '{"seed": -1}',
        '{"seed": 2147483648}',
        '{"faults": [{"kind": "x"}]}',
        '[' * 100_000,
    ],
    ids=lambda options: options[:30],
)
def test_unknown_names_and_values_are_refused(options: str) -> None:
    with pytest.raises(SpecError, match='options_json'):
        run_request('go', options)


@pytest.mark.parametrize('options', ['{"out": "runs"}', '{"out": 3}'])
def test_a_folder_that_depends_on_where_the_node_runs_is_refused(options: str) -> None:
    with pytest.raises(SpecError, match='absolute path'):
        runs_directory(options)


@pytest.mark.parametrize('options', [r'{"out": "/\ud800"}', r'{"out": "/\u0000"}'])
def test_text_that_no_answer_could_carry_is_refused(options: str) -> None:
    with pytest.raises(SpecError, match=r'surrogate|NUL'):
        runs_directory(options)


def test_a_secret_in_the_address_of_a_model_is_refused_and_not_told() -> None:
    with pytest.raises(SpecError, match=r'models\.yaml') as refused:
        run_request('go', '{"model": "openai/x@http://me:hunter2@host/v1?key=hunter3"}')
    assert 'hunter' not in f'{refused.value} {refused.value.hint}'
