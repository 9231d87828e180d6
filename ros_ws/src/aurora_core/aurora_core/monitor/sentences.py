# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One sentence per result: what happened, when, and with what margin."""

from __future__ import annotations

from aurora_core.judging.evaluation import Context, Measured
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason

_OPS = {
    '>=': 'at least',
    '>': 'more than',
    '<=': 'at most',
    '<': 'less than',
    '==': 'within tolerance of',
}
_REASONS = {
    Reason.PREMISE_NEVER: 'its premise never happened',
    Reason.EMPTY_PHASE: 'the phase it is about has no sample',
    Reason.TARGET_GONE: 'the body it is about is gone',
    Reason.SAMPLES_MISSING: 'samples are missing',
    Reason.TRACE_SHORT: 'the record is too short',
}


def quantity_text(value: float, unit: str) -> str:
    """Return a number with its unit, shares in percent."""
    if unit == '1':
        return f'{value:.3g}'
    return f'{value:.2f} {unit}'


def explain(
    context: Context,
    condition: Condition,
    measured: Measured,
    tick: int,
    value: float,
    margin: float,
) -> str:
    """Return the sentence of a result that has a margin."""
    story = measured.story
    if not story:
        asked = f'{_OPS[condition.op]} {quantity_text(condition.threshold, condition.unit)}'
        label = measured.label(tick) if measured.label is not None else ''
        about = f' ({label})' if label else ''
        story = (
            f'{condition.signal} was {quantity_text(value, condition.unit)}{about} at '
            f'{context.time_s(tick):.2f} s, asked is {asked}'
        )
    text = f'{story}; margin {quantity_text(margin, condition.unit)}.'
    return text[0].upper() + text[1:]


def explain_missing(condition: Condition, reason: Reason, story: str) -> str:
    """Return the sentence of a result that has no margin."""
    text = f'no margin, {_REASONS[reason]}: {story}.'
    return text[0].upper() + text[1:]
