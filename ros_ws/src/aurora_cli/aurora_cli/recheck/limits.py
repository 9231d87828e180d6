# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Check a certificate of infeasibility again; shares no code with the checker that issued it.

What is believed: the limits and maps of the configuration, the closed vocabulary, and, where the
specification lies beside the certificate, the words of the prompt.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import Any

from aurora_core.feasibility.verdict import Certificate
from aurora_core.knowledge.config_files import config_path
from aurora_core.spec.vocabulary import AgentType

# Limit name of a certificate -> (key in limits.json of its lower end, of its upper end).
_LIMITS: dict[str, tuple[str | None, str | None]] = {
    'uav_altitude_m': ('uav_altitude_min_m', 'uav_altitude_max_m'),
    'uav_standoff_max_m': (None, 'uav_standoff_max_m'),
    'uav_speed_max_mps': (None, 'uav_speed_max_mps'),
    'uav_endurance_s': (None, 'uav_endurance_s'),
    'vehicle_speed_max_mps': (None, 'vehicle_speed_max_mps'),
    'pedestrian_speed_max_mps': (None, 'pedestrian_speed_max_mps'),
    'duration_s': ('duration_min_s', 'duration_max_s'),
    'uavs_max': (None, 'uavs_max'),
    'agents_max': (None, 'agents_max'),
}
# A message that is lost with certainty: the limit follows from what a probability is.
_LOSS = 'link_loss'


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Outcome for one certificate.

    Attributes:
        valid: The proof holds.
        steps: What was checked, each with its outcome.
    """

    valid: bool
    steps: tuple[str, ...]


def recheck(proof: Certificate, spec: dict[str, Any] | None) -> Finding:
    """Check a certificate.

    Args:
        proof: The certificate.
        spec: The specification as JSON, None when it is not at hand.

    Raises:
        ConfigError: The configuration lacks limits or maps.
    """
    if proof.kind == 'limit_exceeded':
        checks = [*_limit(proof), *_stated(proof, spec)]
    elif proof.kind in ('missing_element', 'unsupported'):
        checks = [*_missing(proof), *_quoted(proof, spec)]
    else:
        checks = [(False, f'certificates of kind {proof.kind} are not known to this version')]
    return Finding(
        valid=all(holds for holds, _ in checks),
        steps=tuple(f'{"holds" if holds else "FAILS"}: {text}' for holds, text in checks),
    )


def _limit(proof: Certificate) -> list[tuple[bool, str]]:
    if proof.requested is None or proof.limit is None:
        return [(False, 'a proof by a limit needs the requested value and the limit')]
    asked, limit = proof.requested, proof.limit
    if proof.limit_name == _LOSS:
        return [
            (limit in (0.0, 1.0), f'{limit:g} is an end of the range of probabilities'),
            (
                asked >= 1.0 or asked < 0.0,
                f'with loss {asked:g} no message is ever delivered, or it is no probability',
            ),
        ]
    ends = _LIMITS.get(proof.limit_name)
    if ends is None:
        return [(False, f'there is no limit {proof.limit_name!r}')]
    table = json.loads(config_path('limits.json').read_text(encoding='utf-8'))
    low, high = (None if key is None else float(table[key]) for key in ends)
    # A one-sided limit has zero as its other end: no speed, distance or duration is negative.
    low = 0.0 if low is None else low
    shown = f'{low:g} to {high:g}' if high is not None else f'at least {low:g}'
    return [
        (limit in (low, high), f'{limit:g} is an end of {proof.limit_name}, {shown}'),
        (
            asked < low or (high is not None and asked > high),
            f'{asked:g} {proof.unit} lies outside {shown}',
        ),
    ]


def _stated(proof: Certificate, spec: dict[str, Any] | None) -> list[tuple[bool, str]]:
    """The request really says the number."""
    if spec is None:
        return []
    if proof.path in ('agents', 'uavs'):
        count = len(spec.get(proof.path, ()))
        return [(count == proof.requested, f'the specification has {count} {proof.path}')]
    parameter = _at(spec, proof.path)
    if parameter is None:
        return [(False, f'the specification has no parameter {proof.path}')]
    value = parameter.get('value')
    checks = [
        (value == proof.requested, f'the specification has {proof.path} = {value}'),
        (
            parameter.get('provenance') == 'explicit',
            f'{proof.path} is {parameter.get("provenance")}: only a stated number may be refused',
        ),
    ]
    bound = parameter.get('bound', 'exactly')
    if proof.requested is not None and proof.limit is not None:
        above = proof.requested > proof.limit or proof.limit_name == _LOSS
        escape = 'at_most' if above else 'at_least'
        checks.append((bound != escape, f'the number binds {bound}, so it cannot be moved inside'))
    return [*checks, *_quoted(proof, spec)]


def _quoted(proof: Certificate, spec: dict[str, Any] | None) -> list[tuple[bool, str]]:
    if spec is None or proof.span is None:
        return []
    words = str(spec.get('prompt', ''))[proof.span.start : proof.span.end]
    if proof.word:
        same = proof.word.casefold() in words.casefold() or words.casefold() in proof.word
        return [(bool(words) and same, f'the prompt says {words!r} there')]
    return [(bool(words.strip()), f'the prompt says {words!r} there')]


def _missing(proof: Certificate) -> list[tuple[bool, str]]:
    word = proof.word.casefold().strip()
    if not word:
        return [(False, 'the proof names nothing that is missing')]
    known = {entry.casefold() for entry in proof.listing}
    checks = [(word not in known, f'{proof.word!r} is not in the closed list')]
    listing, name = _closed_list(proof)
    if listing is not None:
        missing = sorted(set(listing) - known)
        checks.append(
            (
                not missing,
                f'the closed list has everything that {name} has'
                + (f', but not {", ".join(missing)}' if missing else ''),
            )
        )
        checks.append((word not in listing, f'{proof.word!r} is not in {name}'))
    return checks


def _closed_list(proof: Certificate) -> tuple[frozenset[str] | None, str]:
    """Return the list as the configuration has it now, read anew."""
    if proof.path == 'agent types':
        return frozenset(kind.value for kind in AgentType), 'the vocabulary'
    of_map = re.search(r'landmarks of (\S+)', proof.path)
    if of_map is not None:
        path = config_path('maps', of_map[1], 'landmarks.geojson')
        features = json.loads(path.read_text(encoding='utf-8'))['features']
        names = frozenset(str(f['properties']['name']).casefold() for f in features)
        return names, f'the map {of_map[1]}'
    return None, ''


def _at(spec: dict[str, Any], path: str) -> dict[str, Any] | None:
    """Return the parameter at a path such as `missions/m1/altitude_m`."""
    node: Any = spec
    for part in path.split('/'):
        if isinstance(node, list):
            by_id = next((e for e in node if isinstance(e, dict) and e.get('id') == part), None)
            if by_id is None and part.isdigit() and int(part) < len(node):
                by_id = node[int(part)]
            node = by_id
        elif isinstance(node, dict):
            node = node.get(part)
        else:
            return None
    return node if isinstance(node, dict) and 'value' in node else None
