# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ports, the ROS domain, discovery, and what listens where."""

from __future__ import annotations

import json
import os
import socket
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from aurora_cli.doctor.machine import Finding, Machine
from aurora_cli.doctor.processes import NODES, command_line, node_files, process_ids
from aurora_cli.doctor.sockets import listening, socket_inodes, sockets_of

LAST_DOMAIN = 231
# The ports of higher domains, MAVLink's to begin with, are those of outgoing connections.
LAST_SAFE_DOMAIN = 100
_PROFILE = 'FASTRTPS_DEFAULT_PROFILES_FILE'
_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
_LOOPBACK = '127.0.0.1'
_NODE_LIMIT_S = 20.0
_LOOPBACK_LIMIT_S = 1.0
_OWN_PREFIXES = ('cli_', '_ros2cli', 'aurora_doctor_')
_LIST_NODES = """
import json, os, sys, time
import rclpy
rclpy.init()
node = rclpy.create_node(f'aurora_doctor_{os.getpid()}', enable_rosout=False)
end = time.monotonic() + 1.5
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=0.1)
json.dump(node.get_node_names_and_namespaces(), sys.stdout)
rclpy.shutdown()
"""


def domain(machine: Machine) -> list[Finding]:
    """ROS_DOMAIN_ID is a domain, and a safe one."""
    number = machine.domain
    if number is None or number > LAST_DOMAIN:
        return [
            Finding(
                expected=f'ROS_DOMAIN_ID from 0 to {LAST_SAFE_DOMAIN}',
                found=machine.domain_text,
                fix='export ROS_DOMAIN_ID=87',
            )
        ]
    first, last = _ephemeral(machine.proc)
    low, high = 7400 + 250 * number, 7400 + 250 * number + 249
    if low <= last and first <= high:
        return [
            Finding(
                expected='ports of the domain apart from those of outgoing connections '
                f'({first} to {last})',
                found=f'domain {number} with the ports {low} to {high}: now and then one is taken',
                fix=f'export ROS_DOMAIN_ID=87 (any up to {LAST_SAFE_DOMAIN})',
            )
        ]
    return []


def ports(machine: Machine) -> list[Finding]:
    """The MAVLink port of this domain is free, or our own simulator has it."""
    from aurora_uav_sim.protocol import mavlink_port

    number = machine.domain
    if number is None or number > LAST_DOMAIN:
        return []
    port = mavlink_port(number)
    inodes = {
        s.inode for s in listening(machine.proc) if s.port == port and s.kind.startswith('udp')
    }
    if not inodes:
        return []
    ours = {node.pid for node in node_files(machine.run_dir, machine.proc) if node.state}
    holder = _holder(inodes, machine.proc)
    if holder is not None and (holder in ours or _parent(holder, machine.proc) in ours):
        return []
    if holder is None:
        who = 'a process of another user'
    else:
        who = f'process {holder} ({command_line(holder, machine.proc)[:80]})'
    return [
        Finding(
            expected=f'UDP port {port} (MAVLink, domain {number}) free for uav_sim',
            found=f'{who} has it, and `up` has not started it in this domain',
            fix=f'kill {holder}' if holder is not None else 'export ROS_DOMAIN_ID=88',
        )
    ]


def middleware(machine: Machine) -> list[Finding]:
    """The middleware is the one that is tested, and keeps to 127.0.0.1."""
    environment = machine.environment
    findings = []
    implementation = environment.get('RMW_IMPLEMENTATION', '')
    if implementation not in ('', 'rmw_fastrtps_cpp'):
        findings.append(
            Finding(
                expected='RMW_IMPLEMENTATION=rmw_fastrtps_cpp',
                found=implementation,
                fix='export RMW_IMPLEMENTATION=rmw_fastrtps_cpp',
            )
        )
    named = environment.get(_PROFILE, '')
    problem = _profile_problem(Path(named)) if named else 'none'
    if problem:
        findings.append(
            Finding(
                expected=f'{_PROFILE} names a profile that binds to {_LOOPBACK} alone',
                found=f'{named}: {problem}' if named else problem,
                fix=f'unset {_PROFILE} {_RANGE} && {machine.setup_hint}',
            )
        )
    reach = environment.get(_RANGE, '')
    # With a profile of ours SYSTEM_DEFAULT leaves everything to it.
    allowed = ('LOCALHOST', 'OFF') if problem else ('LOCALHOST', 'OFF', 'SYSTEM_DEFAULT')
    if reach not in allowed:
        findings.append(
            Finding(
                expected=f'{_RANGE} one of {", ".join(allowed)}',
                found=reach or 'nothing (ROS then searches the whole subnet)',
                fix=f'unset {_PROFILE} {_RANGE} && {machine.setup_hint}',
            )
        )
    return findings


