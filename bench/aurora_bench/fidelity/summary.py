# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Fidelity of many answers: by kind, by category, by style, and what went wrong besides."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.consistency import Group, groups
from aurora_bench.fidelity.equivalences import EQUIVALENCES
from aurora_bench.fidelity.misses import Miss, Told, misses
from aurora_bench.fidelity.score import PromptScore, RequirementScore, score
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.statistics import style
from aurora_bench.results import Cell, Table
from aurora_core.document import Document
from aurora_core.report.share import Share
from aurora_core.spec.vocabulary import ClauseStatus


class Judged(Document):
    """One prompt, its answer, its scores and its misses.

    Attributes:
        prompt: With its annotation.
        answer: Of the product.
        score: The fair one, which counts (`equivalences.py`).
        strict: Only the form of the annotation counts; beside the fair one.
        misses: By the fair score.
    """

    prompt: AnnotatedPrompt
    answer: Answer
    score: PromptScore
    strict: PromptScore
    misses: tuple[Miss, ...]

    @property
    def is_missed_infeasibility(self) -> bool:
        """It must be refused and was accepted (a question is no acceptance)."""
        answer = self.answer
        is_accepted = answer.spec is not None and not answer.reasons
        return self.prompt.feasibility == 'infeasible' and is_accepted

    @property
    def is_called_complete(self) -> bool:
        """It was accepted, and no clause of it is called `not_encoded`."""
        answer = self.answer
        unread = any(c.status is ClauseStatus.NOT_ENCODED for c in answer.clauses)
        return answer.spec is not None and not answer.reasons and not unread

    @property
    def is_wrong_reason(self) -> bool:
        """It was refused, as it must be, for a reason that no annotation names."""
        return (
            self.prompt.feasibility == 'infeasible'
            and bool(self.answer.reasons)
            and bool(self.misses)
        )

    @property
    def is_false_refusal(self) -> bool:
        """It must be accepted and was refused."""
        return self.prompt.feasibility != 'infeasible' and bool(self.answer.reasons)


def judge(prompt: AnnotatedPrompt, answer: Answer) -> Judged:
    """Score one answer and name what it misses."""
    result = score(prompt, answer)
    return Judged(
        prompt=prompt,
        answer=answer,
        score=result,
        strict=score(prompt, answer, is_fair=False),
        misses=tuple(misses(prompt, answer, result)),
    )


def requirement_share(scores: Sequence[RequirementScore]) -> Share:
    """Return the share of requirements that are wholly met."""
    return Share(met=sum(r.is_met for r in scores), total=len(scores))


def field_share(scores: Sequence[RequirementScore]) -> Share:
    """Return the share of annotated fields that hold."""
    return Share(
        met=sum(sum(r.fields.values()) for r in scores), total=sum(len(r.fields) for r in scores)
    )


def all_scores(judged: Sequence[Judged]) -> list[RequirementScore]:
    """Return the scores of all requirements."""
    return [r for j in judged for r in j.score.requirements]


def strict_scores(judged: Sequence[Judged]) -> list[RequirementScore]:
    """Return the scores of all requirements without equivalences, final landings included."""
    return [r for j in judged for r in j.strict.requirements]


def last_line(judged: Sequence[Judged]) -> str:
    """Return the one line that programs read."""
    whole, fields = requirement_share(all_scores(judged)), field_share(all_scores(judged))
    low, high = whole.interval
    return (
        f'requirement fidelity {whole.value:.3f} [{low:.3f}, {high:.3f}]  '
        f'field fidelity {fields.value:.3f}'
    )


