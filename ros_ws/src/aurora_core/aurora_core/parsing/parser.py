# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The offline parser: English in, a typed specification, a question or a refusal out.

It is a grammar and a lexicon: deterministic, without a network, a few milliseconds a prompt. The
stages, one module each: `text` (is it a prompt at all), `tokens`, `tagging` (atoms, with
`measures`, `nouns`, `spelling`, `disambiguation`), `rewriting/` (wordings put into plain order),
`segments` (clauses as `pieces`, with `clause_openings`, `predicates`,
`clause_order`; `criteria/` finds conditions), `frames` (predicate, subject, `adjuncts`), `reader`
(clauses in order) with `leading_causes`, `trailing_causes` and `effects` (cause and effect,
remembered in the `story`), `main_clause` and `constructions/` (what clauses mean, written into
`scene` through `resolver`), `rules` (what is implied, what stays open), `assemble` (the
specification). One reading of them is an `attempt`; what it left unread gets a
`second_look`.

Nothing is dropped in silence. A construction marks every adjunct that it understood as used; what
stays unused in an encoded clause becomes a clause of its own with the status `not_encoded`;
`asks_nothing` sets aside what of that is a purpose, a title, thanks or filler; `coverage` then
looks for numbers and actors that went nowhere, `doubts` for words that ask for something nothing
carries.

To add a word, write it in the list of its meaning in `lexicon.yaml`; forms and one-letter slips
follow by themselves. To add a default, `defaults.yaml`. To add a construction, write a function
`(Frame) -> bool` (or one that returns a trigger or an action) in the module of its family under
`constructions/`: take what it understands through the frame (`take`, `attribute`, `mark`), note
the element with `scene.became(id)`, and list it in `main_clause` (main clauses),
`triggers.cause` (behind `when`) or `actions.action` (effects). A new meaning of a verb gets a key
under `verbs:` in the lexicon.
"""

from __future__ import annotations

from pydantic import ValidationError

from aurora_core.errors import SpecError
from aurora_core.outcomes.parse import ParseContext, ParseOutcome, Refusal, RefusalKind
from aurora_core.parsing.asks_nothing import set_aside
from aurora_core.parsing.assemble import build
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.attempt import attempt
from aurora_core.parsing.closing import close_scene
from aurora_core.parsing.coverage import in_no_clause, unaccounted
from aurora_core.parsing.doubts.table import doubtful
from aurora_core.parsing.landmarks import landmark_phrases
from aurora_core.parsing.scene import ClauseDraft, Scene
from aurora_core.parsing.second_look import second_look
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.text import check_prompt_text
from aurora_core.parsing.tokens import tokenize
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

__all__ = [
    'ParseContext',
    'ParseOutcome',
    'Refusal',
    'RefusalKind',
    'check_prompt_text',
    'parse_offline',
]

# More unknown than known words: another language, or not about a scenario.
_MOST_UNKNOWN = 0.5


def parse_offline(prompt: str, context: ParseContext) -> ParseOutcome:
    """Read a prompt.

    Args:
        prompt: The request; spans refer to its characters.
        context: Map name and landmarks that names are looked up in.

    Raises:
        PromptError: The text cannot be a prompt (empty, too long, NUL).
        SpecError: The result contradicts its own schema: a defect of the parser.
    """
    check_prompt_text(prompt)
    tagged = tag(tokenize(prompt), landmark_phrases(context.landmark_names))
    read = attempt(prompt, context, tagged.atoms)
    unknown = _mostly_unknown(tagged.atoms)
    if not unknown:
        read = second_look(read)
    scene = read.scene
    _note_corrections(scene, tagged.corrections)
    if unknown:
        scene.questions = [
            'Most of this could not be read. Which vehicles, pedestrians or UAVs should take '
            'part, and what should they do? (English, please.)'
        ]
        scene.refusals = []
    if scene.refusals:
        return ParseOutcome(refusals=tuple(scene.refusals), clauses=scene.finished_clauses())
    _settle_doubts(scene)
    if scene.questions:
        question = ' '.join(dict.fromkeys(scene.questions))
        return ParseOutcome(question=question, clauses=scene.finished_clauses())
    close_scene(scene, read.told.atoms, tagged.atoms, read.resolver)
    aside = set_aside(scene.clauses, prompt)
    spec = _build(scene)
    lost = unaccounted(
        spec,
        read.told.atoms,
        read.resolver,
        no_uavs=scene.no_uavs,
        understood=(*scene.understood, *aside),
    )
    lost += in_no_clause(tagged.atoms, scene.finished_clauses())
    lost += doubtful(spec, tagged.atoms)
    if lost:
        scene.clauses += [
            ClauseDraft(span=span, notes=['nothing in the scenario accounts for this'])
            for span in lost
        ]
        spec = _build(scene)
    return ParseOutcome(spec=spec, clauses=spec.clauses)


def _build(scene: Scene) -> ScenarioSpec:
    try:
        return build(scene)
    except ValidationError as err:
        raise SpecError(
            f'the parser built a specification that its schema refuses: {err}',
            hint='word the request differently, and report this prompt',
        ) from err


def _settle_doubts(scene: Scene) -> None:
    """Words that stay open are admitted as unread; they are asked about only when all is open."""
    if not any(c.status is ClauseStatus.ENCODED for c in scene.clauses):
        scene.questions += [doubt.question for doubt in scene.doubts]
        return
    for doubt in dict.fromkeys(scene.doubts):
        scene.clauses.append(ClauseDraft(span=doubt.span, notes=[doubt.question]))


def _note_corrections(scene: Scene, corrections: tuple[tuple[int, int, str], ...]) -> None:
    for start, end, meant in corrections:
        for clause in scene.clauses:
            if clause.span.start <= start and end <= clause.span.end:
                clause.notes.append(f'read {scene.prompt[start:end]!r} as {meant!r}')
                break


def _mostly_unknown(atoms: tuple[Atom, ...]) -> bool:
    silent = (AtomKind.COMMA, AtomKind.STOP)
    told = [a for a in atoms if a.kind not in silent]
    unknown = [
        a
        for a in told
        if a.kind is AtomKind.UNKNOWN or (a.noun is not None and a.noun.kind is NounKind.UNKNOWN)
    ]
    return len(unknown) > _MOST_UNKNOWN * len(told)
