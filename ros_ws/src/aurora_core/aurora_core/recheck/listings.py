# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by a closed list that lacks what the prompt names."""

from __future__ import annotations

import re

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import read_map_file, read_map_stops
from aurora_core.spec.vocabulary import AgentType


def by_listing(proof: Certificate) -> list[Step]:
    """The named thing is in no list that is closed."""
    word = proof.word.casefold().strip()
    if not word:
        return [(False, 'the proof names nothing that is missing')]
    known = {entry.casefold() for entry in proof.listing}
    checks: list[Step] = [(word not in known, f'{proof.word!r} is not in the closed list')]
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
        listing |= _other_places(proof)
        checks.append((word not in listing, f'{proof.word!r} is not in {name}'))
    return checks


def _other_places(proof: Certificate) -> frozenset[str]:
    """Return what else a map names: areas and bus stops."""
    of_map = re.search(r'landmarks of (\S+)', proof.path)
    if of_map is None:
        return frozenset()
    zones = read_map_file(of_map[1], 'zones.geojson')['features']
    named = (f['properties'] for f in zones if f['properties']['kind'] != 'no_fly')
    areas = {str(p.get('name', '')) for p in named}
    return frozenset(n.casefold() for n in areas | read_map_stops(of_map[1]))


def _closed_list(proof: Certificate) -> tuple[frozenset[str] | None, str]:
    """Return the list as the configuration has it now, read anew."""
    if proof.path == 'agent types':
        return frozenset(kind.value for kind in AgentType), 'the vocabulary'
    of_map = re.search(r'landmarks of (\S+)', proof.path)
    if of_map is not None:
        features = read_map_file(of_map[1], 'landmarks.geojson')['features']
        names = frozenset(str(f['properties']['name']).casefold() for f in features)
        return names, f'the map {of_map[1]}'
    return None, ''
