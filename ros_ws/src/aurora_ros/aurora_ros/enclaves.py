# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who may write and serve what, as a policy of SROS2: an enclave for each node, one for clients.

    python3 -m aurora_ros.enclaves > policy.xml

`tools/sros2.sh` makes keys and permissions of it. What is written and served is that of the table
of interfaces; everybody with an enclave may listen and ask. Whoever plays a recording writes in
others' names and has none.

Source: ROS 2 Access Control Policies (design.ros2.org), version 0.2.0 of the policy.
"""

from __future__ import annotations

import os
import sys
from xml.etree import ElementTree as Xml

from aurora_ros import interfaces as on
from aurora_ros.interfaces import NAMESPACE, NODES, Call, roll_call

ENABLE, OVERRIDE = 'ROS_SECURITY_ENABLE', 'ROS_SECURITY_ENCLAVE_OVERRIDE'
CLIENT = 'client'
_PLAYER = 'replay'
_ALL = f'/{NAMESPACE}/*'
_LISTENED = (_ALL, '/clock', '/rosout', '/parameter_events')
_OF_EVERY_NODE = ('/rosout', '/parameter_events')
_PARAMETERS = (
    'describe_parameters', 'get_parameters', 'get_parameter_types', 'get_type_description',
    'list_parameters', 'set_parameters', 'set_parameters_atomically',
)  # fmt: skip
_LIFECYCLE = (
    'change_state', 'get_available_states', 'get_available_transitions', 'get_state',
    'get_transition_graph',
)  # fmt: skip
_MANAGED = ('sync', 'sumo_bridge', 'uav_bridge', 'executor')
_CALLS = tuple(value for value in vars(on).values() if isinstance(value, Call))


def enclave(node: str) -> str:
    """Return the enclave of a node, or of clients."""
    return f'/{NAMESPACE}/{node}'


def take_enclave(node: str) -> None:
    """Let this process be a node's: where security is on, it has that node's keys from here on."""
    if os.environ.get(ENABLE) == 'true':
        os.environ[OVERRIDE] = enclave(node)


def policy() -> str:
    """Return the policy."""
    root = Xml.Element('policy', version='0.2.0')
    enclaves = Xml.SubElement(root, 'enclaves')
    for node in (*(name for name in NODES if name != _PLAYER), CLIENT):
        place = Xml.SubElement(enclaves, 'enclave', path=enclave(node))
        profiles = Xml.SubElement(place, 'profiles')
        _describe(Xml.SubElement(profiles, 'profile', ns=f'/{NAMESPACE}', node=node), node)
    Xml.indent(root)
    return Xml.tostring(root, encoding='unicode') + '\n'


def _describe(profile: Xml.Element, node: str) -> None:
    managed = node in _MANAGED
    written = [topic.full_name for topic in on.RUN_TOPICS if node in topic.writers]
    written += [f'/{NAMESPACE}/{node}/transition_event'] if managed else []
    served = [f'~/{name}' for name in (*_PARAMETERS, *(_LIFECYCLE if managed else ()))]
    served += [f'/{NAMESPACE}/{c.name}' for c in _CALLS if c.server == node and not c.is_action]
    served += [f'/{NAMESPACE}/{roll_call(node).name}'] if node != CLIENT else []
    done = [
        f'/{NAMESPACE}/{call.name}' for call in _CALLS if call.server == node and call.is_action
    ]
    for group, item, may, names in (
        ('topics', 'topic', 'subscribe', _LISTENED),
        ('topics', 'topic', 'publish', (*written, *_OF_EVERY_NODE)),
        ('services', 'service', 'request', (_ALL,)),
        ('services', 'service', 'reply', served),
        ('actions', 'action', 'call', (_ALL,)),
        ('actions', 'action', 'execute', done),
    ):
        if names:
            allowed = Xml.SubElement(profile, group, {may: 'ALLOW'})
            for name in names:
                Xml.SubElement(allowed, item).text = name


if __name__ == '__main__':
    sys.stdout.write(policy())
