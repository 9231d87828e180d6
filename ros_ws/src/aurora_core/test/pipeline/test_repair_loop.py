# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The loop back after a violation: parsing and grounding are real, flights and verdicts not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from repair_runs import (
    HELD,
    KNOWN,
    PROMPT,
    RUN_ID,
    FakeStages,
    Traced,
    Workers,
    names,
    ran,
    told,
)

from aurora_core.errors import SpecError
from aurora_core.execution.faults import Fault
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.repair import (
    Attempt,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
    ValueEdit,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline import functions
from aurora_core.pipeline.stages import RunRequest
from aurora_core.report.status import Status
from aurora_core.spec.parameter import Provenance


def test_a_run_that_holds_is_never_repaired(tmp_path: Path) -> None:
    stages = FakeStages(HELD)
    report = ran(stages, tmp_path)
    assert (report.status, report.repairs, stages.plans) == (Status.VERIFIED, (), [None])
    assert 'edits.1.json' not in names(tmp_path)


def test_a_violated_run_is_realised_elsewhere_until_it_holds(tmp_path: Path) -> None:
    stages = FakeStages(-0.5, -0.4, HELD)
    report = ran(stages, tmp_path)
    assert report.status is Status.VERIFIED
    assert report.trace is not None
    assert (report.trace.bag, report.trace.sha256) == ('bag.2', '2')
    assert [repair.outcome for repair in report.repairs] == ['violated', 'verified']
    assert report.metrics.iterations == 3
    kinds = ('spec', 'agsg', 'grounding', 'schedule', 'feasibility', 'verdict', 'edits')
    assert names(tmp_path) >= {f'{kind}.{k}.json' for kind in kinds for k in (1, 2)}
    folder = tmp_path / RUN_ID
    specs = {(folder / f'spec.{k}.json').read_text() for k in (0, 1, 2)}
    assert len(specs) == 1
    lanes = [json.loads((folder / f'grounding.{k}.json').read_text()) for k in (0, 1, 2)]
    assert len({row['anchor_lane'] for row in lanes}) == 3
    assert lanes[2]['repair']['avoided'][0]['lane'] == lanes[0]['anchor_lane']
    edits = json.loads((folder / 'edits.2.json').read_text())
    assert edits['edits'][0]['path'] == 'grounding/anchor'
    assert json.loads((folder / 'agsg.2.json').read_text())['stage'] == Stage.REPAIRED


def test_a_spent_budget_ends_violated_with_the_best_realisation(tmp_path: Path) -> None:
    report = ran(FakeStages(-0.5, -0.2, -0.9), tmp_path, repair=2)
    assert report.status is Status.VIOLATED
    assert report.trace is not None
    assert report.trace.bag == 'bag.1'
    assert report.metrics.worst_normalised == -0.2
    assert [b.bag for b in report.bags or ()] == ['bag.0', 'bag.1', 'bag.2']
    assert 'bag.3' not in names(tmp_path)
    [failed] = [row.id for row in report.conditions if not row.satisfied]
    assert f'2 other realisations did not hold either (in none of them: {failed})' in (
        report.summary
    )


def test_no_better_realisation_leaves_the_first_one(tmp_path: Path) -> None:
    report = ran(FakeStages(-0.5, -0.5, -0.7), tmp_path, repair=2)
    assert report.trace is not None
    assert report.trace.bag == 'bag.0'


def test_without_repair_the_first_verdict_stands(tmp_path: Path) -> None:
    stages = FakeStages(-0.5)
    report = ran(stages, tmp_path, repair=0)
    assert (report.status, report.repairs, len(stages.plans)) == (Status.VIOLATED, (), 1)


def test_a_place_that_is_not_found_costs_no_simulation(tmp_path: Path) -> None:
    stages = FakeStages(-0.5, HELD)
    stages.no_place = 1
    report = ran(stages, tmp_path, repair=1)
    assert report.status is Status.VERIFIED
    assert [repair.outcome for repair in report.repairs] == ['no_place', 'verified']
    assert report.repairs[0].bag is None


def test_a_cancel_in_the_middle_leaves_the_best_run_and_nothing_of_the_other(
    tmp_path: Path,
) -> None:
    report = ran(FakeStages(-0.5, -0.2, HELD, cancel_at=2), tmp_path)
    assert report.status is Status.CANCELLED
    assert report.trace is not None
    assert report.trace.bag == 'bag.1'
    assert [b.bag for b in report.bags or ()] == ['bag.0', 'bag.1']
    assert {'bag.0', 'bag.1', 'verdict.1.json'} <= names(tmp_path)
    assert not {name for name in names(tmp_path) if '.2' in name}


def test_a_proposal_beyond_the_lock_is_an_error_and_no_run(tmp_path: Path) -> None:
    stages = FakeStages(-0.5)
    edit = ValueEdit(
        path='missions/m1/altitude_m',
        requested=20.0,
        realised=10.0,
        provenance=Provenance.EXPLICIT,
    )
    stages.proposal = Proposal(
        outcome=ProposalOutcome.EDITED,
        step=Step.ONE,
        plan=RepairPlan(values=(edit,)),
        reason='planted',
    )
    report = ran(stages, tmp_path)
    assert report.status is Status.ERROR
    assert report.error is not None
    assert 'missions/m1/altitude_m is locked' in report.error.message
    assert [b.bag for b in report.bags or ()] == ['bag.0']


def test_grounding_refuses_what_is_locked() -> None:
    graph = functions.parse_stage(KNOWN, PROMPT, 'downtown', 1).agsg
    assert graph is not None
    row = next(p for p in graph.parameters if p.path == 'missions/m1/duration_s')
    edit = ValueEdit(
        path=row.path, requested=row.requested, realised=1.0, provenance=row.provenance
    )
    with pytest.raises(SpecError, match='duration_s is locked'):
        functions.ground_stage(KNOWN, graph, 1, RepairPlan(values=(edit,)))


def test_what_was_tried_goes_into_a_history_that_is_not_frozen(tmp_path: Path) -> None:
    history = tmp_path / 'history'
    frozen = tmp_path / 'frozen'
    ran(FakeStages(-0.5, HELD), tmp_path / 'a', history=history)
    ran(FakeStages(-0.5, HELD), tmp_path / 'b', history=frozen, history_frozen=True)
    [kept] = (history / 'repairs').glob('*.json')
    [lesson] = json.loads(kept.read_text())['lessons']
    assert lesson['move'].endswith(' grounding/anchor +0')
    assert lesson['helped'] is True
    assert not frozen.exists()


class Watching(FakeStages):
    """Remembers with what each proposal began."""

    def __init__(self, *margins: float) -> None:
        super().__init__(*margins)
        self.learned: list[dict[str, float]] = []

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        self.learned.append(dict(past[0].learned))
        return super().propose(agsg, verdict, bag, past)


def test_the_next_run_begins_with_what_the_history_teaches(tmp_path: Path) -> None:
    history = tmp_path / 'history'
    first, second = Watching(-0.5, -0.4, HELD), Watching(-0.5, HELD)
    ran(first, tmp_path / 'a', history=history)
    ran(second, tmp_path / 'b', history=history)
    # Within a run nothing more is learned than it began with.
    assert first.learned == [{}, {}]
    [known] = second.learned
    assert all(factor > 1.0 for factor in known.values())
    assert known


def test_a_violated_run_is_repaired_unasked_unless_faults_were_injected(tmp_path: Path) -> None:
    usual = ran(FakeStages(-0.5, HELD), tmp_path / 'a', repair=None)
    assert usual.status is Status.VERIFIED
    fault = Fault(kind='target_removed', subject='ego', at_s=2.0)
    stages = FakeStages(-0.5, HELD)
    report = ran(stages, tmp_path / 'b', repair=None, faults=(fault,))
    assert (report.status, report.repairs) == (Status.VIOLATED, ())


class Nowhere(FakeStages):
    """Has a place only for what flies higher than usual."""

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        if plan is None:
            self.plans.append(plan)
            failure = GroundingFailure(reason='clearance', tried=1, rejected_by={'clearance': 1})
            return GroundingOutcome(failure=failure)
        return super().ground(agsg, request, plan)


OPEN = 'A drone hovers over the ego car for 5 seconds.'


def test_a_request_without_a_place_is_run_with_values_that_have_one(tmp_path: Path) -> None:
    report = ran(Nowhere(HELD), tmp_path, prompt=OPEN)
    assert report.status is Status.VERIFIED
    [placed] = report.repairs
    assert (placed.kind, placed.outcome, placed.bag) == ('symbolic', 'placed', None)
    [edit] = placed.edits
    assert edit.path == 'missions/m1/altitude_m'
    assert isinstance(edit.new, float)
    assert f'it was placed with missions/m1/altitude_m {edit.new:g}' in report.summary
    assert 'realisations' not in report.summary
    grounding = json.loads((tmp_path / RUN_ID / 'grounding.0.json').read_text())
    assert grounding['repair']['values'][0]['realised'] == edit.new


@pytest.mark.parametrize('more', [{'repair': 0, 'prompt': OPEN}, {'prompt': PROMPT}])
def test_without_repair_or_with_all_stated_there_is_no_place(
    tmp_path: Path, more: dict[str, Any]
) -> None:
    stages = Nowhere(HELD)
    report = ran(stages, tmp_path, **more)
    assert (report.status, report.trace) == (Status.INCONCLUSIVE, None)
    assert stages.plans == [None]


def test_a_placed_run_that_is_violated_keeps_its_values_when_it_is_repaired(
    tmp_path: Path,
) -> None:
    stages = Nowhere(-0.5, HELD)
    report = ran(stages, tmp_path, prompt=OPEN)
    assert report.status is Status.VERIFIED
    assert [repair.outcome for repair in report.repairs] == ['placed', 'verified']
    first, second = (plan for plan in stages.plans if plan is not None)
    assert {e.path for e in first.values} <= {e.path for e in second.values}
    assert 'It took 2 realisations' in report.summary


@pytest.mark.parametrize(
    'margins',
    [
        (-0.5, HELD),
        (-0.5, -0.5, -0.5, HELD),
        (-0.5, -0.6, -0.2, -0.7, -0.3, -0.9),
        (-0.5, -0.2, -0.2, -0.1, HELD),
    ],
)
def test_any_number_of_processes_gives_the_same_run(
    tmp_path: Path, margins: tuple[float, ...]
) -> None:
    alone = Traced(*margins)
    expected = told(ran(alone, tmp_path / '1'))
    for places in (1, 2, 4):
        stages, workers = Traced(*margins), Workers(places)
        root = tmp_path / f'{places} beside'
        report = ran(stages, root, beside=workers)
        assert told(report) == expected
        assert names(root) == names(tmp_path / '1')
        # The first one is executed by the run itself, all others by the workers.
        assert stages.executed == [0]
        assert workers.most <= places
        assert max(graph.iteration for graph in workers.given) <= 5
        simulated = [row.bag for row in report.repairs if row.bag is not None]
        assert len(workers.given) == len(simulated) + len(workers.dropped)


def test_who_is_of_no_avail_was_not_waited_for(tmp_path: Path) -> None:
    """Candidates that hang on nothing but the place are executed while the one before is."""
    workers = Workers(2)
    report = ran(Traced(-0.5, -0.5, -0.5, HELD), tmp_path, beside=workers)
    assert report.status is Status.VERIFIED
    assert [graph.iteration for graph in workers.given] == [1, 2, 3, 4]
    assert workers.dropped == [4]


def test_what_a_worker_loses_is_executed_by_the_run(tmp_path: Path) -> None:
    expected = told(ran(Traced(-0.5, -0.4, HELD), tmp_path / 'a'))
    stages = Traced(-0.5, -0.4, HELD)
    report = ran(stages, tmp_path / 'b', beside=Workers(2, broken=True))
    assert told(report) == expected
    assert stages.executed == [0, 1, 2]


def test_no_model_is_asked_for_a_candidate_before_its_turn(tmp_path: Path) -> None:
    workers = Workers(2)
    recording = tmp_path / 'replies'
    stages = Traced(-0.5, HELD)
    ran(stages, tmp_path / 'runs', beside=workers, model=f'recorded:{recording}')
    assert (stages.executed, workers.given) == ([0, 1], [])
