# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The policy of SROS2 lets nobody write or serve but those that the table of interfaces names."""

from __future__ import annotations

import os
from fnmatch import fnmatchcase
from xml.etree import ElementTree as Xml

import pytest

pytest.importorskip('rclpy')

from aurora_ros import interfaces as on
from aurora_ros.enclaves import CLIENT, ENABLE, OVERRIDE, policy, take_enclave
from aurora_ros.interfaces import NAMESPACE, NODES, Call

_PROFILES = {
    profile.get('node', ''): profile for profile in Xml.fromstring(policy()).iter('profile')
}


def allowed(node: str, group: str, may: str, name: str) -> bool:
    found = [e.text or '' for e in _PROFILES[node].findall(f"{group}[@{may}='ALLOW']/*")]
    return any(fnmatchcase(name, pattern) for pattern in found)


def test_each_node_and_the_clients_have_an_enclave() -> None:
    assert set(_PROFILES) == {*NODES, CLIENT} - {'replay'}
    paths = [each.get('path') for each in Xml.fromstring(policy()).iter('enclave')]
    assert paths == [f'/{NAMESPACE}/{node}' for node in _PROFILES]


def test_a_topic_is_written_by_its_writers_alone_and_heard_by_all() -> None:
    for topic in on.RUN_TOPICS:
        writers = {n for n in _PROFILES if allowed(n, 'topics', 'publish', topic.full_name)}
        assert writers == {*topic.writers} & {*_PROFILES}, topic.name
        assert all(allowed(n, 'topics', 'subscribe', topic.full_name) for n in _PROFILES)


def test_a_call_is_served_by_its_server_alone() -> None:
    for call in (value for value in vars(on).values() if isinstance(value, Call)):
        group, may = ('actions', 'execute') if call.is_action else ('services', 'reply')
        name = f'/{NAMESPACE}/{call.name}'
        assert [n for n in _PROFILES if allowed(n, group, may, name)] == [call.server], name
        asks = ('actions', 'call') if call.is_action else ('services', 'request')
        assert allowed(CLIENT, *asks, name)


def test_a_node_takes_its_keys_only_where_security_is_on(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(OVERRIDE, '/aurora/client')
    monkeypatch.setenv(ENABLE, 'false')
    take_enclave('sync')
    monkeypatch.setenv(ENABLE, 'true')
    take_enclave('executor')
    assert os.environ[OVERRIDE] == '/aurora/executor'
