# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A domain is empty when a test gets it."""

from __future__ import annotations

import weakref

import pytest

pytest.importorskip('rclpy')

from rclpy.action import ActionClient

from aurora_ros import interfaces as on
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner

pytestmark = pytest.mark.ros


def test_nobody_is_left_of_the_test_before() -> None:
    with own_domain() as domain, partner(domain) as before:
        ActionClient(before.node, on.EXECUTE.type, on.EXECUTE.name)
        left = weakref.ref(before.node.context)
    del before
    with own_domain():
        assert left() is None
