# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Find the files of the configuration folder, installed or in a source checkout."""

from __future__ import annotations

import os
from pathlib import Path

from aurora_core.errors import ConfigError

ENVIRONMENT_VARIABLE = 'AURORA_CONFIG_DIR'
SHARE_NAME = 'aurora_config'


def config_path(*parts: str) -> Path:
    """Return the path of an existing file or folder below the configuration folder.

    Looked for, in this order: the folder named by `AURORA_CONFIG_DIR`, the installed share
    `aurora_config` on `AMENT_PREFIX_PATH`, the `config` folder of the source checkout.

    Args:
        parts: Path components below the configuration folder; none returns the folder itself.

    Raises:
        ConfigError: When there is no configuration folder or it lacks the file.
    """
    root = config_root()
    path = root.joinpath(*parts)
    if not path.exists():
        raise ConfigError(
            f'expected {"/".join(parts)} in the configuration folder {root}, found nothing there',
            hint='run `make setup`, or set AURORA_CONFIG_DIR to a complete configuration folder',
        )
    return path


def config_root() -> Path:
    """Return the configuration folder.

    Raises:
        ConfigError: When `AURORA_CONFIG_DIR` names no folder, or no place has one.
    """
    named = os.environ.get(ENVIRONMENT_VARIABLE, '')
    if named:
        root = Path(named)
        if not root.is_dir():
            raise ConfigError(
                f'{ENVIRONMENT_VARIABLE} names {root}, which is not a folder',
                hint=f'unset {ENVIRONMENT_VARIABLE} or let it name a configuration folder',
            )
        return root
    for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep):
        share = Path(prefix) / 'share' / SHARE_NAME
        if prefix and share.is_dir():
            return share
    checkout = _checkout_config(Path(__file__))
    if checkout is not None:
        return checkout
    raise ConfigError(
        f'expected a configuration folder in {ENVIRONMENT_VARIABLE}, in share/{SHARE_NAME} on '
        'AMENT_PREFIX_PATH or in the source checkout, found none',
        hint='run `make setup` and `source ros_ws/setup.bash`',
    )


def _checkout_config(start: Path) -> Path | None:
    """Return the nearest `config` folder with maps above a file, symbolic links followed."""
    for parent in start.resolve().parents:
        if (parent / 'config' / 'maps').is_dir():
            return parent / 'config'
    return None
