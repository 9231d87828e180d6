# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`RosStages`: the stages of the pipeline as calls into the graph, from a worker thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from aurora_core.document import Document
from aurora_core.errors import ExecutionError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import (
    Attempt,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    past_json,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.ports.language_model import ModelCall
from aurora_msgs.action import ExecuteScenario
from aurora_msgs.msg import Verdict as VerdictMessage
from aurora_msgs.srv import Check, GroundScenario, ParsePrompt, ProposeRepair, VerifyTrace
from aurora_nodes.answers import PublishedVerdicts, hold
from aurora_nodes.attendance import Attendance
from aurora_ros import interfaces as on
from aurora_ros.call import Caller
from aurora_ros.conversions.messages import agsg as read_graph
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.options import options_json
from aurora_ros.conversions.verdict import verdict_message
from aurora_ros.interfaces import Call
from aurora_ros.parameters import require_positive

# How long the executor may take to end a run that was given up just before this one.
_ENDING_S = 15.0
CALLS = (on.PARSE, on.GROUND_SCENARIO, on.CHECK, on.EXECUTE, on.VERIFY, on.REPAIR)

_Document = TypeVar('_Document', bound=Document)


@dataclass(frozen=True, kw_only=True)
class StageLimits:
    """Wall-clock limits of the stages, s."""

    parse_s: float
    parse_model_s: float
    ground_s: float
    check_s: float
    execute_fixed_s: float
    execute_per_simulated_s: float
    verify_s: float
    repair_s: float
    twin_limit_s: float

    def __post_init__(self) -> None:
        require_positive(
            self, 'parse_s', 'parse_model_s', 'ground_s', 'check_s', 'execute_fixed_s', 'verify_s'
        )
        require_positive(self, 'execute_per_simulated_s', 'repair_s', 'twin_limit_s')


class RosStages:
    """One run's view of the graph.

    Args:
        caller: With `CALLS` prepared; its guard is `attendance.check`.
        attendance: Looks after the participants from the first stage to `close`.
        published: What the monitor says to everybody.
        limits: How long each stage may take.
        run_id: Stamp of the run's documents.
        cancelled: Asked while participants are waited for.
    """

    def __init__(
        self,
        caller: Caller,
        attendance: Attendance,
        published: PublishedVerdicts,
        limits: StageLimits,
        run_id: str,
        cancelled: Callable[[], bool],
    ) -> None:
        self._caller = caller
        self._attendance = attendance
        self._published = published
        self._limits = limits
        self._run_id = run_id
        self._cancelled = cancelled
        self._began = False
        self._trace_sha256: dict[Path, str] = {}

    def close(self) -> None:
        """End the run, if it ever began: participants may go and be restarted."""
        if self._began:
            self._attendance.close()

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Let the parser read the prompt, once everybody whom a run needs is there."""
        self._began = True
        self._attendance.open(self._cancelled)
        self._caller.await_alone(self._limits.twin_limit_s, self._cancelled)
        response = self._caller.service(
            on.PARSE,
            ParsePrompt.Request(
                prompt=request.prompt,
                prompt_bytes=len(request.prompt.encode('utf-8')),
                options_json=options_json(request),
            ),
            self._limits.parse_s if request.model == 'offline' else self._limits.parse_model_s,
        )
        graph = read_graph(response.agsg) if response.understood else None
        outcome = _parsed(response.outcome_json, response.transcript_jsonl, graph)
        for spec in (outcome.spec, None if graph is None else graph.spec):
            if spec is not None:
                hold(on.PARSE, prompt=(request.prompt, spec.prompt))
        return outcome

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Let the grounding node find places and a schedule."""
        more = {} if plan is None else {'plan_json': plan.model_dump_json()}
        response = self._stage(on.GROUND_SCENARIO, GroundScenario, agsg, request, **more)
        outcome = _document(GroundingOutcome, response.outcome_json, on.GROUND_SCENARIO)
        graph = read_graph(response.agsg) if response.grounded else None
        if graph is not None:
            seed = None if graph.grounding is None else graph.grounding.seed
            hold(
                on.GROUND_SCENARIO,
                run=(self._run_id, response.agsg.run_id),
                request=(agsg.spec, graph.spec),
                iteration=(agsg.iteration, graph.iteration),
                seed=(request.seed, seed),
                plan=(plan, None if graph.grounding is None else graph.grounding.repair),
            )
        return GroundingOutcome(**{**dict(outcome), 'agsg': graph})

    def check(self, agsg: Agsg, request: RunRequest) -> FeasibilityVerdict:
        """Let the grounding node judge feasibility."""
        response = self._stage(on.CHECK, Check, agsg, request)
        return _document(FeasibilityVerdict, response.feasibility_json, on.CHECK)

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        """Let the executor run the scenario."""
        if agsg.spec.uavs:
            self._attendance.expect_air()
        if agsg.schedule is None:
            raise ExecutionError('the graph has no schedule', hint='ground the scenario first')
        horizon_s = agsg.schedule.horizon_s
        # Who serves a later stage is looked for again: before anything is flown.
        self._caller.await_alone(self._limits.twin_limit_s, control.cancelled)
        result = self._caller.action(
            on.EXECUTE,
            ExecuteScenario.Goal(
                agsg=agsg_message(agsg, self._run_id),
                bag_directory=str(bag_directory.absolute()),
                options_json=options_json(request),
            ),
            self._limits.execute_fixed_s + horizon_s * self._limits.execute_per_simulated_s,
            on_feedback=lambda feedback: control.progress(
                'execute', min(1.0, feedback.sim_time_s / horizon_s), feedback.sim_time_s
            ),
            cancelled=control.cancelled,
            busy_s=_ENDING_S,
        )
        fields = {
            'bag': result.bag_uri,
            'ticks': result.ticks,
            'trace_sha256': result.trace_sha256,
            'motion_sha256': result.motion_sha256,
            'outcome': result.outcome,
        }
        try:
            execution = ExecutionResult.model_validate(fields)
        except ValidationError as err:
            raise ExecutionError(f'the executor answered with {fields}: {err}') from err
        hold(on.EXECUTE, bag=(bag_directory.absolute(), execution.bag))
        self._trace_sha256[bag_directory] = execution.trace_sha256
        return execution

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Let the monitor judge the bag; whoever took part must still be there at the end.

        A bag that the graph did not record has the trace that the monitor finds in it.
        """
        response = self._caller.service(
            on.VERIFY,
            VerifyTrace.Request(
                agsg=agsg_message(agsg, self._run_id), bag_uri=str(bag.absolute())
            ),
            self._limits.verify_s,
            while_working=True,
        )
        answer = response.verdict
        verdict = _document(Verdict, answer.verdict_json, on.VERIFY)
        hold(
            on.VERIFY,
            run=(self._run_id, answer.run_id),
            iteration=(agsg.iteration, answer.iteration),
            source=(VerdictMessage.BAG, answer.source),
            trace_hash=(
                self._trace_sha256.setdefault(bag, answer.trace_sha256),
                answer.trace_sha256,
            ),
            set_of_conditions=([c.id for c in agsg.conditions], [r.id for r in verdict.results]),
            status=(verdict.status.value, answer.status),
        )
        published = self._published.last(self._run_id, agsg.iteration, self._attendance.check)
        told = _document(Verdict, published.verdict_json, on.VERIFY)
        hold(on.VERIFY, verdict_than_it_published=(told, verdict))
        self._attendance.confirm()
        self._caller.check_alone()
        return verdict

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        """Let the repair node propose how to realise a violated request otherwise."""
        if not self._attendance.has_repair:
            return Proposal(
                outcome=ProposalOutcome.EXHAUSTED,
                reason='nobody repairs: start it with ros2 run aurora_nodes repair',
            )
        response = self._caller.service(
            on.REPAIR,
            ProposeRepair.Request(
                agsg=agsg_message(agsg, self._run_id),
                verdict=verdict_message(
                    verdict,
                    run_id=self._run_id,
                    iteration=agsg.iteration,
                    end_s=0.0,
                    trace_sha256=self._trace_sha256[bag],
                ),
                bag_uri=str(bag.absolute()),
                past_json=past_json(past),
            ),
            self._limits.repair_s,
        )
        proposal = _document(Proposal, response.proposal_json, on.REPAIR)
        hold(on.REPAIR, outcome=(proposal.outcome.value, response.outcome))
        return proposal

    def _stage(self, call: Call, kind: Any, agsg: Agsg, request: RunRequest, **more: str) -> Any:
        limit_s = self._limits.check_s if call is on.CHECK else self._limits.ground_s
        return self._caller.service(
            call,
            kind.Request(
                agsg=agsg_message(agsg, self._run_id), options_json=options_json(request), **more
            ),
            limit_s,
        )


def _parsed(outcome_json: str, transcript_jsonl: str, graph: Agsg | None) -> ParseOutcome:
    outcome = _document(ParseOutcome, outcome_json, on.PARSE)
    lines = filter(None, transcript_jsonl.split('\n'))
    calls = tuple(_document(ModelCall, line, on.PARSE) for line in lines)
    fields = {name: getattr(outcome, name) for name in ParseOutcome.model_fields}
    return ParseOutcome(**{**fields, 'model_calls': calls, 'agsg': graph})


def _document(kind: type[_Document], text: str, call: Call) -> _Document:
    try:
        return kind.model_validate_json(text)
    except ValidationError as err:
        raise ExecutionError(
            f'{call.server} answered {call.name} with a document that is not valid: {err}',
            component=call.server,
        ) from err
