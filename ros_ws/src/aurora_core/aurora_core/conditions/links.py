# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What links imply: which one carries a message, and that its ledger fits its numbers."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.judging.build import Inputs
from aurora_core.judging.quantities import (
    attempts,
    delivery_latency,
    delivery_ratio,
    link_range,
    outage,
    report_gap,
)
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import Link, MessageTrigger, ScenarioSpec
from aurora_core.spec.vocabulary import LinkOcclusion


def link_between(spec: ScenarioSpec, sender: str, receiver: str) -> Link | None:
    """Return the link from one body to another."""
    return next(
        (link for link in spec.links if (link.sender, link.receiver) == (sender, receiver)), None
    )


def loses_messages(link: Link) -> bool:
    """Tell whether the prompt forbids the retransmissions that would make up for losses."""
    forbidden = (
        link.retransmissions.provenance is Provenance.EXPLICIT
        and link.retransmissions.value == 0.0
    )
    return forbidden and link.loss.value > 0.0


def is_needed(spec: ScenarioSpec, link: Link) -> bool:
    """Tell whether an event waits for a message of the link."""
    return any(
        isinstance(event.trigger, MessageTrigger)
        and event.trigger.by == link.receiver
        and event.trigger.sender in (None, link.sender)
        for event in spec.events
    )


def link_conditions(inputs: Inputs, link: Link) -> Iterator[Condition]:
    """Yield that the ledger of a link fits the parameters that the prompt states of it."""
    if loses_messages(link):
        yield delivery_ratio.of_messages(inputs, link)
    elif link.loss.provenance is Provenance.EXPLICIT:
        yield delivery_ratio.of_attempts(inputs, link)
    if link.outage_s is not None:
        yield outage.implied(inputs, link, link.outage_s)
    if link.rate_hz is not None:
        yield report_gap.implied(inputs, link, link.rate_hz)
        if link.latency_s.provenance is Provenance.EXPLICIT:
            yield delivery_latency.implied(inputs, None, link)
    if link.range_m is not None and link.range_m.provenance is Provenance.EXPLICIT:
        yield link_range.implied(inputs, link, link.range_m)
    if link.occlusion is not LinkOcclusion.SHORTENS:
        yield link_range.occlusion(inputs, link)
    if link.retransmissions.provenance is Provenance.EXPLICIT:
        yield attempts.stated_number(inputs, link)
    if link.retransmission_interval_s.provenance is Provenance.EXPLICIT:
        yield attempts.stated_interval(inputs, link)
