# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Maps and the language model."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from urllib.parse import urlsplit

from aurora_cli.doctor.machine import Finding, Machine

OFFLINE = 'offline'
_CONNECT_LIMIT_S = 3.0
_PORTS = {'http': 80, 'https': 443}


def maps(machine: Machine) -> list[Finding]:
    """Every map is there and is, byte for byte, what its digests say."""
    from aurora_core.errors import AuroraError
    from aurora_core.knowledge.map_folders import list_maps
    from aurora_core.knowledge.map_model import load_map

    findings = []
    with _environment_of(machine):
        names = list_maps()
        if not names:
            return [Finding(expected='at least one map', found='none', fix='make maps')]
        for name in names:
            try:
                load_map(name)
            except AuroraError as err:
                findings.append(
                    Finding(
                        expected=f'map {name} with the files of its digests',
                        found=err.message,
                        fix=err.hint or 'make maps',
                    )
                )
    return findings


def records(machine: Machine) -> list[Finding]:
    """What was measured is of the vehicles, maps, limits and simulator that are here."""
    from aurora_core.errors import AuroraError, ConfigError
    from aurora_core.knowledge.map_folders import list_maps
    from aurora_core.pipeline.knowledge import installed_knowledge

    def finding(what: str, err: AuroraError) -> Finding:
        return Finding(
            expected=f'{what} measured as installed',
            found=err.message,
            fix=err.hint or 'aurora map measure downtown',
        )

    findings = []
    with _environment_of(machine):
        try:
            known = installed_knowledge()
        except ConfigError as err:
            return [finding('vehicles', err)]
        for name in list_maps():
            try:
                known.map(name)
            except AuroraError:
                continue  # told of by the check of maps
            try:
                known.measured(name)
            except AuroraError as err:
                findings.append(finding(f'map {name}', err))
    return findings


def model(machine: Machine) -> list[Finding]:
    """The configured language model can be reached; `offline` needs nothing."""
    if machine.model == OFFLINE:
        return []
    from aurora_core.ports.model_name import without_secrets

    shown = without_secrets(machine.model)
    provider = machine.model.partition('/')[0].upper().replace('-', '_')
    name = f'{provider}_API_BASE'
    base = machine.environment.get(name, '')
    address = urlsplit(base)
    if not base or address.scheme not in _PORTS or not address.hostname:
        return [
            Finding(
                expected=f'{name} with the address that serves {shown}',
                found=without_secrets(base) or 'not set',
                fix=f'export {name}=http://127.0.0.1:11434 (or use --model offline)',
            )
        ]
    port = address.port or _PORTS[address.scheme]
    try:
        socket.create_connection((address.hostname, port), timeout=_CONNECT_LIMIT_S).close()
    except OSError as err:
        return [
            Finding(
                expected=f'{shown} answers at {address.hostname}:{port}',
                found=f'{err.strerror or err} (waited up to {_CONNECT_LIMIT_S:g} s)',
                fix=f'start the server or correct {name}; without a network: --model offline',
            )
        ]
    return []


@contextmanager
def _environment_of(machine: Machine) -> Iterator[None]:
    """The folders of maps are found through these variables."""
    names = ('AURORA_CONFIG_DIR', 'AMENT_PREFIX_PATH', 'AURORA_MAPS', 'XDG_DATA_HOME', 'HOME')
    before = {name: os.environ.get(name) for name in names}
    try:
        for name in names:
            _set(name, machine.environment.get(name))
        yield
    finally:
        for name, value in before.items():
            _set(name, value)


def _set(name: str, value: str | None) -> None:
    if value is None:
        os.environ.pop(name, None)
    else:
        os.environ[name] = value
