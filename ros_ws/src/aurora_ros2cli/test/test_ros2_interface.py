# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface show` on definitions of its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_ros2cli.bag.schema import schema_text
from aurora_ros2cli.interface.show import nested_type
from aurora_ros2cli.main import main


@pytest.fixture
def definitions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    marker = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages' / 'zoo'
    marker.parent.mkdir(parents=True)
    marker.touch()
    for name, text in {
        'msg/Cage': '# A cage.\nfloat64 width_m # metres\n\nBeast[] beasts\n',
        'msg/Beast': '# A beast.\nuint8 LION = 1\nuint8 kind\nstring<=8 name\n',
        'srv/Feed': 'zoo/Cage cage\n---\nbool fed\n',
    }.items():
        kind, base = name.split('/')
        file = tmp_path / 'share' / 'zoo' / kind / f'{base}.{kind}'
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    return tmp_path


BEAST = ['\tuint8 LION = 1', '\tuint8 kind', '\tstring<=8 name']


def test_nested_types_are_indented_without_their_comments(
    definitions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(['interface', 'show', 'zoo/msg/Cage']) == 0

    lines = capsys.readouterr().out.splitlines()
    assert lines == ['# A cage.', 'float64 width_m # metres', '', 'Beast[] beasts', *BEAST]


def test_all_comments_and_no_comments(
    definitions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(['interface', 'show', '--all-comments', 'zoo/msg/Cage'])
    assert '\t# A beast.' in capsys.readouterr().out.splitlines()

    main(['interface', 'show', '--no-comments', 'zoo/msg/Cage'])
    assert capsys.readouterr().out.splitlines() == ['float64 width_m', 'Beast[] beasts', *BEAST]


def test_a_service_shows_both_halves(
    definitions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(['interface', 'show', '--no-comments', 'zoo/srv/Feed'])

    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == 'zoo/Cage cage'
    assert lines[-2:] == ['---', 'bool fed']
    assert '\t\tuint8 kind' in lines


@pytest.mark.parametrize(
    ('name', 'message'),
    [
        ('zoo/Cage', "Invalid name 'zoo/Cage'. Expected three parts separated by '/'"),
        ('zoo/msg/Moat', "Could not find the interface 'zoo/msg/Moat'"),
        ('sea/msg/Wave', "Package 'sea' not found"),
        ('zoo/idl/Cage', "Invalid name 'zoo/idl/Cage'"),
    ],
)
def test_unknown_names_fail(
    definitions: Path, capsys: pytest.CaptureFixture[str], name: str, message: str
) -> None:
    assert main(['interface', 'show', name]) == 1
    assert capsys.readouterr().err.startswith(message)


@pytest.mark.parametrize(
    ('code', 'expected'),
    [
        ('Beast beast', 'zoo/msg/Beast'),
        ('Beast[<=3] beasts', 'zoo/msg/Beast'),
        ('std_msgs/Header header', 'std_msgs/msg/Header'),
        ('float64[6] covariance', None),
        ('string<=8[] names', None),
        ('uint8 LION=1', None),
        ('uint8 kind 3', None),
        ('string name "a b"', None),
        ('---', None),
        ('', None),
    ],
)
def test_which_lines_hold_a_nested_type(code: str, expected: str | None) -> None:
    assert nested_type(code, 'zoo') == expected


def test_lists_of_interfaces(definitions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def lines(*arguments: str) -> list[str]:
        assert main(['interface', *arguments]) == 0
        return capsys.readouterr().out.splitlines()

    assert lines('list') == [
        'Messages:', '    zoo/msg/Beast', '    zoo/msg/Cage', 'Services:', '    zoo/srv/Feed',
        'Actions:',
    ]  # fmt: skip
    assert lines('list', '-s') == ['Services:', '    zoo/srv/Feed']
    assert lines('package', 'zoo') == ['zoo/msg/Beast', 'zoo/msg/Cage', 'zoo/srv/Feed']
    assert lines('package', '-m', 'zoo') == ['zoo/msg/Beast', 'zoo/msg/Cage']
    assert lines('packages') == ['zoo']
    assert lines('packages', '-a') == []

    assert main(['interface', 'package', 'sea']) == 1
    assert capsys.readouterr().err == "Unknown package 'sea'\n"


def test_the_schema_of_a_bag_holds_every_definition_once(definitions: Path) -> None:
    text = schema_text('zoo/msg/Cage')

    own, *nested = text.split('=' * 80 + '\n')
    assert own.endswith('Beast[] beasts\n')
    assert nested == ['MSG: zoo/Beast\n# A beast.\nuint8 LION = 1\nuint8 kind\nstring<=8 name\n']