def loopback(_machine: Machine) -> list[Finding]:
    """This machine can talk to itself, which discovery needs."""
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
            receiver.bind((_LOOPBACK, 0))
            receiver.settimeout(_LOOPBACK_LIMIT_S)
            receiver.sendto(b'doctor', receiver.getsockname())
            receiver.recv(16)
    except OSError as err:
        return [
            Finding(
                expected=f'UDP from {_LOOPBACK} to {_LOOPBACK} arrives',
                found=str(err),
                fix='ip link set lo up',
            )
        ]
    return []


def open_sockets(machine: Machine) -> list[Finding]:
    """No process of the graph listens on another address than loopback."""
    table = listening(machine.proc)
    findings = []
    for node in node_files(machine.run_dir, machine.proc):
        if not node.state or node.pid is None:
            continue
        for one in sockets_of(node.pid, machine.proc, table):
            if not one.is_loopback:
                findings.append(
                    Finding(
                        expected=f'{node.name} listens on {_LOOPBACK} alone',
                        found=f'{one.kind} {one.address}:{one.port}',
                        fix=f'ros2 run aurora_bringup down; unset {_PROFILE} {_RANGE}; '
                        f'{machine.setup_hint}; ros2 run aurora_bringup up',
                    )
                )
    return findings


def foreign_nodes(machine: Machine) -> list[Finding]:
    """Nobody else talks in this domain, and no node of ours is there twice."""
    done = machine.probe(_LIST_NODES, _NODE_LIMIT_S)
    if done.code != 0:
        return [
            Finding(
                expected='the nodes of the domain can be listed',
                found=done.last_words,
                fix=f'make setup, then: {machine.setup_hint}',
            )
        ]
    lines = done.out.strip().splitlines()
    names = [
        f'{namespace.rstrip("/")}/{name}' for name, namespace in json.loads(lines[-1])
        if not name.startswith(_OWN_PREFIXES)
    ]  # fmt: skip
    known = {f'/aurora/{name}' for name in NODES}
    other = sorted({name for name in names if name not in known})
    twice = sorted({name for name in names if name in known and names.count(name) > 1})
    another = 'export ROS_DOMAIN_ID=88 (in every shell of this graph)'
    findings = []
    if other:
        findings.append(
            Finding(
                expected=f'no other program in ROS domain {machine.domain_text}',
                found=f'{", ".join(other)} (fine if you started it to look on)',
                fix=another,
            )
        )
    if twice:
        findings.append(
            Finding(
                expected='one graph per ROS domain',
                found=f'more than one node named {", ".join(twice)}',
                fix=f'ros2 run aurora_bringup down in the other shell, or: {another}',
            )
        )
    return findings


def _ephemeral(proc: Path) -> tuple[int, int]:
    try:
        text = (proc / 'sys/net/ipv4/ip_local_port_range').read_text(encoding='ascii')
    except OSError:
        return 32768, 60999
    first, last = text.split()
    return int(first), int(last)


def _holder(inodes: set[int], proc: Path) -> int | None:
    """The process that has one of these sockets, None when it is not ours to see."""
    for pid in process_ids(proc):
        try:
            if socket_inodes(pid, proc) & inodes:
                return pid
        except PermissionError:
            continue
    return None


def _parent(pid: int, proc: Path) -> int | None:
    try:
        stat = (proc / str(pid) / 'stat').read_text(encoding='utf-8', errors='replace')
    except OSError:
        return None
    fields = stat.rpartition(')')[2].split()
    return int(fields[1]) if len(fields) > 1 else None


def _profile_problem(path: Path) -> str:
    """What is wrong with a Fast DDS profile, '' when it binds every participant to loopback."""
    if not os.access(path, os.R_OK):
        return 'it cannot be read'
    try:
        root = ElementTree.parse(path).getroot()  # nosec B314
    except ElementTree.ParseError as err:
        return f'it is not XML: {err}'
    names = {element.tag.rpartition('}')[2] for element in root.iter()}
    by_name = {
        name: [e for e in root.iter() if e.tag.rpartition('}')[2] == name] for name in names
    }
    default = [e for e in by_name.get('participant', []) if e.get('is_default_profile') == 'true']
    builtin = [(e.text or '').strip() for e in by_name.get('useBuiltinTransports', [])]
    allowed = {
        (e.text or '').strip() for white in by_name.get('interfaceWhiteList', []) for e in white
    }
    if not default:
        return 'it has no default participant'
    if builtin != ['false']:
        return 'it keeps the built-in transports, which listen on every address'
    if allowed != {_LOOPBACK}:
        return f'its interface white list is {", ".join(sorted(allowed)) or "empty"}'
    return ''
