# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Errors across the wire and back."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from aurora_core import errors
from aurora_core.errors import AuroraError
from aurora_msgs.msg import Fault
from aurora_ros.errors import raise_error, read_error, write_error


def classes(kind: type[AuroraError] = AuroraError) -> list[type[AuroraError]]:
    return [kind] + [c for child in kind.__subclasses__() for c in classes(child)]


CORE = [kind for kind in classes() if kind.__module__ == errors.__name__]


@pytest.mark.parametrize('kind', CORE)
@pytest.mark.parametrize('hint', ['', 'look: here'])
def test_class_component_message_and_hint_survive(kind: type[AuroraError], hint: str) -> None:
    sent = kind('expected 1: found 2', hint=hint)
    message = Fault()
    write_error(message, sent)
    got = read_error(message, 'somebody')
    assert got is not None
    assert type(got).default_code == kind.default_code
    assert (got.code, got.component) == (sent.code, sent.component)
    assert (got.message, got.hint) == (sent.message, sent.hint)


def test_no_code_is_no_error() -> None:
    assert read_error(Fault(error_msg='nothing'), 'somebody') is None
    raise_error(Fault(), 'somebody')


def test_the_server_is_the_component_when_the_text_names_none() -> None:
    got = read_error(Fault(error_code=499, error_msg='It broke: badly'), 'uav_bridge')
    assert isinstance(got, errors.SimulatorError), 'the class that opens the block'
    assert got.component == 'uav_bridge'
    assert got.message == 'It broke: badly'


def test_an_unknown_block_is_still_an_error() -> None:
    with pytest.raises(AuroraError, match='strange') as caught:
        raise_error(Fault(error_code=9999, error_msg='strange'), 'somebody')
    assert caught.value.code == 9999
