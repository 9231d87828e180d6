# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every locked package has hashes and a licence that may be; nothing unknown runs at start-up."""

from __future__ import annotations

import importlib.util
import json
import re
import sysconfig
from importlib.metadata import distributions
from pathlib import Path

import pytest

import supply_chain
from supply_chain import (
    REQUIREMENTS,
    bill_of_materials,
    known,
    licences_that_differ,
    lock_problems,
    may_use,
    read_lock,
    start_up_problems,
)

LOCKS = sorted(REQUIREMENTS.glob('*.txt'))
ROOT = Path(__file__).resolve().parents[2]
SHA = 'a' * 64


@pytest.mark.parametrize('lock', LOCKS, ids=lambda path: path.name)
def test_every_package_has_hashes_and_a_licence_that_may_be(lock: Path) -> None:
    assert read_lock(lock)
    assert list(lock_problems(lock)) == []


def test_the_list_has_no_package_that_nothing_locks() -> None:
    locked = {package.name for lock in LOCKS for package in read_lock(lock)}
    assert sorted(known()['licences'].keys() - locked) == []


def test_installed_packages_have_the_licences_that_are_listed() -> None:
    assert list(licences_that_differ()) == []


def test_both_pythons_get_the_same_packages() -> None:
    """One lock would do for both, were it not for the wheels of compiled packages."""
    for kind in ('run', 'dev'):
        older, newer = (
            {p.name: p.version for p in read_lock(REQUIREMENTS / f'{kind}-py3.{minor}.txt')}
            for minor in (11, 12)
        )
        assert older == newer


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('rich==1.0\n', 'rich has no hash'),
        (f'litellm==1.82.7 --hash=sha256:{SHA}\n', 'is banned'),
        (f'nobody-knows==1.0 \\\n    --hash=sha256:{SHA}\n', 'has no licence'),
        (f'lenses==1.0 --hash=sha256:{SHA}\n', 'GPL-3.0-or-later, which is not allowed'),
    ],
)
def test_a_lock_that_is_not_in_order_is_named(text: str, said: str, tmp_path: Path) -> None:
    lock = tmp_path / 'run-py3.11.txt'
    lock.write_text(text)
    (problem,) = lock_problems(lock)
    assert said in problem


def test_what_pins_nothing_is_refused(tmp_path: Path) -> None:
    lock = tmp_path / 'run-py3.11.txt'
    lock.write_text('-e git+https://example.com/x\n')
    with pytest.raises(ValueError, match='pins nothing'):
        read_lock(lock)


def test_a_licence_is_met_by_one_side_of_an_or_and_both_of_an_and() -> None:
    allowed = {'MIT', 'Zlib'}
    assert may_use('GPL-2.0-only OR MIT', allowed)
    assert may_use('MIT AND Zlib', allowed)
    assert not may_use('MIT AND GPL-2.0-only', allowed)


def test_nothing_unknown_runs_when_this_python_starts(tmp_path: Path) -> None:
    assert list(start_up_problems(Path(sysconfig.get_paths()['purelib']))) == []
    (tmp_path / 'path.pth').write_text('/some/folder\n')
    (tmp_path / 'added.pth').write_text('import os; os.system("true")\n')
    (tmp_path / 'distutils-precedence.pth').write_text('import os\n')
    assert list(start_up_problems(tmp_path)) == [
        'added.pth runs code at every start, and is not in licences.toml',
        'distutils-precedence.pth is of no package, expected setuptools',
    ]


def test_the_bill_of_materials_names_every_package_once(tmp_path: Path) -> None:
    lock = REQUIREMENTS / 'run-py3.11.txt'
    bill = bill_of_materials(lock, '1.0')
    assert bill == bill_of_materials(lock, '1.0')
    names = [component['name'] for component in bill['components']]
    assert names == [package.name for package in read_lock(lock)]
    references = {component['bom-ref'] for component in bill['components']}
    assert len(references) == len(names)
    for component in bill['components']:
        assert re.fullmatch(r'pkg:pypi/[a-z0-9.-]+@[^@]+', component['purl'])
        assert component['licenses'][0]['expression']
        (files,) = component['externalReferences']
        assert all(len(entry['content']) == 64 for entry in files['hashes'])
    target = tmp_path / 'sbom.json'
    assert supply_chain.main(['sbom', str(target)]) == 0
    assert json.loads(target.read_text())['bomFormat'] == 'CycloneDX'


def test_the_container_is_pinned_and_runs_as_nobody_special() -> None:
    lines = (ROOT / 'docker' / 'Dockerfile').read_text().splitlines()
    bases = [line for line in lines if line.startswith('FROM ')]
    assert bases
    assert all(re.search(r'@sha256:[0-9a-f]{64}', line) for line in bases)
    users = [line.split()[1] for line in lines if line.startswith('USER ')]
    assert users[-1] not in ('root', '0')


def test_what_is_imported_at_run_time_is_locked() -> None:
    """No source imports a package that only some other package happens to bring."""
    assert importlib.util.find_spec('cryptography') is not None
    direct = {
        line.split('#')[0].strip().split('[')[0].split('=')[0].split('!')[0].split('<')[0].lower()
        for name in ('base.in', 'run.in')
        for line in (REQUIREMENTS / name).read_text().splitlines()
    }
    locked = {package.name for package in read_lock(REQUIREMENTS / 'run-py3.11.txt')}
    wanted = {name.rstrip('>') for name in direct if name and not name.startswith('-')}
    assert sorted(wanted - locked) == []
    assert {found.name.lower() for found in distributions()} >= {'cryptography'}
