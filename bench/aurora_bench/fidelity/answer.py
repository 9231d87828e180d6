# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the product answers to a prompt, as far as fidelity is concerned."""

from __future__ import annotations

from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.document import Document
from aurora_core.errors import AuroraError, ConfigError
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline.functions import check_stage
from aurora_core.pipeline.stages import RunRequest
from aurora_core.report.build import refusal_certificate
from aurora_core.spec.scenario import Clause, ScenarioSpec
from aurora_llm.parse import read_prompt


class Answer(Document):
    """A specification, a refusal or a question; a refusal by the check comes with the first.

    Attributes:
        spec: None when the prompt was refused or not understood.
        clauses: What became of every clause of the prompt.
        reasons: `because` of every refusal; empty when the request was accepted.
        question: What the product wants to know, when it did not understand.
        error: The product broke; what it said.
    """

    spec: ScenarioSpec | None = None
    clauses: tuple[Clause, ...] = ()
    reasons: tuple[str, ...] = ()
    question: str = ''
    error: str = ''


def offline_answer(prompt: str, map_name: str = 'downtown', seed: int = 1) -> Answer:
    """Ask the offline parser and the check of limits; nothing is grounded or run."""
    return answer(RunRequest(prompt=prompt, map_name=map_name, seed=seed))


def answer(request: RunRequest) -> Answer:
    """Ask whoever the request names to read its prompt, and the check of limits.

    Raises:
        ConfigError: A recorded reply is missing; what the product would say is not known.
    """
    map_name = request.map_name
    try:
        outcome = read_prompt(installed(), request)
        if outcome.spec is None:
            return Answer(
                clauses=outcome.clauses,
                reasons=tuple(refusal_certificate(r).reason for r in outcome.refusals),
                question=outcome.question or '',
            )
        digest = installed().map(map_name).digest
        verdict = check_stage(installed(), build_agsg(outcome.spec, map_digest=digest))
    except ConfigError:
        raise
    # One prompt that breaks the product must not end the measurement; it counts as all missed.
    except (AuroraError, ValueError, LookupError, TypeError, AttributeError) as err:
        return Answer(error=f'{type(err).__name__}: {err}')
    refused = verdict.result is Feasibility.INFEASIBLE
    return Answer(
        spec=outcome.spec,
        clauses=outcome.spec.clauses or outcome.clauses,
        reasons=tuple(c.reason for c in verdict.certificates) if refused else (),
    )
