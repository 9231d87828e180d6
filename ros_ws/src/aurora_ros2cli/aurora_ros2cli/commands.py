# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The table of commands and verbs: what each is for and which module does it.

A module offers `add_arguments(parser)` and `main(arguments)`, which returns the exit code. Several
verbs can share a module; the parsed arguments hold `command` and `verb`.
"""

from __future__ import annotations

from typing import NamedTuple


# Not dataclasses: importing those would take a tenth of the time of `ros2 run`.
class Verb(NamedTuple):
    """One verb, or a command that has none.

    Attributes:
        module: Module below `aurora_ros2cli`, imported only when the verb is called.
        help: One line for the help text.
    """

    module: str
    help: str


class Group(NamedTuple):
    """A command with verbs."""

    help: str
    verbs: dict[str, Verb]


COMMANDS: dict[str, Verb | Group] = {
    'action': Group(
        'Various action related sub-commands',
        {
            'find': Verb('find', 'Find actions from type'),
            'info': Verb('action.info', 'Print information about an action'),
            'list': Verb('listing', 'Output a list of action names'),
            'send_goal': Verb('action.send_goal', 'Send an action goal'),
            'type': Verb('type_of', "Print a action's type"),
        },
    ),
    'bag': Group(
        'Various rosbag related sub-commands',
        {
            'info': Verb('bag.info', 'Print information about a bag to the screen'),
            'play': Verb('bag.play', 'Play back ROS data from a bag'),
            'record': Verb('bag.record', 'Record ROS data to a bag'),
        },
    ),
    'daemon': Group(
        'Various daemon related sub-commands',
        {
            'status': Verb('daemon', 'Output the status of the daemon'),
            'stop': Verb('daemon', 'Stop the daemon if it is running'),
        },
    ),
    'doctor': Verb('doctor.command', 'Check ROS setup and other potential issues'),
    'interface': Group(
        'Show information about ROS interfaces',
        {
            'list': Verb('interface.list', 'List all interface types available'),
            'package': Verb(
                'interface.package',
                'Output a list of available interface types within one package',
            ),
            'packages': Verb(
                'interface.packages', 'Output a list of packages that provide interfaces'
            ),
            'show': Verb('interface.show', 'Output the interface definition'),
        },
    ),
    'launch': Verb('launching.command', 'Run a launch file'),
    'lifecycle': Group(
        'Various lifecycle related sub-commands',
        {
            'get': Verb('lifecycle.get', 'Get lifecycle state for one or more nodes'),
            'list': Verb('lifecycle.list', 'Output a list of available transitions'),
            'nodes': Verb('listing', 'Output a list of nodes with lifecycle'),
            'set': Verb('lifecycle.set', 'Trigger lifecycle state transition'),
        },
    ),
    'node': Group(
        'Various node related sub-commands',
        {
            'info': Verb('node.info', 'Output information about a node'),
            'list': Verb('listing', 'Output a list of available nodes'),
        },
    ),
    'param': Group(
        'Various param related sub-commands',
        {
            'describe': Verb(
                'param.describe', 'Show descriptive information about declared parameters'
            ),
            'dump': Verb(
                'param.dump', 'Show all of the parameters of a node in a YAML file format'
            ),
            'get': Verb('param.get', 'Get parameter'),
            'list': Verb('param.list', 'Output a list of available parameters'),
            'set': Verb('param.set', 'Set parameter'),
        },
    ),
    'pkg': Group(
        'Various package related sub-commands',
        {
            'executables': Verb(
                'pkg.executables', 'Output a list of package specific executables'
            ),
            'list': Verb('pkg.list', 'Output a list of available packages'),
            'prefix': Verb('pkg.prefix', 'Output the prefix path of a package'),
        },
    ),
    'run': Verb('run', 'Run a package specific executable'),
    'service': Group(
        'Various service related sub-commands',
        {
            'call': Verb('service.call', 'Call a service'),
            'find': Verb('find', 'Output a list of available services of a given type'),
            'list': Verb('listing', 'Output a list of available services'),
            'type': Verb('type_of', "Output a service's type"),
        },
    ),
    'topic': Group(
        'Various topic related sub-commands',
        {
            'bw': Verb('topic.bw', 'Display bandwidth used by topic'),
            'echo': Verb('topic.echo', 'Output messages from a topic'),
            'find': Verb('find', 'Output a list of available topics of a given type'),
            'hz': Verb('topic.hz', 'Print the average receiving rate to screen'),
            'info': Verb('topic.info', 'Print information about a topic'),
            'list': Verb('listing', 'Output a list of available topics'),
            'pub': Verb('topic.pub', 'Publish a message to a topic'),
            'type': Verb('type_of', "Print a topic's type"),
        },
    ),
    'wtf': Verb('doctor.command', 'Use `wtf` as alias to `doctor`'),
}
