# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where maps are: those of the configuration, and those that a user imported.

A map is a folder with a manifest. Names are looked up in listings, never joined to a path unseen,
so that no name can lead out of the two folders.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

from aurora_core.errors import MapError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_manifest import MANIFEST_NAME, NAME_PATTERN

OWN_MAPS_VARIABLE = 'AURORA_MAPS'
_MOST_NAME_CHARACTERS = 64


def own_maps_folder() -> Path:
    """Return the folder of imported maps, whether it exists or not.

    It is what `AURORA_MAPS` names, else `aurora/maps` below `XDG_DATA_HOME`, by default
    `~/.local/share`.
    """
    named = os.environ.get(OWN_MAPS_VARIABLE, '')
    if named:
        return Path(os.path.expanduser(named)).absolute()
    data = os.environ.get('XDG_DATA_HOME', '')
    # The XDG rules have a relative path ignored.
    home = Path(data) if data.startswith('/') else Path(os.path.expanduser('~/.local/share'))
    return home / 'aurora' / 'maps'


def is_map_name(name: str) -> bool:
    """Tell whether a map can have this name: small letters, digits, `_` and `-`."""
    return len(name) <= _MOST_NAME_CHARACTERS and re.fullmatch(NAME_PATTERN, name) is not None


def bundled_maps() -> tuple[str, ...]:
    """Return the names of the maps in the configuration folder, sorted.

    Raises:
        ConfigError: There is no configuration folder.
    """
    return _names(config_path('maps'))


def own_maps() -> tuple[str, ...]:
    """Return the names of the imported maps, sorted; a bundled map of the same name goes first."""
    return tuple(name for name in _names(own_maps_folder()) if name not in bundled_maps())


def list_maps() -> tuple[str, ...]:
    """Return the names of all maps, bundled and imported, sorted."""
    return tuple(sorted((*bundled_maps(), *own_maps())))


def map_folder(name: str) -> Path:
    """Return the folder of a map.

    Raises:
        MapError: There is no such map.
    """
    if name in bundled_maps():
        return config_path('maps', name)
    if name in own_maps():
        return own_maps_folder() / name
    raise MapError(
        f'there is no map {name!r}',
        hint=f'known maps: {", ".join(list_maps())}; own ones are looked for in '
        f'{own_maps_folder()}',
    )


def _names(folder: Path) -> tuple[str, ...]:
    found = (path.parent.name for path in folder.glob(f'*/{MANIFEST_NAME}'))
    # Names that no map can have are temporary folders of an import, or somebody else's.
    return tuple(sorted(name for name in found if is_map_name(name)))
