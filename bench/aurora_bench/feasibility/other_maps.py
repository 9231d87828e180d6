# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.feasibility.other_maps`: is a proof by one map taken for another one?

Every refused request of the families and the typed ones lies on the map downtown. Each of its
certificates is held against the same request on another map: one that rests on what the map holds
has to be refuted there. The request is checked there, too: it may not be refused by a proof that
it does not have at home.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from aurora_bench.feasibility.families import family_cases, typed_cases
from aurora_bench.feasibility.judge import Judged, judged
from aurora_bench.results import Table, markdown_table
from aurora_cli.installed import installed
from aurora_core.feasibility.check import check_request
from aurora_core.outcomes.feasibility import Certificate, FactSource
from aurora_core.recheck import recheck
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec

_HOME = 'downtown'
_OTHERS = ('helsinki', 'junction')


def main() -> int:
    """Print a table; return 0 when no proof by one map holds on another one, else 1."""
    known = installed()
    cases = (c for c in (*family_cases(), *typed_cases()) if c.must_be_refused)
    results = [r for c in cases if 'world' in (r := judged(known, _HOME, c)).document]
    rows: list[tuple[str | int, ...]] = []
    wrong = 0
    for name in _OTHERS:
        bound = held = free = new = 0
        for result, moved in _moved(results, name):
            for proof in result.certificates:
                if rests_on_map(proof):
                    bound += 1
                    held += recheck(proof, moved.model_dump(mode='json')).valid
                else:
                    free += 1
            there = check_request(moved, known.map(name), known.limits, known.tolerances,
                                  known.types)  # fmt: skip
            had = {(p.rule, p.path) for p in result.certificates}
            new += any((p.rule, p.path) not in had for p in there.certificates)
        wrong += held + new
        rows.append((name, len(results), bound, held, free, new))
    headings = ('map', 'requests', 'proofs by downtown', 'that hold here', 'other proofs',
                'requests refused by a new proof')  # fmt: skip
    sys.stdout.write(f'{markdown_table(Table(headings=headings, rows=rows))}\n\n')
    sys.stdout.write(f'proofs taken for another map: {wrong}\n')
    return 1 if wrong else 0


def rests_on_map(proof: Certificate) -> bool:
    """Tell whether a proof needs what a map holds: its solids, or where its landmarks are."""
    return any(
        fact.source is FactSource.MAP or str(fact.value).startswith(LANDMARK)
        for fact in proof.facts
    )


def _moved(results: list[Judged], name: str) -> Iterator[tuple[Judged, ScenarioSpec]]:
    for result in results:
        world = {**result.document['world'], 'map_name': name}
        yield result, ScenarioSpec.model_validate({**result.document, 'world': world})


if __name__ == '__main__':
    sys.exit(main())
