# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Find the binding that satisfies most requirements.

Few names are tried in every way. With many, what one name is worth depends on the others (a van
follows another), so no single assignment problem has the answer: names are bound one after the
other, then moved and swapped as long as that helps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from aurora_bench.fidelity.binding import Slot

Picked = dict[str, str | None]
Worth = Callable[[Picked], int]

# Scoring one binding takes about a millisecond.
_MOST = 600
_PASSES = 4


def best_pick(slots: Sequence[Slot], worth: Worth) -> Picked:
    """Return the body of every name; among equals the first, so that it is always the same."""
    ways = 1
    for slot in slots:
        ways *= len(slot.choices)
    if ways <= _MOST:
        return max(_all(slots), key=worth)
    return _climbed(slots, worth)


def _all(slots: Sequence[Slot], taken: frozenset[str] = frozenset()) -> Iterator[Picked]:
    if not slots:
        yield {}
        return
    for choice in slots[0].choices:
        if choice is None or choice not in taken:
            used = taken if choice is None else taken | {choice}
            for rest in _all(slots[1:], used):
                yield {slots[0].name: choice, **rest}


def _climbed(slots: Sequence[Slot], worth: Worth) -> Picked:
    picked: Picked = {slot.name: None for slot in slots}
    best = worth(picked)
    for _ in range(_PASSES):
        before = best
        for slot in slots:
            for choice in slot.choices:
                other = _moved(slots, picked, slot, choice)
                if other is not None and (found := worth(other)) > best:
                    picked, best = other, found
        if best == before:
            break
    return picked


def _moved(slots: Sequence[Slot], picked: Picked, slot: Slot, choice: str | None) -> Picked | None:
    """Return the binding with one name moved; who had that body takes the old one, if it may."""
    old = picked[slot.name]
    if choice == old:
        return None
    moved = {**picked, slot.name: choice}
    for other in slots:
        if choice is not None and other.name != slot.name and picked[other.name] == choice:
            moved[other.name] = old if old in other.choices else None
    return moved
