# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of ten records, worked out by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aurora_bench.campaign.measured import Flown, Measured
from aurora_bench.campaign.metrics import METRICS, fidelity, paired, share
from aurora_bench.campaign.plan import TYPED, Configuration, Plan, Reader, Task
from aurora_bench.campaign.record import CampaignRun, Ending
from aurora_bench.campaign.report import write_report
from aurora_bench.campaign.results import Campaign, write_campaign
from aurora_bench.campaign.runs import CampaignWork
from aurora_bench.campaign.tables import all_tables, as_csv, as_latex
from aurora_bench.machine import machine_facts
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.results import Table
from aurora_bench.rulers.checking import Said
from aurora_bench.rulers.trial import Trial
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.outcomes.verdict import VerdictStatus

V, X, U = VerdictStatus.VERIFIED, VerdictStatus.VIOLATED, VerdictStatus.INCONCLUSIVE
AGAINST = Said(requirement='r1', kind='uav', outcome='does_not', why='none')
HOLDS = Said(requirement='r1', kind='uav', outcome='holds', why='one')


def record(number: int, configuration: Configuration, **more: Any) -> CampaignRun:
    """Return a record; requirements: 4, of which as many hold as the number says."""
    values: dict[str, Any] = {
        'key': f'{number}:{configuration.value}', 'configuration': configuration,
        'reader': 'offline', 'file': 'own.jsonl', 'id': f'hover-{number}', 'category': 'hover',
        'feasibility': 'feasible', 'seed': 1, 'status': 'violated',
        'ending': Ending.COMPLETED, 'met': number, 'requirements': 4,
    }  # fmt: skip
    return CampaignRun(**{**values, **more})


B4 = (
    record(0, Configuration.B4, first=V, final=V, status='verified', right=True, said=(HOLDS,)),
    record(1, Configuration.B4, first=V, final=V, status='verified', said=(HOLDS, AGAINST)),
    record(2, Configuration.B4, first=X, final=X),
    record(3, Configuration.B4, first=U, final=U, status='inconclusive'),
    record(4, Configuration.B4, ending=Ending.FAILED, status='error', why='execute'),
)
AURORA = (
    record(0, Configuration.AURORA, first=V, final=V, status='verified', right=True),
    record(1, Configuration.AURORA, first=V, final=V, status='incomplete'),
    record(
        2, Configuration.AURORA, first=X, final=V, status='verified', right=True, simulations=3
    ),
    record(
        3, Configuration.AURORA, ending=Ending.DECLINED, status='infeasible', why='refused: speed'
    ),
    record(4, Configuration.AURORA, first=X, final=X, simulations=1),
)  # fmt: skip


def test_metrics_of_ten_records_are_those_worked_out_by_hand() -> None:
    found = {m.name: (share(B4, m.of).met, share(AURORA, m.of).met) for m in METRICS}
    assert found == {
        'C': (4, 4),
        'RF': (1, 0),
        'declined': (0, 1),
        'P': (2, 3),
        'SF': (1, 1),
        'undecided': (1, 0),
        'verified': (2, 2),
        'right': (1, 2),
    }
    assert (fidelity(B4).met, fidelity(B4).total) == (10, 20)


def test_the_table_of_ten_records_is_that_worked_out_by_hand() -> None:
    """Wilson intervals after his formula with z = 1.96, worked out apart."""
    rows = all_tables((*B4, *AURORA))['performance'].rows
    assert [row[:7] for row in rows] == [
        ('offline', 'B4', 5, '0.80 [0.38, 0.96]', '0.20 [0.04, 0.62]', '0.00 [0.00, 0.43]',
         '0.40 [0.12, 0.77]'),
        ('offline', 'AURORA', 5, '0.80 [0.38, 0.96]', '0.00 [0.00, 0.43]', '0.20 [0.04, 0.62]',
         '0.60 [0.23, 0.88]'),
    ]  # fmt: skip
    checked = all_tables((*B4, *AURORA))['checked'].rows
    assert checked[0] == ('offline', 'B4', 2, 1, 1, 0, 3, 1, 0)
    assert checked[1] == ('offline', 'AURORA', 3, 0, 0, 0, 0, 0, 0)
    repair = {row[1]: row[2] for row in all_tables(AURORA)['repair'].rows}
    assert (repair['repaired'], repair['nothing simulated again']) == (1, 1)