def tables(judged: Sequence[Judged]) -> tuple[Table, ...]:
    """Return fidelity by kind, category and style, and what went wrong besides."""
    lost = [m for j in judged for m in j.misses]
    told = Counter(m.told for m in lost)
    kinds = Counter((m.kind, ', '.join(m.fields), m.told.value) for m in lost)
    return (
        _scorer_table(judged),
        _forms_table(judged),
        _table('kind', _split(judged, lambda _j, r: r.kind)),
        _table('category', _split(judged, lambda j, _r: j.prompt.category)),
        _table('style', _split(judged, lambda j, _r: style(j.prompt.prompt))),
        Table(
            headings=('what', 'number', 'of'),
            rows=tuple((word, met, total) for word, met, total in counts(judged)),
        ),
        Table(
            headings=('missed requirements', 'number'),
            rows=tuple((word.value, told[word]) for word in Told),
        ),
        Table(
            headings=('kind', 'fields that do not hold', 'told', 'number'),
            rows=tuple((*key, n) for key, n in kinds.most_common(25)),
            caption='Commonest misses',
        ),
        _consistency_table(judged),
    )


def paraphrases(judged: Sequence[Judged]) -> list[Group]:
    """Return the paraphrase groups and who stands apart in them."""
    return groups([(j.prompt, j.answer) for j in judged])


def turned(judged: Sequence[Judged]) -> dict[str, int]:
    """Return how many requirements each equivalence turned from missed to met.

    An empty key: met in the same form, since other requirements are.
    """
    found: Counter[str] = Counter()
    for j in judged:
        was_met = {r.id: r.is_met for r in j.strict.requirements}
        found.update(r.form for r in j.score.requirements if r.is_met and not was_met[r.id])
        # Named otherwise, or present after all where it must not be.
        found[''] -= sum(was_met[r.id] and not r.is_met for r in j.score.requirements)
    return {key: number for key, number in sorted(found.items()) if number}


