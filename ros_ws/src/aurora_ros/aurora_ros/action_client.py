# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An action client that may be used from another thread than the executor's."""

from __future__ import annotations

import threading
from typing import Any

from rclpy.action.client import ActionClient, ClientGoalHandle
from rclpy.task import Future


class ThreadedActionClient(ActionClient):
    """rclpy's client with one lock around sending and taking.

    rclpy sends a request and notes its number afterwards. When the answer is faster than the note
    it is thrown away ("Ignoring unexpected goal response") and the future never completes.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self._noting = threading.RLock()
        super().__init__(*arguments, **options)

    def send_goal_async(self, *arguments: Any, **options: Any) -> Future:
        """Send a goal and note its number before its answer is taken."""
        with self._noting:
            return super().send_goal_async(*arguments, **options)

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future:
        with self._noting:
            return super()._get_result_async(goal_handle)

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future:
        with self._noting:
            return super()._cancel_goal_async(goal_handle)

    def take_data(self) -> Any:
        """Take answers, none before its request was noted."""
        with self._noting:
            return super().take_data()
