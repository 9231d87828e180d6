# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The YAML files of the parser, read from what set-up compiled of them."""

from __future__ import annotations

import marshal
from functools import cache, partial
from pathlib import Path
from typing import Any

from aurora_core.compiled import Compiled
from aurora_core.errors import ConfigError

# All files but those of language models, which are read when one is asked.
NAMES = ('lexicon.yaml', 'criteria.yaml', 'defaults.yaml', 'asks_nothing.yaml')


def data_path(name: str) -> Path:
    """Return a file of this package."""
    return Path(__file__).parent / name


def compiled_data(name: str) -> Compiled:
    """Return the sections of a YAML file as set-up compiles them."""
    path = data_path(name)
    return Compiled(name=path.name, sources=(path,), make=partial(_parsed, name))


def read_data(name: str) -> dict[str, Any]:
    """Return the sections of a YAML file, a new value with each call; every scalar is text.

    Raises:
        ConfigError: The file is missing or is not a mapping.
    """
    return dict(marshal.loads(_read(name)))  # nosec B302


@cache
def _read(name: str) -> bytes:
    return marshal.dumps(compiled_data(name).value())


def _parsed(name: str) -> dict[str, Any]:
    # Imported here: what set-up has compiled needs no YAML.
    import yaml

    # Every scalar stays text: `on`, `no` and `off` are words here.
    loader = getattr(yaml, 'CBaseLoader', yaml.BaseLoader)
    try:
        text = data_path(name).read_text(encoding='utf-8')
        data = yaml.load(text, Loader=loader)  # noqa: S506  # nosec B506
    except (OSError, yaml.YAMLError) as err:
        raise ConfigError(f'the parser needs its file {name}: {err}') from err
    if not isinstance(data, dict):
        raise ConfigError(f'the parser expects a mapping in {name}, found {type(data).__name__}')
    return data
