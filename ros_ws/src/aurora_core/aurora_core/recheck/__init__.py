# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Check a certificate of infeasibility again; shares no code with the checker that issued it.

What is believed: the limits, tolerances and maps of the configuration, the closed vocabulary, and,
where the specification lies beside the certificate, what it says and the words of the prompt.
What cannot be checked is said to be so: it is neither valid nor refuted.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.recheck import (
    bounds,
    buildings,
    flights,
    places,
    pursuit,
    radio,
    scene,
    schedule,
    zones,
)
from aurora_core.recheck.finding import Finding, Outcome, Step, finding
from aurora_core.recheck.limits import by_limit, by_sign
from aurora_core.recheck.listings import by_listing
from aurora_core.recheck.mends import exact, mends_hold
from aurora_core.recheck.operands import kinds_fit
from aurora_core.recheck.request import Request, clauses_quoted, fact_holds, quoted, was_read

__all__ = ['Finding', 'Outcome', 'recheck']

_Derivation = Callable[[Certificate, Request], list[Step]]
_DERIVATIONS: Mapping[Rule, _Derivation] = MappingProxyType(
    {
        Rule.SIGN: lambda proof, request: by_sign(proof, request.spec),
        Rule.SENSING: flights.sensing,
        Rule.RADIO: radio.radio,
        Rule.CLOSENESS: flights.closeness,
        Rule.STACKING: flights.stacking,
        Rule.FLIGHT_BAND: flights.flight_band,
        Rule.PURSUIT: pursuit.pursuit,
        Rule.AFAR: flights.afar,
        Rule.BATTERY: schedule.battery,
        Rule.DEADLINE: schedule.times,
        Rule.HORIZON: schedule.times,
        Rule.ORDER: schedule.times,
        Rule.PLACEMENT: places.placement,
        Rule.ZONE: zones.zone,
        Rule.HIDDEN: buildings.hidden,
        Rule.ROUND: buildings.cut_round,
        Rule.ROOF: zones.roof,
        Rule.WALL: zones.wall,
        Rule.BOUNDS: bounds.bounds,
        Rule.STILL: bounds.still,
        Rule.WATCH: bounds.watch,
        Rule.LATENCY: bounds.latency,
        Rule.SCENE: scene.scene,
    }
)


def recheck(proof: Certificate, spec: dict[str, Any] | None) -> Finding:
    """Check a certificate.

    Args:
        proof: The certificate.
        spec: The specification as JSON, None when it is not at hand.

    Raises:
        ConfigError: The configuration lacks limits or maps.
    """
    steps = [*_steps(proof, spec), *was_read(proof, spec), *clauses_quoted(proof, spec)]
    if finding(steps).valid:
        steps += mends_hold(proof, spec, _holds)
    return finding(steps)


def _steps(proof: Certificate, spec: dict[str, Any] | None) -> list[Step]:
    if proof.kind in ('missing_element', 'unsupported'):
        return [*by_listing(proof), *quoted(proof, spec, proof.word)]
    if proof.kind == 'limit_exceeded' and proof.rule in (None, Rule.LIMIT, Rule.COUNT):
        return by_limit(proof, spec)
    if proof.rule is None:
        return [(None, f'a certificate of kind {proof.kind} that names no rule')]
    derivation = _DERIVATIONS.get(proof.rule)
    if derivation is None:
        return [(None, f'a certificate of kind {proof.kind} by the rule {proof.rule}')]
    if spec is None or 'missions' not in spec:
        return [(None, 'it rests on the specification, which is not at hand')]
    request = Request(spec)
    facts: list[Step] = [fact_holds(request, fact) for fact in proof.facts]
    derived = derivation(proof, request)
    return [*facts, *kinds_fit(proof, request), *derived, *quoted(proof, spec)]


def _holds(proof: Certificate, spec: dict[str, Any] | None, *, by_any: bool) -> bool:
    """Whether the argument alone holds, without the tolerances of what is flown.

    `by_any`: by these bounds on times or by any others.
    """
    derivation = _DERIVATIONS.get(proof.rule) if proof.rule is not None else None
    if spec is None or 'missions' not in spec:
        return finding(by_limit(proof, spec)).valid
    request = exact(Request(spec))
    timed = proof.unit == 's' or derivation in (schedule.times, schedule.battery)
    if timed and by_any and schedule.excluded(request):
        return True
    if derivation is None:
        return finding(by_limit(proof, spec)).valid
    if proof.chain:
        proof = schedule.derived_anew(proof, request)
    return finding(derivation(proof, request)).valid
