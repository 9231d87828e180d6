# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What set-up prepares is there, and stands for the files of this checkout."""

from __future__ import annotations

import pytest

from aurora_cli.prepare import IMPORTED, compiled_values, package_folders
from aurora_core.compiled import Compiled


@pytest.mark.parametrize('value', compiled_values(), ids=lambda value: str(value.name))
def test_every_value_is_plain_and_made_from_files_that_are_there(value: Compiled) -> None:
    assert all(source.is_file() for source in value.sources)
    assert value.value() == value.make()


def test_names_are_unlike_each_other() -> None:
    names = [value.path for value in compiled_values()]
    assert len(set(names)) == len(names)


def test_packages_that_are_not_installed_are_left_out() -> None:
    folders = package_folders(('aurora_core', 'aurora_nowhere'))
    assert [folder.name for folder in folders] == ['aurora_core']


def test_the_list_of_imports_names_modules() -> None:
    assert all(package_folders((name.partition('.')[0],)) or name == 'yaml' for name in IMPORTED)
