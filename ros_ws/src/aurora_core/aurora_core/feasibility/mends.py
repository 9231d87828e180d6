# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The nearest values that can be: of each stated number that a proof rests on.

The check itself says what can be. Another value is tried on a grid, farther and farther from the
stated one on both sides, until the proof does not hold any more, and then between the last two.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

from aurora_core.document import Document
from aurora_core.feasibility.quotes import inside, paths_of
from aurora_core.outcomes.feasibility import Certificate, Mend, Rule
from aurora_core.spec.parameter import Parameter, Unit
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.stated import is_stated

Check = Callable[[ScenarioSpec], Iterable[Certificate]]

# Steps in which values are told.
_STEPS = {Unit.ONE: 0.01, Unit.DEGREE: 1.0}
_STEP = 0.1
_WHOLE = frozenset({'waypoint_count', 'retransmissions', 'turns'})
# Between buildings a flight may be and may not be by turns; only higher is always freer.
_OF_ONE_NUMBER = frozenset({Rule.HIDDEN, Rule.ROUND})
# No value beyond this is looked for: no limit in any unit is as great.
_MOST = 5000.0


class Mends:
    """Looks for the values of one request that can be."""

    def __init__(
        self,
        spec: ScenarioSpec,
        checks: Sequence[Check],
        doubtful: Callable[[ScenarioSpec, Certificate], bool],
    ) -> None:
        """Prepare the search.

        Args:
            spec: The request that is refused.
            checks: All checks, each of which gives the proofs of its own kind.
            doubtful: Whether a proof is none, for the words that were not read.
        """
        self._spec = spec
        self._checks = checks
        self._doubtful = doubtful
        self._known = {_key(c) for c in self._all(spec)}

    def added_to(self, proof: Certificate, index: int) -> Certificate:
        """Return a certificate with the nearest values of its numbers, each alone, that can be.

        Args:
            proof: Why the request is refused.
            index: Of the check that gave it.
        """
        if proof.rule is Rule.COUNT and proof.requested is not None and proof.limit is not None:
            mend = Mend(path=proof.path, requested=proof.requested, nearest=proof.limit, unit='1')
            return proof.model_copy(update={'mends': (mend,)})
        numbers = _numbers(self._spec, proof) if _key(proof) in self._known else ()
        mends = (self._of(proof, index, path, number) for path, number in numbers)
        return proof.model_copy(update={'mends': tuple(m for m in mends if m is not None)})

    def _of(self, proof: Certificate, index: int, path: str, number: Parameter) -> Mend | None:
        """Return the value of one number; None where there is none, or another proof is left."""

        def holds(value: float) -> bool:
            changed = _changed(self._spec, path, value)
            return any(_key(c) == _key(proof) for c in self._checks[index](changed))

        def any_holds(value: float) -> bool:
            return any(path in paths_of(c) for c in self._left(path, value))

        step = _step(path, number)
        for nearest in _nearest(number.value, step, holds):
            left = self._left(path, nearest)
            if left and all(c.chain and path in paths_of(c) for c in left):
                # A phase as long as the battery lasts has a climb before it.
                values = _nearest(number.value, step, any_holds)
                nearest, left = next(((v, self._left(path, v)) for v in values), (nearest, left))
            # To be seen for none of the time is nothing to ask for.
            if not left and (nearest != 0.0 or not path.startswith('conditions/')):
                return Mend(
                    path=path,
                    requested=number.value,
                    nearest=nearest,
                    unit=number.unit.value,
                    span=number.span,
                )
        return None

    def _left(self, path: str, value: float) -> list[Certificate]:
        """Return the proofs against another value: those that rest on it, and new ones."""
        found = self._all(_changed(self._spec, path, value))
        return [c for c in found if path in paths_of(c) or _key(c) not in self._known]

    def _all(self, spec: ScenarioSpec) -> list[Certificate]:
        found = (c for check in self._checks for c in check(spec))
        return [c for c in found if not self._doubtful(spec, c)]


def _key(proof: Certificate) -> tuple[object, ...]:
    return proof.rule, proof.path


def _numbers(spec: ScenarioSpec, proof: Certificate) -> Iterator[tuple[str, Parameter]]:
    paths = (proof.path,) if proof.rule in _OF_ONE_NUMBER else paths_of(proof)
    for path in dict.fromkeys(paths):
        node: object = spec
        for part in path.split('/'):
            node = inside(node, part)
        # To report from the landing is nothing to ask for.
        if not isinstance(node, Parameter) or not is_stated(node):
            continue
        if proof.rule is not Rule.RADIO or node.unit is not Unit.SECOND:
            yield path, node


def _step(path: str, number: Parameter) -> float:
    parts = path.split('/')
    if parts[0] == 'counts' or parts[-1] in _WHOLE:
        return 1.0
    return _STEPS.get(number.unit, _STEP)


def _nearest(value: float, step: float, holds: Callable[[float], bool]) -> list[float]:
    """Return the values of the grid above and below a stated one at which a proof fails first."""
    above, below = math.floor(value / step) + 1, math.ceil(value / step) - 1
    sides = range(above, round(_MOST / step) + 1), range(below, -1, -1)
    found = (_first_free(side, step, holds) for side in sides)
    return sorted((v for v in found if v is not None), key=lambda v: abs(v - value))


def _first_free(side: range, step: float, holds: Callable[[float], bool]) -> float | None:
    """Return the first value at which a proof fails; steps double until there is one.

    Between two values at which it holds it is taken to hold.
    """

    def at(k: int) -> float:
        return round(side[k] * step, 2)

    low, far = -1, len(side) - 1
    for k in (*(2**n - 1 for n in range(far.bit_length()) if far > 0), far) if far >= 0 else ():
        if not holds(at(k)):
            break
        low = k
    else:
        return None
    while k - low > 1:
        middle = (k + low) // 2
        low, k = (middle, k) if holds(at(middle)) else (low, middle)
    return at(k)


def _changed(spec: ScenarioSpec, path: str, value: float) -> ScenarioSpec:
    """Return a request with another value of one number."""
    changed = _with(spec, path.split('/'), value)
    assert isinstance(changed, ScenarioSpec)
    return changed


def _with(node: object, path: Sequence[str], value: float) -> object:
    if isinstance(node, Parameter):
        return node.model_copy(update={'value': value})
    child = inside(node, path[0])
    changed = _with(child, path[1:], value)
    if isinstance(node, tuple):
        return tuple(changed if element is child else element for element in node)
    assert isinstance(node, Document)
    return node.model_copy(update={path[0]: changed})
