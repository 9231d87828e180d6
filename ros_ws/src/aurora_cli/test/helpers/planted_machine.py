# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A machine with planted problems, for the doctor."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from aurora_cli.doctor.machine import Finding, Machine, Probe, checkout_of
from aurora_cli.doctor.processes import NODES
from aurora_core.report.process import ProcessIdentity
from aurora_core.report.run_folder import MANIFEST, RunFolder

CHECKOUT = checkout_of(Path(__file__))
NOW_S = 2_000_000_000.0
RUN_ID = '20260131T120000Z-0a1b2c'


class Planted:
    """A made-up machine without a problem; each test plants one."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.proc = folder / 'proc'
        self.shm = folder / 'shm'
        self.runs = folder / 'runs'
        self.run_dir = folder / 'nodes' / 'domain-70'
        for path in (self.proc / 'net', self.shm, self.runs, self.run_dir):
            path.mkdir(parents=True)
        for kind in ('tcp', 'tcp6', 'udp', 'udp6'):
            (self.proc / 'net' / kind).write_text('  sl local_address ...\n')
        self.environment = {
            'ROS_DOMAIN_ID': '70',
            'AURORA_RUN_DIR': str(folder / 'nodes'),
            'ROS_DISTRO': 'jazzy',
            'AMENT_PREFIX_PATH': str(folder),
            'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp',
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SYSTEM_DEFAULT',
            'FASTRTPS_DEFAULT_PROFILES_FILE': str(
                self.profile('<address>127.0.0.1</address>', 'false')
            ),
        }

    def machine(self, **changes: Any) -> Machine:
        fields: dict[str, Any] = {
            'environment': self.environment, 'runs': self.runs, 'checkout': None,
            'proc': self.proc, 'shm': self.shm, 'temp': self.folder, 'python': (3, 11),
            'installed': lambda _name: None, 'wall_s': lambda: NOW_S,
            'probe': lambda _script, _limit_s: Probe(code=0, out='[]\n'),
        }  # fmt: skip
        return Machine(**{**fields, **changes})

    def profile(self, white_list: str, builtin: str, default: str = 'true') -> Path:
        path = self.folder / 'profile.xml'
        path.write_text(
            '<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>'
            f'<interfaceWhiteList>{white_list}</interfaceWhiteList>'
            f'<participant is_default_profile="{default}"><useBuiltinTransports>{builtin}'
            '</useBuiltinTransports></participant></profiles></dds>'
        )
        return path

    def process(self, pid: int, state: str = 'S', sockets: tuple[int, ...] = ()) -> None:
        folder = self.proc / str(pid)
        (folder / 'fd').mkdir(parents=True)
        rest = ' '.join([state, '1', *['0'] * 17, str(1000 + pid), '0'])
        (folder / 'stat').write_text(f'{pid} (a (strange) name) {rest}\n')
        (folder / 'cmdline').write_bytes(b'python\0thing\0')
        (folder / 'maps').write_text('')
        for i, inode in enumerate(sockets):
            (folder / 'fd' / str(i)).symlink_to(f'socket:[{inode}]')

    def node(self, name: str, pid: int, *, ready: bool = True, started: int | None = None) -> None:
        began = 1000 + pid if started is None else started
        (self.run_dir / f'{name}.pid').write_text(f'{pid} {began}\n')
        if ready:
            (self.run_dir / f'{name}.ready').write_text(f'{pid}\n')

    def graph(self) -> None:
        for i, name in enumerate(NODES):
            self.process(100 + i)
            self.node(name, 100 + i)

    def listens(self, kind: str, address: str, port: int, inode: int) -> None:
        state = '0A' if kind.startswith('tcp') else '07'
        with (self.proc / 'net' / kind).open('a') as table:
            table.write(f'0: {address}:{port:04X} 0:0 {state} 0:0 0:0 0 0 0 {inode} 2\n')

    def run(self, run_id: str, process: ProcessIdentity) -> Path:
        folder = RunFolder(self.runs, run_id)
        folder.create()
        folder.write_json(MANIFEST, {'process': process.model_dump()})
        return folder.path


def only(findings: list[Finding]) -> Finding:
    """The one finding, which says all three things."""
    (finding,) = findings
    assert finding.expected
    assert finding.found
    assert finding.fix
    return finding
