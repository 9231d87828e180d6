# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph that the tests look at: one node of each sort. Ends with its standard input."""

from __future__ import annotations

import importlib
import os
import sys
import threading
from typing import Any

import rclpy
from geometry_msgs.msg import PoseStamped
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

from aurora_msgs.action import ExecuteScenario
from aurora_msgs.srv import ParsePrompt

# No type information comes with it, and mypy is not told so for the whole project.
SetBool = importlib.import_module('std_srvs.srv').SetBool


def best_effort() -> QoSProfile:
    return QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


def latched() -> QoSProfile:
    return QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Keeper(LifecycleNode):
    """Refuses to be activated."""

    def on_activate(self, state: Any) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.FAILURE


def set_bool(request: Any, response: Any) -> Any:
    response.success = request.data
    response.message = 'heard'
    return response


def repeat(request: Any, response: Any) -> Any:
    response.error_msg = request.prompt
    return response


def execute(goal: Any) -> Any:
    result = ExecuteScenario.Result(outcome='finished')
    if goal.request.bag_directory == 'for ever':
        for tick in range(10_000):
            if goal.is_cancel_requested:
                goal.canceled()
                return result
            goal.publish_feedback(ExecuteScenario.Feedback(tick=tick))
            threading.Event().wait(0.05)
    goal.publish_feedback(ExecuteScenario.Feedback(sim_time_s=0.5, tick=10))
    if goal.request.bag_directory == 'nowhere':
        goal.abort()
        result.outcome = 'aborted'
    else:
        goal.succeed()
    return result


def accept(request: Any) -> GoalResponse:
    return GoalResponse.REJECT if request.bag_directory == 'no' else GoalResponse.ACCEPT


def main() -> None:
    rclpy.init()
    partner = rclpy.create_node('partner', namespace='/zoo')
    limits = IntegerRange(from_value=0, to_value=100, step=2)
    partner.declare_parameter(
        'legs', 4, ParameterDescriptor(description='of all animals', integer_range=[limits])
    )
    partner.declare_parameter('food.hay_kg', 2.5)
    partner.declare_parameter('food.names', ['hay', 'oats'])
    partner.create_service(SetBool, 'gate', set_bool)
    partner.create_service(ParsePrompt, 'repeat', repeat)
    ActionServer(
        partner,
        ExecuteScenario,
        'walk',
        execute,
        goal_callback=accept,
        cancel_callback=lambda _goal: CancelResponse.ACCEPT,
        callback_group=ReentrantCallbackGroup(),
    )
    partner.create_publisher(String, 'sign', latched()).publish(String(data='open'))
    pose = PoseStamped()
    pose.header.frame_id = 'map'
    partner.create_publisher(PoseStamped, 'pose', latched()).publish(pose)
    beat = partner.create_publisher(String, 'beat', best_effort())
    partner.create_timer(0.05, lambda: beat.publish(String(data='tick')))
    partner.create_publisher(String, 'mixed', best_effort())
    partner.create_publisher(String, 'mixed', QoSProfile(depth=5))
    partner.create_subscription(String, 'ear', lambda _message: None, 10)
    keeper = Keeper('keeper', namespace='/zoo')
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (partner, keeper, rclpy.create_node('_hidden', namespace='/zoo')):
        executor.add_node(node)
    print('ready', flush=True)  # noqa: T201
    threading.Thread(target=leave_with_parent, daemon=True).start()
    executor.spin()


def leave_with_parent() -> None:
    sys.stdin.read()
    os._exit(0)


if __name__ == '__main__':
    main()