def _scorer_table(judged: Sequence[Judged]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for word, scores in (('strict', strict_scores(judged)), ('fair', all_scores(judged))):
        rows.append((word, *_shares(scores)))
    return Table(headings=('scorer', *_SHARES), rows=tuple(rows))


def _forms_table(judged: Sequence[Judged]) -> Table:
    found = turned(judged)
    landings = [name for j in judged for name in j.score.landings]
    rows: list[tuple[Cell, ...]] = [(e.key, e.forms, found.get(e.key, 0)) for e in EQUIVALENCES]
    rows.append(('', 'met or missed with other requirements', found.get('', 0)))
    rows.append(('landing', 'the landing that ends every mission: not scored', len(landings)))
    return Table(
        headings=('form', 'what counts the same', 'requirements'),
        rows=tuple(rows),
        caption='What the strict scorer misses and the fair one does not',
    )


def _consistency_table(judged: Sequence[Judged]) -> Table:
    found = paraphrases(judged)
    share = f'{sum(g.is_consistent for g in found)} of {len(found)}'
    return Table(
        headings=('paraphrase group', 'prompts', 'with another scenario'),
        rows=tuple(
            (g.name, len(g.members), ', '.join(g.differing)) for g in found if not g.is_consistent
        ),
        caption=f'Paraphrase groups whose members all give the same scenario: {share}',
    )


def counts(judged: Sequence[Judged]) -> tuple[tuple[str, int, int], ...]:
    """Return what is counted on its own: word, number, and out of how many."""
    impossible = sum(j.prompt.feasibility == 'infeasible' for j in judged)
    possible = len(judged) - impossible
    lost = [m for j in judged for m in j.misses]
    return (
        ('prompts with every requirement met', sum(not j.misses for j in judged), len(judged)),
        (
            'prompts called complete that miss a requirement',
            sum(j.is_called_complete and bool(j.misses) for j in judged),
            sum(j.is_called_complete for j in judged),
        ),
        (
            'prompts with every requirement met that are called complete or refused',
            sum(not j.misses and (j.is_called_complete or bool(j.answer.reasons)) for j in judged),
            sum(not j.misses for j in judged),
        ),
        (
            'infeasible prompts accepted',
            sum(j.is_missed_infeasibility for j in judged),
            impossible,
        ),
        (
            'infeasible prompts refused for another reason',
            sum(j.is_wrong_reason for j in judged),
            impossible,
        ),
        (
            'infeasible prompts answered with a question',
            sum(bool(j.answer.question) for j in judged if j.prompt.feasibility == 'infeasible'),
            impossible,
        ),
        ('feasible prompts refused', sum(j.is_false_refusal for j in judged), possible),
        (
            'prompts answered with a question',
            sum(bool(j.answer.question) for j in judged),
            len(judged),
        ),
        ('prompts that broke the product', sum(bool(j.answer.error) for j in judged), len(judged)),
        (
            'clauses falsely called no_requirement',
            len({(m.prompt_id, m.clause) for m in lost if m.told is Told.DISMISSED}),
            sum(c.status.value == 'no_requirement' for j in judged for c in j.answer.clauses),
        ),
        (
            'paraphrase groups with one scenario',
            sum(g.is_consistent for g in paraphrases(judged)),
            len(paraphrases(judged)),
        ),
        (
            'agents and UAVs that nothing asked for',
            sum(len(j.score.extra) for j in judged if j.prompt.feasibility != 'infeasible'),
            sum(
                len(j.answer.spec.agents) + len(j.answer.spec.uavs)
                for j in judged
                if j.answer.spec is not None and j.prompt.feasibility != 'infeasible'
            ),
        ),
    )


def as_json(judged: Sequence[Judged]) -> dict[str, Any]:
    """Return everything as plain JSON values."""
    scores = all_scores(judged)
    return {
        'requirement_fidelity': share_json(requirement_share(scores)),
        'field_fidelity': share_json(field_share(scores)),
        'strict': {
            'requirement_fidelity': share_json(requirement_share(strict_scores(judged))),
            'field_fidelity': share_json(field_share(strict_scores(judged))),
        },
        'turned': turned(judged),
        'final_landings': sum(len(j.score.landings) for j in judged),
        'beyond': sum(len(j.score.beyond) for j in judged),
        'by_kind': _split_json(_split(judged, lambda _j, r: r.kind)),
        'by_category': _split_json(_split(judged, lambda j, _r: j.prompt.category)),
        'by_style': _split_json(_split(judged, lambda j, _r: style(j.prompt.prompt))),
        'counts': {word: {'number': met, 'of': total} for word, met, total in counts(judged)},
        'paraphrase_groups': [
            {'name': g.name, 'members': list(g.members), 'differing': list(g.differing)}
            for g in paraphrases(judged)
        ],
        'prompts': [
            {
                'id': j.prompt.id,
                'prompt': j.prompt.prompt,
                'requirements': len(j.prompt.requirements),
                'reasons': list(j.answer.reasons),
                'question': j.answer.question,
                'error': j.answer.error,
                'extra': list(j.score.extra),
                'forms': {r.id: r.form for r in j.score.requirements if r.form},
                'final_landings': list(j.score.landings),
                'beyond': list(j.score.beyond),
                'misses': [m.model_dump(mode='json') for m in j.misses],
            }
            for j in judged
        ],
    }


def share_json(share: Share) -> dict[str, float]:
    """Return a share with its interval."""
    low, high = share.interval
    return {'value': share.value, 'low': low, 'high': high, 'met': share.met, 'total': share.total}


Key = Callable[[Judged, RequirementScore], str]


def _split(judged: Sequence[Judged], key: Key) -> dict[str, list[RequirementScore]]:
    parts: dict[str, list[RequirementScore]] = {}
    for j in judged:
        for r in j.score.requirements:
            parts.setdefault(key(j, r), []).append(r)
    return dict(sorted(parts.items()))


def _split_json(parts: dict[str, list[RequirementScore]]) -> dict[str, Any]:
    return {
        name: {
            'requirements': share_json(requirement_share(scores)),
            'fields': share_json(field_share(scores)),
        }
        for name, scores in parts.items()
    }


def _table(heading: str, parts: dict[str, list[RequirementScore]]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, scores in parts.items():
        rows.append((name, *_shares(scores)))
    return Table(headings=(heading, *_SHARES), rows=tuple(rows))


_SHARES = ('requirements', 'met', '95 % interval', 'fields', 'held')


def _shares(scores: Sequence[RequirementScore]) -> tuple[Cell, ...]:
    whole, fields = requirement_share(scores), field_share(scores)
    low, high = whole.interval
    return whole.total, whole.value, f'[{low:.3f}, {high:.3f}]', fields.total, fields.value
