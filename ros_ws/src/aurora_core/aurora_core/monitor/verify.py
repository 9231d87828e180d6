# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Judge a recorded run: one signed margin per condition, from the trace and the world alone."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import Context, Measured, Missing
from aurora_core.judging.quantity import measure
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.chance_check import chance_findings
from aurora_core.monitor.cross_check import cross_check
from aurora_core.monitor.plan_check import Held, NotComparable, Plan, held_against
from aurora_core.monitor.sentences import explain, explain_missing
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import ConditionResult, Finding, Reason, Verdict, VerdictStatus
from aurora_core.ports.progress import Progress, after, quietly
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.stl.critical import critical_sample
from aurora_core.stl.formula import Eventually, Formula
from aurora_core.stl.robustness import SampledSignals, robustness
from aurora_core.stl.syntax import parse_formula
from aurora_core.trace.trace import Integrity, Trace

# A note names so many injected faults.
_FAULTS_TOLD = 5


def context_of(
    trace: Trace, world: WorldModel, conditions: Sequence[Condition], spec: ScenarioSpec
) -> Context:
    """Return what the conditions of a run are judged in: its ticks before the first missing one.

    Raises:
        VerificationError: The trace has no tick.
    """
    if trace.ticks == 0:
        raise VerificationError('the trace has no tick', hint='the run ended before t = 0')
    view = RunView(trace, world)
    if view.first_missing_tick is not None:
        view = view.up_to(view.first_missing_tick)
    return Context(view, spec, tuple(conditions))


def verify(
    trace: Trace,
    world: WorldModel,
    conditions: Sequence[Condition],
    spec: ScenarioSpec,
    plan: Plan | NotComparable | None = None,
    recomputed: Sequence[Finding] = (),
    *,
    as_recorded: bool = False,
    progress: Progress = quietly,
    context: Context | None = None,
) -> Verdict:
    """Recompute every margin.

    Ticks without a complete set of states end what can be judged: only what is decided before
    the first of them has a margin.

    Args:
        trace: The run.
        world: The world it happened in.
        conditions: What has to hold.
        spec: The request (links and events).
        plan: What the request gives when worked out anew; None compares nothing with it.
        recomputed: Where the record is not what the executor gives from its states.
        as_recorded: See `held_against`.
        progress: Called after each condition.
        context: Of this run (`context_of`), where more than the verdict is wanted of it.

    Raises:
        VerificationError: The conditions do not fit the trace: a body or an event is missing in
            the roster or the specification, or the trace has no tick.
    """
    context = context or context_of(trace, world, conditions, spec)
    judged = context.view.ticks
    missing = judged if judged < trace.ticks else None
    notes: list[str] = []
    if missing is not None:
        notes.append(f'states or commands are missing from tick {missing} on')
    if trace.integrity is not Integrity.INTACT:
        notes.append(
            f'the recording is {trace.integrity.value}: {trace.integrity_note}'.rstrip(': ')
        )
    held = Held()
    notes += _told_faults(trace)
    if plan is not None:
        held = held_against(conditions, trace.roster, world, plan, as_recorded=as_recorded)
    notes += held.notes
    findings = held.findings
    if missing == 0:
        lost = Missing(reason=Reason.SAMPLES_MISSING, story='the first tick is missing')
        results = tuple(_without_margin(condition, lost, context) for condition in conditions)
    else:
        results = tuple(
            after(progress, judge(context, condition, cut=missing)) for condition in conditions
        )
        findings += cross_check(context)
        if isinstance(plan, Plan):
            findings += tuple(chance_findings(context, plan.seed))
    findings += tuple(recomputed)
    return Verdict(
        status=verdict_status(trace.integrity, results, len(findings)),
        results=results,
        cross_check=findings,
        integrity=trace.integrity,
        notes=tuple(notes),
    )


def _told_faults(trace: Trace) -> list[str]:
    faults = [f'{e.fault_kind} ({e.subject})' for e in trace.events if e.fault_kind]
    return [f'faults were injected: {", ".join(faults[:_FAULTS_TOLD])}'] if faults else []


def judge(context: Context, condition: Condition, *, cut: int | None = None) -> ConditionResult:
    """Return the result of one condition.

    Args:
        context: The run.
        condition: What has to hold.
        cut: First missing tick, where the run was cut because of it.
    """
    measured = context.kept[condition.id] = measure(context, condition)
    if isinstance(measured, Measured):
        formula = judged_formula(context, condition, measured)
        signals = sampled(context, condition, measured)
        margin = robustness(formula, signals).at(0)
        if margin is not None:
            return _with_margin(context, condition, measured, formula, signals, margin)
        measured = _too_few(context, condition)
    if cut is not None and measured.reason is Reason.TRACE_SHORT:
        measured = Missing(
            reason=Reason.SAMPLES_MISSING,
            story=f'samples are missing from {context.time_s(cut):.2f} s on',
            tick=cut,
        )
    return _without_margin(condition, measured, context)


