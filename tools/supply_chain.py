# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the packages are that AURORA is made with: hashes, licences, start-up code, and a list of
them for other tools (CycloneDX).

    python tools/supply_chain.py check            what is wrong with locks and environment
    python tools/supply_chain.py sbom FILE        the bill of materials of the run lock
"""

from __future__ import annotations

import json
import re
import sys
import sysconfig
import tomllib
import uuid
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import distributions
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
REQUIREMENTS = ROOT / 'requirements'
RIVALS = 'rivals-'
_PINNED = re.compile(r'([A-Za-z0-9][A-Za-z0-9._-]*)==([^\s;\\]+)')
_HASH = re.compile(r'--hash=sha256:([0-9a-f]{64})')
_NAMESPACE = uuid.UUID('6ba7b811-9dad-11d1-80b4-00c04fd430c8')  # RFC 4122, of addresses


@dataclass(frozen=True, slots=True, kw_only=True)
class Locked:
    """A package of a lock file.

    Attributes:
        name: As the index has it.
        version: The one that is installed.
        hashes: sha256 (hex) of each of its files.
    """

    name: str
    version: str
    hashes: tuple[str, ...] = field(default=())


@cache
def known() -> dict[str, Any]:
    """Return `requirements/licences.toml`."""
    return tomllib.loads((REQUIREMENTS / 'licences.toml').read_text(encoding='utf-8'))


def read_lock(path: Path) -> tuple[Locked, ...]:
    """Return the packages of a lock file."""
    text = path.read_text(encoding='utf-8').replace('\\\n', ' ')
    found = []
    for line in text.splitlines():
        pinned = _PINNED.match(line)
        if pinned is not None:
            hashes = tuple(_HASH.findall(line))
            found.append(Locked(name=pinned[1].lower(), version=pinned[2], hashes=hashes))
        elif line.strip() and not line.startswith('#'):
            raise ValueError(f'{path.name} has a line that pins nothing: {line.strip()[:80]}')
    return tuple(found)


def lock_problems(path: Path) -> Iterator[str]:
    """Yield what of a lock has no hash, no licence that may be, or is banned."""
    listed = known()
    allowed = set(listed['allowed'])
    if path.name.startswith(RIVALS):
        allowed |= set(listed['rivals_too'])
    for package in read_lock(path):
        where = f'{path.name}: {package.name}'
        if not package.hashes:
            yield f'{where} has no hash'
        if f'{package.name}=={package.version}' in listed['banned']:
            yield f'{where} {package.version} is banned'
        licence = listed['licences'].get(package.name)
        if licence is None:
            yield f'{where} has no licence in licences.toml'
        elif not may_use(licence, allowed):
            yield f'{where} has the licence {licence}, which is not allowed'


def may_use(expression: str, allowed: Iterable[str]) -> bool:
    """Tell whether an SPDX expression can be met with these licences: one side of each OR."""
    choices = (choice.split(' AND ') for choice in expression.split(' OR '))
    return any(all(part.strip() in allowed for part in parts) for parts in choices)


def licences_that_differ() -> Iterator[str]:
    """Yield the installed packages that tell another licence than is listed for them."""
    listed: dict[str, str] = known()['licences']
    for found in distributions():
        told, name = found.metadata.json.get('license_expression'), found.name.lower()
        if told and name in listed and listed[name] != told:
            yield f'{name} says that its licence is {told}, licences.toml has {listed[name]}'


def start_up_problems(folder: Path) -> Iterator[str]:
    """Yield the `.pth` files of an environment that run code and that nobody has looked at.

    Args:
        folder: `site-packages`. Lines that only name a folder run nothing.
    """
    owners = {
        file.name: found.name.lower()
        for found in distributions(path=[str(folder)])
        for file in found.files or ()
        if file.suffix == '.pth' and len(file.parts) == 1
    }
    for path in sorted(folder.glob('*.pth')):
        lines = path.read_text(encoding='utf-8', errors='replace').splitlines()
        if not any(line.startswith(('import ', 'import\t')) for line in lines):
            continue
        expected, owner = known()['pth'].get(path.name), owners.get(path.name)
        if expected is None:
            yield f'{path.name} runs code at every start, and is not in licences.toml'
        elif owner != expected:
            yield f'{path.name} is of {owner or "no package"}, expected {expected}'


def bill_of_materials(lock: Path, version: str) -> dict[str, Any]:
    """Return the packages of a lock as a CycloneDX document, the same for the same lock.

    Args:
        lock: Its packages, all of which `licences.toml` lists.
        version: Of AURORA.
    """
    licences: dict[str, str] = known()['licences']
    return {
        'bomFormat': 'CycloneDX',
        'specVersion': '1.6',
        'serialNumber': uuid.uuid5(_NAMESPACE, version + lock.read_text('utf-8')).urn,
        'version': 1,
        'metadata': {
            'component': {
                'type': 'application',
                'bom-ref': 'aurora',
                'name': 'aurora',
                'version': version,
                'licenses': [{'expression': 'Apache-2.0'}],
            },
            'properties': [{'name': 'aurora:lock', 'value': lock.name}],
        },
        'components': [
            {
                'type': 'library',
                'bom-ref': f'pkg:pypi/{package.name}@{package.version}',
                'name': package.name,
                'version': package.version,
                'purl': f'pkg:pypi/{package.name}@{package.version}',
                'licenses': [{'expression': licences[package.name]}],
                # One for each file that the lock admits: sources, and wheels per platform.
                'externalReferences': [
                    {
                        'type': 'distribution',
                        'url': f'https://pypi.org/project/{package.name}/{package.version}/',
                        'hashes': [{'alg': 'SHA-256', 'content': sha} for sha in package.hashes],
                    }
                ],
            }
            for package in read_lock(lock)
        ],
    }


def main(arguments: list[str]) -> int:
    """Check, or write the bill of materials; return the exit code."""
    if arguments[:1] == ['sbom'] and len(arguments) == 2:
        tag = f'py{sys.version_info[0]}.{sys.version_info[1]}'
        version = re.search(
            r"version='([^']+)'", (ROOT / 'ros_ws/src/aurora_cli/setup.py').read_text('utf-8')
        )
        assert version is not None
        document = bill_of_materials(REQUIREMENTS / f'run-{tag}.txt', version[1])
        Path(arguments[1]).write_text(json.dumps(document, indent=2) + '\n', encoding='utf-8')
        print(f'sbom: {len(document["components"])} packages in {arguments[1]}')  # noqa: T201
        return 0
    if arguments != ['check']:
        print('usage: supply_chain.py check | sbom FILE', file=sys.stderr)  # noqa: T201
        return 64
    locks = sorted(REQUIREMENTS.glob('*.txt'))
    problems = [
        *(problem for lock in locks for problem in lock_problems(lock)),
        *licences_that_differ(),
        *start_up_problems(Path(sysconfig.get_paths()['purelib'])),
    ]
    for problem in problems:
        print(f'supply chain: {problem}', file=sys.stderr)  # noqa: T201
    return int(bool(problems))


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
