# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a measurement was made of, and the refusal of one that was made of something else.

Records are what `aurora map measure` wrote. They name, with digests, the files, the simulator and
the numbers that they depend on; whoever loads them compares these with what is installed.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, MAP_BYTES, read_bytes
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.vocabulary import Weather

Made = Mapping[str, str | float]

_DEFAULT_MAP = 'downtown'
# Distribution that carries the ground simulator.
_SIMULATOR = 'libsumo'
# Package that carries the air simulator, and its files that decide how a vehicle flies.
_AIR_SIMULATOR = 'aurora_uav_sim'
_FLIGHT_FILES = ('autopilot.py', 'battery.py', 'control.py', 'multirotor.py', 'wind.py')


def measure_command(map_name: str = '') -> str:
    """Return the command that measures a map; '': the vehicles, with any map."""
    return f'aurora map measure {map_name or _DEFAULT_MAP}' + (
        '' if map_name else ' (or the map that you use)'
    )


def simulator_version() -> str:
    """Return the version of the installed ground simulator, '' where none is installed."""
    try:
        return metadata.version(_SIMULATOR)
    except metadata.PackageNotFoundError:
        return ''


def air_simulator_sha256() -> str:
    """Return the digest (hex) of the code that flies, '' where no air simulator is installed."""
    found = find_spec(_AIR_SIMULATOR)
    folder = None if found is None or found.origin is None else Path(found.origin).parent
    if folder is None:
        return ''
    data = b''.join(read_bytes(folder / name, CONFIG_BYTES) for name in _FLIGHT_FILES)
    return hashlib.sha256(data).hexdigest()


def file_sha256(path: Path) -> str:
    """Return the digest (hex) of a file of the configuration.

    Raises:
        ConfigError: It cannot be read.
    """
    try:
        return hashlib.sha256(read_bytes(path, MAP_BYTES)).hexdigest()
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err


def vtypes_path() -> Path:
    """Return the file of the vehicle types for the ground simulator."""
    return config_path('maps', 'vtypes.add.xml')


def ground_basis(dt_s: float) -> dict[str, str | float]:
    """Return what the records of ground vehicles are made of here."""
    return {
        'simulator': simulator_version(),
        'vtypes_sha256': file_sha256(vtypes_path()),
        'dt_s': dt_s,
    }


def uav_basis(dt_s: float, limits: Limits) -> dict[str, str | float]:
    """Return what the record of the multirotor is made of here.

    Args:
        dt_s: Step of the set-points.
        limits: Whose link ranges and winds it is measured at.
    """
    return {
        'air_simulator': air_simulator_sha256(),
        'multirotor_sha256': file_sha256(config_path('multirotor.json')),
        'dt_s': dt_s,
        'link_range_sight_m': limits.link_range_sight_m,
        'link_range_blocked_m': limits.link_range_blocked_m,
        'wind_max_mps': limits.wind_max_mps,
        **{
            f'wind_{weather}': f'{mean_mps:g} m/s, gusts {gust_mps:g} m/s'
            for weather, (mean_mps, gust_mps) in weather_winds(limits).items()
        },
    }


def weather_winds(limits: Limits) -> dict[str, tuple[float, float]]:
    """Return the wind of each weather, mean and gust, m/s."""
    names = [weather.value for weather in Weather]
    return {name: (limits.wind_mean_mps[name], limits.wind_gust_mps[name]) for name in names}


def check_made_of(path: Path, made: Made, here: Made, map_name: str = '') -> None:
    """Refuse records that were made of something else than what is installed.

    Where a simulator is not installed, nothing can run on it: it is not compared.

    Args:
        path: File of the records.
        made: What they were made of.
        here: What is installed.
        map_name: Map whose measurement writes them; '': that of any map does.

    Raises:
        ConfigError: They differ; says in what, and the command that measures again.
    """
    for name, value in here.items():
        if name in ('simulator', 'air_simulator') and not value:
            continue
        if made.get(name) != value:
            raise ConfigError(
                f'{path} was measured with {name} {_short(made.get(name))}, here is '
                f'{_short(value)}',
                hint=f'measure again: {measure_command(map_name)}',
            )


def _short(value: str | float | None) -> str:
    text = 'none' if value is None else str(value)
    return f'{text[:12]}…' if len(text) > 32 else text
