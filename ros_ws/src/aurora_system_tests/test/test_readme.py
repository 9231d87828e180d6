# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every command of the README does what the README says."""

from __future__ import annotations

import gzip
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_cli.testing.small_maps import small_city
from aurora_ros.testing.domains import own_domain

ROOT = Path(__file__).resolve().parents[4]
README = (ROOT / 'README.md').read_text(encoding='utf-8')
BLOCKS = re.findall(r'```bash\n(.*?)```', README, re.DOTALL)
LINES = [line for block in BLOCKS for line in block.splitlines() if line.strip()]

# Words beside a command, or in the text after it, that announce its exit code.
CODES = {'violated': 1, 'infeasible': 5}


def commands(prefix: str) -> list[str]:
    return [line for line in LINES if line.startswith(prefix)]


def expected_code(line: str) -> int:
    comment = line.partition('#')[2]
    after = README[README.index(line) + len(line) :].removeprefix('\n```').strip()[:60]
    for word, code in CODES.items():
        if word in comment or (not comment and f'ends `{word}`' in after):
            return code
    return 0


def shell(line: str, folder: Path, domain: int, limit_s: float = 180.0) -> tuple[int, str]:
    """Run a line as a person would: sourced environment, some folder."""
    script = f'source {shlex.quote(str(ROOT / "ros_ws" / "setup.bash"))} && {line}'
    done = subprocess.run(
        ['bash', '-c', script],
        cwd=folder,
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=limit_s,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


def test_the_readme_names_the_make_targets_that_exist() -> None:
    named = set(re.findall(r'^make (\w+)', README, re.MULTILINE))
    makefile = (ROOT / 'Makefile').read_text(encoding='utf-8')
    assert {'demo', 'test'} <= named
    assert all(re.search(rf'^{target}:', makefile, re.MULTILINE) for target in named)


@pytest.mark.ros
def test_aurora_commands_end_as_announced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('AURORA_MAPS', str(tmp_path / 'maps'))
    (tmp_path / 'old_town.osm.gz').write_bytes(gzip.compress(small_city().encode()))
    with own_domain() as domain:
        for line in commands('aurora '):
            if '<run_id>' in line:
                newest = max((tmp_path / 'runs').iterdir(), key=lambda p: p.stat().st_mtime_ns)
                code, output = shell(line.replace('<run_id>', newest.name), tmp_path, domain)
            else:
                code, output = shell(line, tmp_path, domain)
            if line.startswith('aurora map doctor'):
                assert code in (0, 1), output
                assert 'old_town: ' in output
            elif line.startswith('aurora doctor'):
                # What it finds is this machine's affair.
                assert code in (0, 1), output
                assert re.search(r'\d+ checks, ', output), output
            else:
                assert code == expected_code(line), f'{line}\n{output}'


@pytest.mark.ros
def test_the_graph_starts_serves_and_stops(tmp_path: Path) -> None:
    with own_domain() as domain:
        code, output = shell('ros2 run aurora_bringup up --detach', tmp_path, domain)
        assert code == 0, output
        try:
            (call,) = commands('ros2 service call')
            code, output = shell(call, tmp_path, domain)
            assert code == 0, output
            assert "status='verified'" in output
        finally:
            code, output = shell('ros2 run aurora_bringup down', tmp_path, domain)
        assert code == 0, output


def test_every_node_of_the_list_is_an_executable(tmp_path: Path) -> None:
    assert shutil.which('bash')
    code, output = shell('ros2 pkg executables', tmp_path, 101)
    assert code == 0, output
    listed = set(output.splitlines())
    named = [' '.join(line.split()[2:4]) for line in commands('ros2 run ')]
    assert len(named) >= 10
    assert set(named) <= listed
