# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All checks in order, their answer, and `--fix`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from aurora_cli.doctor import data, graph, isolation, leftovers, network, resources, versions
from aurora_cli.doctor.machine import Finding, Machine
from aurora_core.errors import AuroraError

Check = Callable[[Machine], list[Finding]]

CHECKS: tuple[tuple[str, Check], ...] = (
    ('python', versions.python_version),
    ('environment', versions.environment),
    ('variables', versions.variables),
    ('packages', versions.packages),
    ('imports', versions.imports),
    ('build', versions.build),
    ('domain', network.domain),
    ('middleware', network.middleware),
    ('loopback', network.loopback),
    ('ports', network.ports),
    ('sockets', network.open_sockets),
    ('other nodes', network.foreign_nodes),
    ('graph', graph.nodes),
    ('isolation', isolation.key_file),
    ('disk', resources.disk),
    ('memory', resources.memory),
    ('clocks', resources.clocks),
    ('shared memory', leftovers.shared_memory),
    ('runs', leftovers.unfinished_runs),
    ('maps', data.maps),
    ('records', data.records),
    ('model', data.model),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Checked:
    """The outcome of one check.

    Attributes:
        name: Of the check.
        findings: What is wrong; none when all is well.
        fixed: Which of them `--fix` has dealt with.
    """

    name: str
    findings: tuple[Finding, ...]
    fixed: frozenset[int] = frozenset()

    @property
    def open(self) -> int:
        """Number of findings that are left."""
        return len(self.findings) - len(self.fixed)


def check(name: str, function: Check, machine: Machine) -> Checked:
    """Run one check; that it cannot be run is a finding too."""
    try:
        found = function(machine)
    except ImportError as err:
        found = [
            Finding(
                expected=f'the check {name} can be made',
                found=str(err),
                fix=f'make setup, then: {machine.setup_hint}',
            )
        ]
    except (AuroraError, OSError, ValueError) as err:
        hint = getattr(err, 'hint', '')
        message = getattr(err, 'message', '') or str(err)
        found = [
            Finding(
                expected=f'the check {name} can be made', found=message, fix=hint or 'make setup'
            )
        ]
    return Checked(name=name, findings=tuple(found))


def fix(checked: Checked, machine: Machine) -> Checked:
    """Remove what is provably ours and dead, and close the runs that nobody will finish."""
    fixed = {i for i, finding in enumerate(checked.findings) if leftovers.remove(finding)}
    if checked.name == 'runs' and checked.findings:
        from aurora_core.report.unfinished import close_unfinished

        closed = close_unfinished(machine.runs.absolute(), machine.lives)
        fixed |= {
            i
            for i, finding in enumerate(checked.findings)
            if any(run_id in finding.expected for run_id in closed)
        }
    return Checked(name=checked.name, findings=checked.findings, fixed=frozenset(fixed))


def as_json(machine: Machine, results: list[Checked]) -> dict[str, Any]:
    """Return the answer as one document."""
    return {
        'status': 'findings' if any(result.open for result in results) else 'clean',
        'domain': machine.domain_text,
        'running': graph.running(machine),
        'checks': [
            {
                'name': result.name,
                'findings': [
                    {
                        'expected': finding.expected,
                        'found': finding.found,
                        'fix': finding.fix,
                        'fixed': i in result.fixed,
                    }
                    for i, finding in enumerate(result.findings)
                ],
            }
            for result in results
        ],
    }


def as_lines(machine: Machine, result: Checked) -> list[str]:
    """Return the lines of one check for people."""
    if not result.findings:
        return [f'ok        {result.name}{_note(machine, result.name)}']
    lines = []
    for i, finding in enumerate(result.findings):
        word = 'FIXED' if i in result.fixed else 'FINDING'
        lines += [f'{word:<9} {result.name}', f'  expected  {finding.expected}']
        lines += [f'  found     {finding.found}', f'  fix       {finding.fix}']
    return lines


def _note(machine: Machine, name: str) -> str:
    if name == 'model' and machine.model == data.OFFLINE:
        return ': offline, which needs no key and no network'
    if name == 'graph':
        names = graph.running(machine)
        return f': {len(names)} nodes run' if names else ': no node runs'
    if name == 'isolation':
        return f': {isolation.who_reaches(machine)}'
    if name == 'domain':
        return f': {machine.domain_text}'
    return ''
