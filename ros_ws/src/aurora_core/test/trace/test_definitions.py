# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Message layouts come from the .msg files, installed or in the checkout, and fit the code."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from aurora_core.errors import ConfigError
from aurora_core.trace import definitions, layout, messages, records
from aurora_core.trace.definitions import message_definitions


@pytest.fixture(autouse=True)
def _fresh() -> Iterator[None]:
    message_definitions.cache_clear()
    yield
    message_definitions.cache_clear()


def test_checkout_has_every_recorded_type(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)
    found = message_definitions()
    for type_name in messages.TOPICS.values():
        assert found.type_hash(type_name).startswith('RIHS01_')
        assert found.text(type_name)


def test_installed_definitions_win(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / 'share' / 'aurora_msgs' / 'msg'
    folder.mkdir(parents=True)
    (folder / 'Tick.msg').write_text('uint8 only_here\n', encoding='utf-8')
    monkeypatch.setenv('AMENT_PREFIX_PATH', f':{tmp_path / "none"}:{tmp_path}')
    found = message_definitions()
    value = found.create('aurora_msgs/msg/Tick', only_here=7)
    cdr = found.encode('aurora_msgs/msg/Tick', value)
    assert found.decode('aurora_msgs/msg/Tick', cdr).only_here == 7


def test_no_definitions_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)
    monkeypatch.setattr(definitions, '__file__', str(tmp_path / 'a' / 'definitions.py'))
    with pytest.raises(ConfigError, match='aurora_msgs') as caught:
        message_definitions()
    assert 'make setup' in caught.value.hint


def _constants(name: str) -> dict[str, int]:
    """Return the constants of a .msg file of the checkout."""
    folder = next(
        p / 'aurora_msgs' / 'msg'
        for p in Path(__file__).resolve().parents
        if (p / 'aurora_msgs' / 'msg').is_dir()
    )
    found = {}
    for line in (folder / f'{name}.msg').read_text(encoding='utf-8').splitlines():
        words = line.partition('#')[0].split()
        if len(words) == 2 and '=' in words[1]:
            key, _, value = words[1].partition('=')
            found[key] = int(value)
    return found


def test_constants_in_the_messages_are_those_of_the_code() -> None:
    assert _constants('GroundCommand') == {k.name: k.value for k in layout.GroundCommandKind}
    assert _constants('ScenarioEvent') == {k.name: k.value for k in records.ScenarioEventKind}
    link = _constants('LinkEvent')
    assert {k: v for k, v in link.items() if not k.startswith('REASON_')} == {
        k.name: k.value for k in records.LinkEventKind
    }
    assert {k[7:]: v for k, v in link.items() if k.startswith('REASON_')} == {
        k.name: k.value for k in records.LossReason
    }
    assert _constants('GroundState')['WIDTH'] == layout.GROUND_WIDTH
    assert _constants('UavState')['WIDTH'] == layout.UAV_WIDTH
    assert _constants('UavCommand')['WIDTH'] == layout.UAV_COMMAND_WIDTH
