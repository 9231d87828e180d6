# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When a command that has just started takes the graph as known."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_ros2cli.discovery import (
    ALONE_S,
    QUIET_S,
    QUIET_UNSURE_S,
    domain_id,
    enough,
    participants_here,
)
from aurora_ros2cli.errors import CliError

HEAD = '  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid\n'


def sockets(path: Path, *ports: int) -> Path:
    """Write a table of UDP sockets as the kernel shows it."""
    path.write_text(
        HEAD + ''.join(f' 1: 0100007F:{port:04X} 00000000:0000 07 0 0 0\n' for port in ports)
    )
    return path


def test_participants_are_counted_by_their_pairs_of_ports(tmp_path: Path) -> None:
    base = 7400 + 250 * 60
    # Multicast, three participants with a gap, a MAVLink port, one of the next domain.
    table = sockets(
        tmp_path / 'udp', base, base + 10, base + 11, base + 12, base + 13, base + 20, base + 21,
        base + 200, base + 250, base + 260, base + 261,
    )  # fmt: skip

    assert participants_here(60, table) == 3
    assert participants_here(61, table) == 1


def test_without_ports_nothing_is_known(tmp_path: Path) -> None:
    assert participants_here(60, tmp_path / 'missing') is None
    assert participants_here(60, sockets(tmp_path / 'udp', 53)) is None


@pytest.mark.parametrize(
    ('expected', 'view', 'passed_s', 'quiet_s', 'alone', 'done'),
    [
        (1, (1, 1), 0.0, 0.0, True, True),  # nobody else: at once
        (3, (2, 2), 9.0, 9.0, False, False),  # one is still missing
        (3, (3, 3), 0.4, QUIET_S, False, True),
        (3, (3, 3), 0.4, QUIET_S / 2, False, False),
        (3, (3, 2), 0.4, QUIET_S, False, False),  # its node is still missing
        (3, (3, 2), 2.0, QUIET_UNSURE_S, False, True),
        (None, (1, 1), QUIET_UNSURE_S, QUIET_UNSURE_S, True, False),
        (None, (1, 1), ALONE_S, ALONE_S, True, True),
        (None, (2, 2), 1.5, QUIET_UNSURE_S, False, True),
    ],
)
def test_when_looking_ends(
    expected: int | None,
    view: tuple[int, ...],
    passed_s: float,
    quiet_s: float,
    alone: bool,
    done: bool,
) -> None:
    assert enough(expected, view, passed_s, quiet_s, alone) is done


@pytest.mark.parametrize('text', ['x', '-1', '233', '1.5'])
def test_a_domain_that_cannot_be(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv('ROS_DOMAIN_ID', text)

    with pytest.raises(CliError, match=f"ROS_DOMAIN_ID is '{text}'"):
        domain_id()
