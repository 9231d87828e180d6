# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The table of doubts.

Each check compares the words of encoded clauses with what they became and returns the characters
that the specification does not carry. Those are admitted as not encoded, so that a run of the rest
is never called verified. A check reads tagged atoms and the specification, not how it came about.

To add one, write a function `(ScenarioSpec, atoms) -> spans` beside those of its subject and list
it in `_CHECKS`. It is worth its place when it is right about most of the prompts that it demotes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from aurora_core.parsing.atoms import Atom
from aurora_core.parsing.doubts.bodies import (
    crowded,
    denied,
    gapped,
    halved,
    idle,
    listed,
    meeting,
    numbered,
    places_without_part,
    strangers,
    twins,
    without_part,
)
from aurora_core.parsing.doubts.bounds import (
    distances_as_heights,
    heights_as_bounds_of_distance,
    sides_turned,
)
from aurora_core.parsing.doubts.deeds import deeds_at_places, stops_at_places
from aurora_core.parsing.doubts.flights import (
    flights_at_once,
    flights_over_nothing,
    flights_without_verb,
    flown_by_both,
    folded_climbs,
    formations,
    heights_as_distances,
    heights_from_somebody,
    heights_of_both,
    heights_over_fliers,
    heights_passed_twice,
    hovers_over_movers,
    passed_before_a_hover,
    seen_on_another_flight,
    shared_durations,
    standoffs_as_heights,
    stays_of_others,
    watched_while_hovering,
    while_it_stops,
)
from aurora_core.parsing.doubts.messages import (
    contents,
    landings_when_told,
    open_moments,
    other_receivers,
    places_of_deeds,
    reactions,
    told_by_a_person,
)
from aurora_core.parsing.doubts.narrated import (
    in_their_order,
    said_twice,
    told_as_bounds,
    untied_causes,
)
from aurora_core.parsing.doubts.roles import misanchored, misplaced
from aurora_core.parsing.doubts.telling_words import comparisons, untold
from aurora_core.parsing.doubts.times import (
    at_one_moment,
    bare_sequels,
    begun_already,
    bounds_meanwhile,
    distances_of_moments,
    landings,
    let_pass,
    standing_meanwhile,
    started_again,
    times_of_described,
    times_of_others,
    times_of_phases,
    times_of_sequels,
    untied_effects,
)
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import ScenarioSpec

_Check = Callable[[ScenarioSpec, Sequence[Atom]], Iterable[Span]]
_CHECKS: tuple[_Check, ...] = (
    denied,
    untold,
    comparisons,
    without_part,
    strangers,
    idle,
    listed,
    crowded,
    halved,
    meeting,
    places_without_part,
    twins,
    gapped,
    watched_while_hovering,
    flights_without_verb,
    folded_climbs,
    standoffs_as_heights,
    heights_over_fliers,
    heights_from_somebody,
    distances_as_heights,
    heights_as_bounds_of_distance,
    sides_turned,
    heights_passed_twice,
    hovers_over_movers,
    heights_of_both,
    passed_before_a_hover,
    flown_by_both,
    flights_at_once,
    flights_over_nothing,
    formations,
    heights_as_distances,
    seen_on_another_flight,
    shared_durations,
    while_it_stops,
    stays_of_others,
    other_receivers,
    told_by_a_person,
    open_moments,
    places_of_deeds,
    contents,
    reactions,
    landings_when_told,
    standing_meanwhile,
    untied_effects,
    let_pass,
    landings,
    begun_already,
    bare_sequels,
    started_again,
    distances_of_moments,
    misplaced,
    misanchored,
    numbered,
    at_one_moment,
    bounds_meanwhile,
    times_of_others,
    times_of_phases,
    times_of_described,
    times_of_sequels,
    stops_at_places,
    deeds_at_places,
    in_their_order,
    untied_causes,
    said_twice,
    told_as_bounds,
)


# These hold the grammar against a second, shallow reading, or against what it cannot read: a model
# that understood a sentence they contradict more often than they catch it.
_OF_GRAMMAR: frozenset[_Check] = frozenset(
    {bare_sequels, contents, flights_without_verb, misplaced}
)


def doubtful(spec: ScenarioSpec, atoms: Sequence[Atom], *, by_model: bool = False) -> list[Span]:
    """Return the characters of encoded clauses that the specification does not carry.

    Args:
        spec: The specification as it stands.
        atoms: All atoms of the prompt as tagged, where they stand in it.
        by_model: A language model read it, not the grammar.
    """
    checks = [c for c in _CHECKS if not (by_model and c in _OF_GRAMMAR)]
    found = {span.start: span for check in checks for span in check(spec, atoms)}
    return [found[start] for start in sorted(found)]