def sampled(context: Context, condition: Condition, measured: Measured) -> SampledSignals:
    """Return the samples of a condition as STL signals.

    A deadline may lie beyond the end of a run that was finished before it.
    """
    deadline_only = condition.by_s is not None and condition.hold_s is None
    return SampledSignals(
        values={condition.signal: measured.values},
        dt_s=context.view.dt_s,
        clip=deadline_only and context.complete(condition),
    )


def judged_formula(context: Context, condition: Condition, measured: Measured) -> Formula:
    """Return the formula of a condition as it is judged on its samples.

    A stretch may have to begin by a time so late that the run was finished before: every stretch
    of the run begins early enough then.
    """
    formula = parse_formula(condition.formula)
    if condition.by_s is None or condition.hold_s is None or not context.complete(condition):
        return formula
    dt_s = context.view.dt_s
    asked = whole_ticks(condition.by_s, dt_s) + whole_ticks(condition.hold_s, dt_s)
    if len(measured.values) > asked or not isinstance(formula, Eventually):
        return formula
    return Eventually(operand=formula.operand)


def _too_few(context: Context, condition: Condition) -> Missing:
    if not context.complete(condition):
        return context.short(condition)
    held_s = condition.hold_s if condition.hold_s is not None else 0.0
    return Missing(reason=Reason.EMPTY_PHASE, story=f'there is no stretch of {held_s} s to judge')


def _with_margin(
    context: Context,
    condition: Condition,
    measured: Measured,
    formula: Formula,
    signals: SampledSignals,
    margin: float,
) -> ConditionResult:
    sample = critical_sample(formula, signals).sample
    tick = int(measured.ticks[sample])
    if measured.worst_tick is not None:
        tick = measured.worst_tick
    tick = min(tick, context.view.ticks - 1)
    return ConditionResult(
        id=condition.id,
        sentence=condition.sentence,
        explanation=explain(
            context, condition, measured, tick, float(measured.values[sample]), margin
        ),
        formula=condition.formula,
        source_spans=condition.spans,
        spec_ids=condition.spec_ids,
        op=condition.op,
        threshold=condition.threshold,
        tolerance=condition.tolerance,
        margin=margin,
        unit=condition.unit,
        normalised=margin / condition.scale,
        satisfied=condition.satisfied(margin),
        exercised=True,
        worst_time_s=context.time_s(tick),
        worst_place_m=_place(context, condition, measured, tick),
        evidence=(*measured.evidence, _tick_range(measured)),
        provenance=condition.provenance,
        implied=condition.implied,
    )


def _tick_range(measured: Measured) -> str:
    ticks = measured.plot[0] if measured.plot is not None else measured.ticks
    first, last = int(ticks.min()), int(ticks.max())
    return f'tick {first}' if first == last else f'ticks {first} to {last}'


def _place(
    context: Context, condition: Condition, measured: Measured, tick: int
) -> tuple[float, float, float] | None:
    name = measured.place_of
    if name is None:
        name = next((body for body in condition.of if context.view.has(body)), None)
    if name is None or not context.view.has(name):
        return None
    x, y, z = context.view.reference(name)[tick].tolist()
    return float(x), float(y), float(z)


def _without_margin(condition: Condition, missing: Missing, context: Context) -> ConditionResult:
    return ConditionResult(
        id=condition.id,
        sentence=condition.sentence,
        explanation=explain_missing(condition, missing.reason, missing.story),
        formula=condition.formula,
        source_spans=condition.spans,
        spec_ids=condition.spec_ids,
        op=condition.op,
        threshold=condition.threshold,
        tolerance=condition.tolerance,
        reason=missing.reason,
        unit=condition.unit,
        satisfied=False,
        exercised=False,
        worst_time_s=None if missing.tick is None else context.time_s(missing.tick),
        provenance=condition.provenance,
        implied=condition.implied,
    )


def verdict_status(
    integrity: Integrity, results: tuple[ConditionResult, ...], findings: int
) -> VerdictStatus:
    """Return what a trace of that integrity shows, with so many findings against it."""
    undecided = any(r.reason is not None and r.reason.undecided for r in results)
    if integrity is not Integrity.INTACT or findings or undecided:
        return VerdictStatus.INCONCLUSIVE
    if all(result.satisfied for result in results):
        return VerdictStatus.VERIFIED
    return VerdictStatus.VIOLATED
