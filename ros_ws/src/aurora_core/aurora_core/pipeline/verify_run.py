# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Verify a bag and, where it lies in a run folder, that it is the one of that run."""

from __future__ import annotations

from aurora_core.judging.codec import conditions_from_json
from aurora_core.judging.evaluation import Context
from aurora_core.monitor.plan_check import NotComparable, Plan, plan_findings
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.relaxing import relaxed
from aurora_core.pipeline.verification import Judged, judge_content, recorded_plan
from aurora_core.report.clauses import clause_reports
from aurora_core.report.comparison import Comparison
from aurora_core.report.facts import ExecutionFacts, RunFacts
from aurora_core.report.find_bag import FoundBag
from aurora_core.report.run_check import JudgedBag, check_run
from aurora_core.report.signed_run import Verifier, check_signature
from aurora_core.report.verify_report import AsRecorded, VerifyReport, verify_report
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.hashing import trace_hashes


def verify_found(
    known: Knowledge,
    found: FoundBag,
    content: BagContent,
    agsg: Agsg,
    *,
    as_recorded: bool = False,
    trusted: Verifier | None = None,
) -> VerifyReport:
    """Judge a bag by itself, then hold it against the run folder that it lies in.

    Args:
        known: What is installed here.
        found: Where it lies.
        content: What it holds.
        agsg: Graph in it.
        as_recorded: See `judge_content`.
        trusted: Knows the keys by one of which the run has to be signed, None asks for none.

    Raises:
        VerificationError: The bag holds nothing that could be judged.
    """
    judged = judge_content(known, content, agsg, as_recorded=as_recorded)
    foreign = _foreign_to(judged, content) if as_recorded else None
    bag = _judged_bag(known, content, agsg, judged.verdict, judged.plan, judged.context)
    signature = None if trusted is None else check_signature(found.run, trusted)
    run, recorded = None, None
    if found.run is not None:
        run, recorded = check_run(found.run, found.iteration, bag)
    return verify_report(
        str(found.bag),
        bag,
        run=run,
        recorded=recorded,
        as_recorded=foreign,
        signature=signature,
    )


def report_beside(
    known: Knowledge,
    found: FoundBag,
    content: BagContent,
    agsg: Agsg,
    verdict: Verdict,
    heard: Comparison,
) -> VerifyReport:
    """Return the report about a bag whose verdict was held against one heard live.

    Args:
        known: What is installed here.
        found: Where it lies.
        content: What it holds.
        agsg: Graph in it.
        verdict: Of the bag by itself.
        heard: The other verdict against it.

    Raises:
        VerificationError: The bag holds nothing that could be judged.
    """
    conditions = conditions_from_json(content.world.conditions_json)
    plan = recorded_plan(known, content.world, conditions, agsg)
    bag = _judged_bag(known, content, agsg, verdict, plan)
    run = None if found.run is None else check_run(found.run, found.iteration, bag)[0]
    return verify_report(str(found.bag), bag, run=run, recorded=heard)


def _judged_bag(
    known: Knowledge,
    content: BagContent,
    agsg: Agsg,
    verdict: Verdict,
    plan: Plan | NotComparable,
    context: Context | None = None,
) -> JudgedBag:
    hashes = trace_hashes(content.trace, content.world)
    left_out = GroundingOutcome(agsg=agsg)
    if isinstance(plan, Plan):
        left_out = GroundingOutcome(agsg=agsg, unsupported=plan.missing, unjudged=plan.unjudged)
    facts = RunFacts(
        run_id='',
        prompt=agsg.spec.prompt,
        parse=ParseOutcome(spec=agsg.spec),
        grounding=left_out,
        execution=ExecutionFacts(
            bag='',
            ticks=content.trace.ticks,
            dt_s=content.trace.roster.dt_s,
            trace_sha256=hashes.trace_sha256,
            motion_sha256=hashes.motion_sha256,
        ),
        verdict=verdict,
        iterations=agsg.iteration + 1,
    )
    return JudgedBag(
        content=content,
        agsg=agsg,
        hashes=hashes,
        verdict=verdict,
        clauses=clause_reports(facts),
        facts=facts,
        context=context,
        relaxed=lambda: relaxed(known, agsg, verdict, content),
    )


def _foreign_to(judged: Judged, content: BagContent) -> AsRecorded | None:
    """Return by what it was judged, None when that is what is installed."""
    plan = judged.plan
    if isinstance(plan, NotComparable):
        return AsRecorded(version='', differs=(plan.why,))
    if not plan.foreign:
        return None
    otherwise = 0
    if plan.other_version:
        otherwise = len(
            plan_findings(judged.conditions, content.trace.roster, content.world, plan)
        )
    return AsRecorded(version=plan.version, differs=plan.foreign, otherwise=otherwise)