def test_what_was_executed_is_told_by_mission_event_and_episode() -> None:
    """Two missions of one mode, three events, four messages, one episode of two simulations."""
    one = Measured(
        missions=(Flown(mode='track', capture_s=4.0, on_target=0.9, off_m=2.0, off_most_m=5.0),),
        event_s=(0.05, -0.1), latency_s=(0.1, 0.3), sent=3,
    )  # fmt: skip
    two = Measured(missions=(Flown(mode='track'),), stated_s=(-0.2,), latency_s=(0.2,), sent=1)
    again = {'again repair': 1.0, 'again execute': 6.0, 'again verify': 3.0}
    runs = (
        record(0, Configuration.AURORA, first=V, final=V, measured=one),
        record(1, Configuration.AURORA, first=X, final=X, simulations=3, measured=two)
        .model_copy(update={'seconds': again}),
        record(2, Configuration.AURORA, ending=Ending.DECLINED),
    )  # fmt: skip
    tables = all_tables(runs)
    moments = {row[2]: row[3:] for row in tables['coordination'].rows}
    assert moments == {
        'event: recorded to recomputed moment': (2, pytest.approx(0.075), 0.1, None),
        'event: recorded to stated time': (1, 0.2, 0.2, None),
        'message: latency': (3, 0.2, 0.3, None),
        'messages delivered': (4, None, None, 0.75),
    }
    assert tables['missions'].rows == [
        ('offline', 'AURORA', 'track', 2, 1, 4.0, 4.0, 0.9, 2.0, 5.0)
    ]
    parts = {row[2]: row[3:] for row in tables['episodes'].rows}
    assert parts['execute'] == (1, 6.0, 3.0, 0.6)
    assert parts['episode'] == (1, 10.0, 5.0, 1.0)


def test_ours_stand_beside_the_least_and_the_greatest_of_the_papers() -> None:
    row = all_tables(AURORA)['beside'].rows[0]
    assert row[2:8] == ('0.800', '0.980..1.000', '0.000', '0.000', '0.600', '0.640..0.840')


def test_paired_runs_are_compared_prompt_by_prompt() -> None:
    passed = next(m.of for m in METRICS if m.name == 'P')
    assert paired(B4, AURORA, passed) == (5, 1, 0, 1.0)
    # Of six changed pairs all in one direction: twice (1/2)^6.
    before = [record(k, Configuration.B5, final=X) for k in range(6)]
    after = [record(k, Configuration.AURORA, final=V) for k in range(6)]
    assert paired(before, after, passed) == (6, 6, 0, 0.03125)


def test_configurations_differ_by_switches_alone() -> None:
    budget = Plan(name='any', prompts=('own.jsonl',)).repair
    switches = {c.value: (c.without, c.repair(budget)) for c in TYPED}
    everything = frozenset({CheckStage.STATIC, CheckStage.PROOFS})
    nothing: frozenset[CheckStage] = frozenset()
    assert switches == {'B4': (everything, 0), 'B5': (nothing, 0), 'AURORA': (nothing, 5)}


def test_tables_in_other_forms() -> None:
    table = Table(headings=('a_b', 'n'), rows=(('50 % & more', 0.123456789), ('x', None)))
    assert as_csv(table) == 'a_b,n\n50 % & more,0.123456789\nx,\n'
    latex = as_latex(table, 'own')
    assert r'a\_b & n \\' in latex
    assert r'50 \% \& more & 0.1235 \\' in latex
    assert r'x & -- \\' in latex


def test_a_report_has_every_form_and_names_no_prompt(tmp_path: Path) -> None:
    found = Campaign(plan={'name': 'own'}, files={}, code='c', versions={}, runs=(*B4, *AURORA))
    write_campaign(tmp_path, found, found.runs, machine_facts())
    written = write_report(tmp_path, tmp_path / 'report')
    kinds = {path.suffix for path in written}
    assert kinds >= {'.md', '.csv', '.tex', '.pdf', '.svg', '.png', '.txt'}
    assert all(path.stat().st_size for path in written)
    texts = [p.read_text() for p in written if p.suffix in ('.md', '.csv', '.tex')]
    assert not any('hover-' in text for text in texts)
    assert 'The simulators differ' in texts[0]


@pytest.mark.parametrize('configuration', [Configuration.B4, Configuration.B5])
def test_who_leaves_the_check_out_refuses_nothing(
    tmp_path: Path, configuration: Configuration
) -> None:
    """A flight above the limit is refused by B5 and flown by B4: by the real engine."""
    document: dict[str, Any] = {
        'id': 'infeasible-901', 'category': 'infeasible', 'feasibility': 'infeasible',
        'prompt': 'A drone hovers at 130 m for 5 seconds.', 'paraphrase_group': None,
        'end_to_end': True,
        'requirements': [{'id': 'r1', 'kind': 'reject', 'because': 'altitude_limit'}],
    }  # fmt: skip
    trial = Trial(
        key='k', file='own.jsonl', seed=1, prompt=AnnotatedPrompt.model_validate(document),
        document=document, folder='own',
    )  # fmt: skip
    plan = Plan(name='any', prompts=('own.jsonl',))
    work = CampaignWork(plan=plan, folder=tmp_path)
    work.prepare()
    task = Task(key='k', configuration=configuration, reader=Reader(name='offline'), trial=trial)
    run = work(task)
    if configuration is Configuration.B5:
        assert (run.ending, run.why) == (Ending.DECLINED, 'refused: altitude_limit')
        assert (run.right, run.met, run.requirements) == (True, 1, 1)
    else:
        assert (run.ending, run.right, run.met) == (Ending.COMPLETED, False, 0)
        assert run.final is not None
        assert run.trace_sha256
        assert run.measured is not None
        (flown,) = run.measured.missions
        assert (flown.mode, flown.on_target) == ('hover', None)
        assert flown.capture_s is not None
        assert flown.off_m is not None
        assert flown.off_m < 1.0
